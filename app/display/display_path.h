// What is sent to the browser of the way of a tool: QCP1. docs/developer/formats/display-mesh.md has the grammar.
//
// One form per value, as of display_format.h (tests/app/display/display_path_test.cpp, tests/fuzz/fuzz_display.cpp).
// O(points).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "app/display/display_mesh.h"
#include "base/files/file.h"

namespace qchopper {

constexpr std::uint8_t display_way_kinds = 5;  // numbers of WayKind (sim/replay/stages/replay_stages.h)

// A list for each property of a point.
struct DisplayPath {
    DisplayGrid grid;
    std::vector<DisplayPoint> points;
    std::vector<std::uint32_t> ms;     // since the program began, never less than before
    std::vector<std::uint32_t> lines;  // of the file of the program
    std::vector<std::uint8_t> kinds;   // below display_way_kinds
    bool operator==(const DisplayPath&) const = default;
};

// Whether the lists are of one length and hold what is said above, and the grid is finite with a step above 0.
bool is_valid(const DisplayPath& path);

// Precondition: is_valid(path).
Bytes encode_display_path(const DisplayPath& path);
// is_valid() holds for the result. Throws InputError (mesh) for all that encode_display_path does not write.
DisplayPath decode_display_path(std::span<const std::uint8_t> bytes);

}  // namespace qchopper
