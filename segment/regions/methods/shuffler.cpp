// V. Kraevoy, D. Julius and A. Sheffer, "Model composition from interchangeable components" (2007): "Shuffler" grows
// patches that are convex and compact, one after the other.
//
// Of the paper, as Nicholson 2016 has it: the seed, which is, of each connected part without a patch, the triangle that
// costs least, (1 + dist) (1 + comp)^a, with the distance of its plane from the middle of the part (2.3) and the
// compactness area / volume^(2/3) of the hull of the part (2.2); growth while the patch stays convex (2.1). Ours: the
// growth cost, which is not given there, would be (1 + conv) (1 + comp)^a with a hull for each point that is tried;
// instead a triangle is asked how far it stands above the planes of the triangles of the patch, which is how far those
// would lie under the hull, and it is refused if 4 % of the patch would lie deeper than 0.3 of the tolerance. So the
// compactness decides on seeds alone. Patches grow by rings of triangles; points are smoothed first, so that noise is
// not concave; 500 triangles stand for a patch; patches below 2 % of the surface are joined to neighbours. O(500 n) for
// n triangles, and a hull of what is left per patch.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "segment/regions/engines/convex_hull.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr double compactness_power = 0.5;  // a
constexpr double deep_share = 0.04;        // of the area of a patch
constexpr double depth = 0.3;              // of the tolerance
constexpr double small_share = 0.02;       // of the surface
constexpr std::size_t asked = 500;         // triangles of a patch

// (1 + comp)^a; infinite for a flat hull.
double compactness_factor(const ConvexHull& hull) {
    if (!(hull.volume > 0)) return std::numeric_limits<double>::infinity();
    return std::pow(1 + hull.area / std::pow(hull.volume, 2.0 / 3), compactness_power);
}

using Faces = std::vector<std::uint32_t>;

// Each of some rounds moves a point to the mean of itself and its neighbours.
TriangleMesh with_smooth_points(const FaceGraph& graph) {
    constexpr int rounds = 2;
    TriangleMesh mesh = *graph.mesh;
    for (int round = 0; round < rounds; ++round) {
        std::vector<Vec3> sum = mesh.points;
        std::vector<double> count(sum.size(), 1);
        for (const DualEdge& edge : graph.edges) {
            const auto [a, b] = edge.point;
            sum[a] = sum[a] + mesh.points[b];
            sum[b] = sum[b] + mesh.points[a];
            ++count[a];
            ++count[b];
        }
        for (std::size_t p = 0; p < sum.size(); ++p) mesh.points[p] = (1 / count[p]) * sum[p];
    }
    return mesh;
}

class PatchGrowth {
 public:
    PatchGrowth(const FaceGraph& graph, double tolerance)
        : graph_(graph),
          smooth_(with_smooth_points(graph)),
          centroid_(graph.size()),
          normal_(graph.size()),
          tolerance_(tolerance),
          of_(graph.size(), no_dual_edge),
          refused_(graph.size(), no_dual_edge) {
        for (std::size_t f = 0; f < graph.size(); ++f) {
            const auto [a, b, c] = corners_of(smooth_, f);
            centroid_[f] = (1.0 / 3) * (a + b + c);
            normal_[f] = normalized(cross(b - a, c - a));
        }
    }

    std::vector<std::uint32_t> run() {
        Faces all(graph_.size());
        std::iota(all.begin(), all.end(), 0U);
        std::vector<Part> parts = connected_parts(all);
        for (std::uint32_t patch = 0; !parts.empty(); ++patch) {
            const auto cheapest = std::ranges::min_element(parts, {}, &Part::cost);
            const Part part = std::move(*cheapest);
            parts.erase(cheapest);
            grow(part.seed, patch);
            for (Part& rest : connected_parts(part.faces)) parts.push_back(std::move(rest));
        }
        return std::move(of_);
    }

 private:
    // A connected part of what has no patch yet: a potential patch.
    struct Part {
        Faces faces;
        std::uint32_t seed = 0;
        double cost = 0;  // of the seed
    };

    std::vector<Vec3> corners(const Faces& faces) const {
        std::vector<Vec3> points;
        for (const std::uint32_t f : faces) {
            for (const Vec3& p : corners_of(smooth_, f)) points.push_back(p);
        }
        return points;
    }

