// Settings by name: the four cases of the thesis (Nicholson 2016, chapter 5; stop rules of the last two are ours), and
// cutting for what a tilting tool reaches (tests/app/project/presets_test.cpp).

#pragma once

#include <optional>
#include <string_view>

#include "segment/search/settings.h"

namespace qchopper {

// "carve", "bunny", "femur", "vertebrae" or "skull"; nothing for any other name.
std::optional<SearchSettings> preset(std::string_view name);

}  // namespace qchopper
