#include "app/console/page_files.h"

#include <algorithm>

#include "app/console/http/content_type.h"

namespace qchopper {

std::optional<PageFile> page_file(std::string_view name) {
    if (name.empty()) name = "index.html";
    const auto files = packed_files();
    const auto file = std::ranges::find_if(files, [&](const PackedFile& packed) { return packed.name == name; });
    if (file == files.end()) return {};
    return PageFile{content_type(name), file->gzip};
}

std::string_view page_hash() {
    return QCHOPPER_PAGE_HASH;
}

}  // namespace qchopper
