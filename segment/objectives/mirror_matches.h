// Compares points of a surface with their mirror images in a plane: the nearest one on the other side of each.
//
// mm. A point whose mirror image has none on the other side makes the plane's score infinite. The same points give the
// same matches, for any number of threads (tests/segment/objectives/symmetry_plane_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/access/surface_samples.h"
#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// How well matches are looked for.
struct Matching {
    std::size_t every = 1;  // n-th of the points is matched
    double within = 1;      // a match may be so many times as far as the nearest point
};

// A point, and the nearest one on the other side of the plane to its mirror image.
struct MirrorMatch {
    Vec3 point;
    Vec3 match;
    double distance2 = 0;
};

class MirrorMatches {
 public:
    // O(points log points).
    explicit MirrorMatches(std::vector<Vec3> points);

    // In the order of the tree: every n-th of them are spread over the surface.
    const std::vector<Vec3>& points() const { return points_; }

    // Of every n-th point; none where all points lie on one side. O(log points) expected for each.
    std::vector<MirrorMatch> of(const Plane& plane, const Matching& how = {}) const;

    // The mean of the least 90 % of their distances; infinite without matches.
    double score(const Plane& plane, const Matching& how = {}) const;

 private:
    struct Found {
        double distance2 = std::numeric_limits<double>::infinity();
        std::size_t point = 0;
    };
    struct Query {
        Vec3 point;
        Plane plane;
        bool above;
        double within2;
    };
    void divide(std::size_t begin, std::size_t end);
    Found nearest(const Query& query, const Found& near) const;
    void compare(const Query& query, std::size_t i, Found& found) const;
    void search(const Query& query, std::size_t begin, std::size_t end, Vec3 off, Found& found) const;

    std::vector<Vec3> points_;
    std::vector<std::uint8_t> axis_;  // of the middle of a range that is divided
};

// The points that stand for the surface of a scan: spread evenly over the solids that have at least that share of the
// largest one's area.
SurfaceSamples symmetry_samples(const TriangleMesh& scan, std::size_t points, double min_solid_area);

constexpr double scored_share = 0.9;  // of the distances

// Leaves that share of the matches, at least one, those of the least distances.
void keep_closest(std::vector<MirrorMatch>& matches, double share);

}  // namespace qchopper
