// Adds one face of a file to a scan as triangles, and keeps faces that precede their points in the file.
//
// Shared by the readers of PLY, OBJ and OFF. The limits hold for every format (docs/user/scan-formats.md).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/io/formats/raw_mesh.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::uint64_t max_points = std::numeric_limits<std::uint32_t>::max() - 1;  // point indices have 32 bits
constexpr std::size_t max_triangles = 0x55555554;                                    // half-edge indices have 32 bits
// Corners of one face: more than any scanner or modeller writes. The time for splitting grows faster than the square.
constexpr std::int64_t max_corners = 1000;

// Counts the face in faces_in_file and appends its triangles (split_polygon). A face with fewer than three corners is
// counted in faces_without_area and makes none. Precondition: every corner is the index of a point of the scan.
void add_face(RawMesh& scan, std::span<const std::uint32_t> corners);

// Faces whose points have not been read: a polygon is split by its coordinates, so its face is added at the end.
struct EarlyFaces {
    std::vector<std::uint32_t> corners;  // of all faces, one face after the other
    std::vector<std::size_t> end;        // per face, where its corners end
    std::vector<std::int64_t> note;      // per face, a number that its reader keeps with it

    void keep(std::span<const std::uint32_t> face, std::int64_t note_of_face) {
        corners.insert(corners.end(), face.begin(), face.end());
        end.push_back(corners.size());
        note.push_back(note_of_face);
    }
    // Precondition: face < end.size().
    std::span<const std::uint32_t> corners_of(std::size_t face) const {
        const std::size_t begin = face == 0 ? 0 : end[face - 1];
        return std::span(corners).subspan(begin, end[face] - begin);
    }
};

// Splits a polygon in space without adding points: appends corners.size() - 2 triangles to `triangles`. Ears are found
// in the plane of the polygon's area vector, so that concave polygons are right too; a polygon without such a plane
// becomes a fan. Preconditions: at least three corners, each the index of a point. Tested by
// tests/segment/io/formats/polygon_test.cpp. It is separate from segment/mesh/polygon.h and segment/cut/ear_clipping.h
// because those compute in plane coordinates: a projection rounds differently, so other ears would be found and other
// triangles be read from the same file.
void split_polygon(const std::vector<Vec3>& points, std::span<const std::uint32_t> corners,
                   std::vector<Triangle>& triangles);

}  // namespace qchopper
