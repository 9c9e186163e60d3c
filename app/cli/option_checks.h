// Checks of what was typed: empty if it is right, else what is wrong with it as a sentence without an end.

#pragma once

#include <functional>
#include <string>
#include <vector>

namespace qchopper {

using OptionCheck = std::function<std::string(const std::string&)>;

constexpr double many = 1e15;  // more than any count or length that makes sense

OptionCheck number_between(double low, double high, const std::string& words);
OptionCheck one_of(const std::vector<std::string>& words);

// The formats of scans, as help texts name them.
constexpr const char* scan_formats = "PLY, STL, OBJ, OFF, GLB, glTF or 3MF, packed by gzip or not";

}  // namespace qchopper
