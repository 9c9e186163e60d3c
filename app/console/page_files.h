// The files of the page, which are a part of the program.

#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace qchopper {

// As the build has packed it by gzip.
struct PackedFile {
    std::string_view name;  // "page.js"
    std::span<const char> gzip;
};
// Of page/dist; made by the build.
std::span<const PackedFile> packed_files();

struct PageFile {
    std::string_view type;  // of HTTP
    std::span<const char> gzip;
};

// Nothing if the page has no such file. "" is index.html.
std::optional<PageFile> page_file(std::string_view name);

// The SHA-256 of page.js in hexadecimal digits: a page that is older than the server knows it by this.
std::string_view page_hash();

}  // namespace qchopper
