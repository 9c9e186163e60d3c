// Reads a range scan: points in the grid in which a scanner took them, some places of which are empty.
//
// As the Stanford 3D Scanning Repository writes them: a PLY file with the elements "vertex" and "range_grid", each
// entry of which lists no point or one, row by row, and the comments "obj_info num_cols N" and "obj_info num_rows N".
// In the unit of the file. For all bytes the result is a scan with finite coordinates and valid indices, or an
// InputError (mesh) that states what is wrong and at which line or byte (tests/segment/fuse/range_scan_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/vec3.h"

namespace qchopper {

struct RangeScan {
    static constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();

    std::vector<Vec3> points;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<std::uint32_t> grid;  // columns * rows indices of points, row by row; no_point where none was taken
};

// Whether the bytes are a PLY file whose header announces an element "range_grid". O(header).
bool is_range_scan(const Bytes& bytes);

// Precondition: is_range_scan(bytes). `name` stands for the file in messages. O(bytes).
RangeScan parse_range_scan(const Bytes& bytes, const std::string& name);

}  // namespace qchopper
