// Settings by name: the four cases of the thesis (Nicholson 2016, chapter 5; stop rules of the last two are ours).

#pragma once

#include <optional>
#include <string_view>

#include "segment/search/settings.h"

namespace qchopper {

std::optional<SearchSettings> preset(std::string_view name);

}  // namespace qchopper
