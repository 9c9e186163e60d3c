// Line by line.

#include "app/cli/arguments/plane_list.h"

#include <algorithm>

#include "app/cli/arguments/option_values.h"
#include "base/error.h"
#include "base/files/file.h"

namespace qchopper {
namespace {

// `name` stands for the file.
std::vector<Plane> plane_list(std::string_view text, const std::string& name) {
    std::vector<Plane> planes;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string content(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        std::erase_if(content, [](char c) { return c == ' ' || c == '\t' || c == '\r'; });
        if (content.empty() || content.front() == '#') continue;
        const std::string where = name + ", line " + std::to_string(line);
        const std::optional<Plane> plane = plane_from(content);
        if (!plane) {
            throw InputError(InputFault::config, where + ": not a plane nx,ny,nz,d",
                             "write a direction of any length but 0, and the distance along it in mm");
        }
        if (planes.size() == max_planes) {
            throw InputError(InputFault::config, where + ": more than " + std::to_string(max_planes) + " planes",
                             "keep those that matter");
        }
        planes.push_back(canonical(*plane));
    }
    if (planes.empty()) {
        throw InputError(InputFault::config, name + " holds no plane", "write a plane nx,ny,nz,d in each line");
    }
    return planes;
}

}  // namespace

std::vector<Plane> planes_of_file(const std::filesystem::path& file) {
    const Bytes bytes = read_file(file, settings_limit);
    return plane_list({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

}  // namespace qchopper
