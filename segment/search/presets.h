// Settings by name: the four cases of the thesis (Nicholson 2016, chapter 5; stop rules of the last two are ours).

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "segment/search/search.h"

namespace qchopper {

std::optional<SearchSettings> preset(std::string_view name);
std::vector<std::string> preset_names();

}  // namespace qchopper
