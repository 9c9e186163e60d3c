// Finds the plane in which a scan is most nearly its own mirror image.
//
// mm. Podolak et al., "A planar-reflective symmetry transform for 3D shapes" (2006), asks all planes; here 500
// directions through the centroid of points on the surface are, and the best are refined by turns of matching
// reflected points and the plane that fits the pairs best, as the iterative closest point method does (Besl and McKay,
// 1992), on the closest 80 % of the pairs (Chetverikov et al., "The trimmed iterative closest point algorithm", 2002).
// The same points give the same plane, for any number of threads (tests/segment/objectives/symmetry_plane_test.cpp).

#pragma once

#include <cstddef>
#include <optional>

#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SymmetryPlane {
    Plane plane;  // canonical
    // The mean of the least 90 % of the distances from each side's points to the other side's reflected ones.
    double score_mm = 0;
    // The root of the sampled area over the number of points: what the score of a symmetric surface compares with.
    double spacing_mm = 0;
    bool operator==(const SymmetryPlane&) const = default;

    double ratio() const { return spacing_mm > 0 ? score_mm / spacing_mm : 0; }
    // Up to about 0.5 a surface is symmetric: skulls have 0.39 to 0.47, other scans 0.6 and more.
    bool is_symmetric() const { return ratio() <= max_ratio; }
    static constexpr double max_ratio = 0.5;
};

struct SymmetryOptions {
    std::size_t points = 10'000;   // on the surface
    std::size_t directions = 500;  // of the half sphere
    std::size_t refined = 8;       // so many of the best are refined
    double min_solid_area = 0.01;  // a solid with less than this share of the largest one's area has no points
};

// Of the surface of a scan. Nothing if there is no area. Some hundredths of a second for the points of 1.9 million
// triangles, and some tenths for the search, whatever the size of the scan.
std::optional<SymmetryPlane> symmetry_plane(const TriangleMesh& scan, const SymmetryOptions& options = {});

// The mirror image of a point, and that of a plane, which is canonical.
Vec3 reflected(Vec3 point, const Plane& mirror);
Plane reflected(const Plane& plane, const Plane& mirror);

}  // namespace qchopper