    // Of the triangle whose plane is nearest to the middle of the hull, (1 + dist) (1 + comp)^a.
    Part part_of(Faces faces) const {
        const ConvexHull hull = convex_hull_of(corners(faces));
        const Vec3 middle = surface_centroid(graph_, faces);
        const auto distance = [&](std::uint32_t f) {
            return std::abs(dot(graph_.normal[f], graph_.centroid[f] - middle));
        };
        const std::uint32_t seed = *std::ranges::min_element(faces, {}, distance);
        const double cost = (1 + distance(seed) / tolerance_) * compactness_factor(hull);
        return {std::move(faces), seed, cost};
    }

    // Of these triangles those without a patch, by connected parts.
    std::vector<Part> connected_parts(const Faces& among) const {
        std::vector<bool> waits(graph_.size());
        for (const std::uint32_t f : among) waits[f] = of_[f] == no_dual_edge;
        std::vector<Part> parts;
        for (const std::uint32_t first : among) {
            if (!waits[first]) continue;
            waits[first] = false;
            Faces faces{first};
            for (std::size_t i = 0; i < faces.size(); ++i) {
                for (const std::uint32_t e : graph_.around[faces[i]]) {
                    if (e == no_dual_edge || !waits[graph_.across(e, faces[i])]) continue;
                    faces.push_back(graph_.across(e, faces[i]));
                    waits[faces.back()] = false;
                }
            }
            parts.push_back(part_of(std::move(faces)));
        }
        return parts;
    }

    // How far the triangle stands above the planes of these, but for the share of their area that lies deepest.
    double height_above(const Faces& patch, std::uint32_t face) const {
        std::vector<std::pair<double, double>> heights;  // and areas
        double area = 0;
        const std::size_t step = patch.size() / asked + 1;
        for (std::size_t i = 0; i < patch.size(); i += step) {
            const std::uint32_t f = patch[i];
            heights.emplace_back(dot(normal_[f], centroid_[face] - centroid_[f]), graph_.area[f]);
            area += graph_.area[f];
        }
        std::ranges::sort(heights, std::ranges::greater());
        double deeper = 0;
        for (const auto& [above, of_area] : heights) {
            deeper += of_area;
            if (deeper > deep_share * area) return above;
        }
        return 0;
    }

    // Neighbours of these triangles that the patch may still take, each once.
    Faces ring_around(std::span<const std::uint32_t> faces, std::uint32_t label) const {
        Faces ring;
        for (const std::uint32_t face : faces) {
            for (const std::uint32_t e : graph_.around[face]) {
                if (e == no_dual_edge) continue;
                const std::uint32_t f = graph_.across(e, face);
                if (of_[f] == no_dual_edge && refused_[f] != label) ring.push_back(f);
            }
        }
        std::ranges::sort(ring);
        ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
        return ring;
    }

    void grow(std::uint32_t seed, std::uint32_t label) {
        of_[seed] = label;
        Faces patch{seed};
        for (std::size_t from = 0; from < patch.size();) {
            const Faces ring = ring_around(std::span(patch).subspan(from), label);
            from = patch.size();
            // By height, so that the order of triangles in the mesh does not decide which of them are asked.
            std::vector<std::pair<double, std::uint32_t>> heights;
            heights.reserve(ring.size());
            for (const std::uint32_t f : ring) heights.emplace_back(height_above(patch, f), f);
            std::ranges::sort(heights);
            for (const auto& [above, f] : heights) {
                const bool is_convex = above <= depth * tolerance_;
                (is_convex ? of_ : refused_)[f] = label;
                if (is_convex) patch.push_back(f);
            }
        }
    }

    const FaceGraph& graph_;
    TriangleMesh smooth_;  // the same triangles
    std::vector<Vec3> centroid_;
    std::vector<Vec3> normal_;
    double tolerance_;
    std::vector<std::uint32_t> of_;
    std::vector<std::uint32_t> refused_;  // the last patch that did not take the triangle
};

}  // namespace

Labels shuffler_parts(const FaceGraph& graph, const RegionOptions& options) {
    const Labels grown = connected(graph, numbered(PatchGrowth(graph, tolerance_of(graph, options)).run()));
    return without_small(graph, grown, small_share);
}

}  // namespace qchopper
