// The types of files in HTTP.

#pragma once

#include <string_view>

namespace qchopper {

// Of a file of this name, by its ending: "text/html; charset=utf-8". Plain text for an ending that is not known. O(1).
std::string_view content_type(std::string_view name);

}  // namespace qchopper
