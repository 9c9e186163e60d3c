#include "app/console/page_files.h"

#include <algorithm>
#include <iterator>

namespace qchopper {
namespace {

struct TypeOfFile {
    std::string_view ending;
    std::string_view type;
};
constexpr TypeOfFile types[] = {{".html", "text/html; charset=utf-8"},
                                {".js", "text/javascript; charset=utf-8"},
                                {".css", "text/css; charset=utf-8"},
                                {".svg", "image/svg+xml"},
                                {"", "text/plain; charset=utf-8"}};

}  // namespace

std::optional<PageFile> page_file(std::string_view name) {
    if (name.empty()) name = "index.html";
    const auto files = packed_files();
    const auto file = std::ranges::find_if(files, [&](const PackedFile& packed) { return packed.name == name; });
    if (file == files.end()) return {};
    const auto* const row = std::ranges::find_if(types, [&](const TypeOfFile& t) { return name.ends_with(t.ending); });
    return PageFile{row->type, file->gzip};
}

std::string_view page_hash() {
    return QCHOPPER_PAGE_HASH;
}

}  // namespace qchopper
