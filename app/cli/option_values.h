// Values that options are given as one word, and checks of them.

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/score/objectives.h"

namespace qchopper {

// Those that were named; the others stay as they are.
struct GivenWeights {
    std::optional<double> face_ratio;
    std::optional<double> fragility;
    std::optional<double> piece_count;
    std::optional<double> undercut;
    Weights over(Weights weights) const;
};

// "face_ratio=10,undercut=2" in any order, or four numbers in the order face ratio, fragility, piece count, undercut.
// Nothing if it is neither; weights are never negative.
std::optional<GivenWeights> weights_from(const std::string& text);

// "nx,ny,nz,d": a direction of any length but zero, and the distance along it in mm.
std::optional<Plane> plane_from(const std::string& text);

// "X,Y,Z": three lengths in mm, greater than zero.
std::optional<Vec3> lengths_from(const std::string& text);

// A whole number from 1, the place in a ranking.
std::optional<std::size_t> place_from(const std::string& text);

// Empty if a text is right, else what is wrong with it, without a full stop.
using OptionCheck = std::function<std::string(const std::string&)>;

constexpr double many = 1e15;  // more than any count or length that makes sense

OptionCheck number_between(double low, double high, const std::string& words);
OptionCheck one_of(const std::vector<std::string>& words);

// The formats of scans, as help texts name them.
constexpr const char* scan_formats = "PLY, STL, OBJ, OFF, GLB, glTF or 3MF, packed by gzip or not";

}  // namespace qchopper
