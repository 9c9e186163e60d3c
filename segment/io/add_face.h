// One face of a file becomes triangles of a scan; what the readers of every format share.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "segment/io/raw_mesh.h"

namespace qchopper {

constexpr std::uint64_t most_points = std::numeric_limits<std::uint32_t>::max() - 1;
constexpr std::size_t most_triangles = 0x55555554;  // half-edges are numbered in 32 bits
// More than any scanner or modeller writes; the time for splitting grows with the square of it and worse.
constexpr std::int64_t most_corners = 1000;

// Counts the face and splits it (polygon.h); with fewer than three corners it is counted and left out. Every corner
// must name a point of the scan.
void add_face(RawMesh& scan, std::span<const std::uint32_t> corners);

}  // namespace qchopper
