// Unpacks gzip, converts to UTF-8, and calls the reader whose mark the bytes bear. The readers state their cost.

#include "segment/io/read_mesh.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"
#include "segment/io/formats/gltf_json.h"
#include "segment/io/formats/read_3mf.h"
#include "segment/io/formats/read_gltf.h"
#include "segment/io/formats/read_obj.h"
#include "segment/io/formats/read_off.h"
#include "segment/io/formats/read_ply.h"
#include "segment/io/formats/read_stl.h"
#include "segment/io/formats/text.h"
#include "segment/io/formats/unpack.h"

namespace qchopper {
namespace {

// A binary file has a zero byte soon; text has none.
bool is_binary(const Bytes& bytes) {
    constexpr std::ptrdiff_t looked_at = 1024;
    const auto end = bytes.begin() + std::min(looked_at, static_cast<std::ptrdiff_t>(bytes.size()));
    return std::find(bytes.begin(), end, 0) != end;
}

[[noreturn]] void refuse_unknown(const Bytes& bytes, const std::string& name) {
    throw InputError(InputFault::mesh,
                     name + " does not begin like a " + mesh_formats + " file" +
                         (is_binary(bytes) ? ", and " + why_no_binary_stl(bytes) : ""),
                     "give a file of one of these formats; if it was one, export or copy it again");
}

struct Format {
    std::string_view ending;
    bool (*is)(const Bytes&);
    RawMesh (*parse)(const Bytes&, const std::string&, const std::filesystem::path& folder);
};

template <RawMesh (*parse)(const Bytes&, const std::string&)>
RawMesh alone(const Bytes& bytes, const std::string& name, const std::filesystem::path&) {
    return parse(bytes, name);
}

// By the strength of their marks.
constexpr std::array<Format, 7> formats{{{".ply", is_ply, alone<parse_ply>},
                                         {".stl", is_ascii_stl, alone<parse_ascii_stl>},
                                         {".glb", is_glb, parse_gltf},
                                         {".gltf", is_gltf, parse_gltf},
                                         {".3mf", is_3mf, alone<parse_3mf>},
                                         {".off", is_off, alone<parse_off>},
                                         {".obj", is_obj, alone<parse_obj>}}};

// Of the name, or of what it was before gzip.
bool has_ending(std::filesystem::path name, std::string_view lower) {
    if (equals_ignoring_case(name.extension().string(), ".gz")) name.replace_extension();
    return equals_ignoring_case(name.extension().string(), lower);
}

// An OBJ may begin with a line like the first one of an STL or PLY: of several formats whose marks the bytes bear, that
// of the ending is taken.
RawMesh parse_by_content(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder) {
    const auto find = [&](bool by_ending) {
        return std::find_if(formats.begin(), formats.end(), [&](const Format& format) {
            return (!by_ending || has_ending(name, format.ending)) && format.is(bytes);
        });
    };
    auto found = find(true);
    if (found == formats.end()) found = find(false);
    if (found == formats.end()) refuse_unknown(bytes, name);
    return found->parse(bytes, name, folder);
}

// After unpacking. A binary STL comes first: its length is a better mark than the first bytes.
RawMesh parse_unpacked(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                       const ReadOptions& options) {
    if (is_binary_stl(bytes)) return parse_binary_stl(bytes, name, options.weld);
    if (const std::optional<Bytes> text = to_utf8(bytes)) return parse_by_content(*text, name, folder);
    return parse_by_content(bytes, name, folder);
}

RawMesh parse_packed(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                     const ReadOptions& options) {
    if (bytes.empty()) throw InputError(InputFault::mesh, name + " is empty", export_again);
    if (!is_gzip(bytes) || is_binary_stl(bytes)) return parse_unpacked(bytes, name, folder, options);
    const Bytes unpacked = gunzip(bytes, name);
    if (unpacked.empty()) throw InputError(InputFault::mesh, name + " is empty after unpacking", "copy the file again");
    return parse_unpacked(unpacked, name, folder, options);
}

}  // namespace

RawMesh parse_mesh(const Bytes& bytes, const std::string& name, const std::filesystem::path& folder,
                   const ReadOptions& options) {
    RawMesh scan = parse_packed(bytes, name, folder, options);
    if (scan.mesh.triangles.empty()) {
        throw InputError(InputFault::mesh, name + " holds no faces", "export the scan as a surface, not as points");
    }
    return scan;
}

Bytes read_scan(const std::filesystem::path& path) {
    return path == "-" || path == "/dev/stdin" ? read_standard_input() : read_file(path);
}

RawMesh read_mesh(const std::filesystem::path& path, const ReadOptions& options) {
    return parse_mesh(read_scan(path), name_of_scan(path), folder_of(path), options);
}

std::string name_of_scan(const std::filesystem::path& path) {
    return path == "-" ? "standard input" : path.string();
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    if (path == "-") return {};
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace qchopper
