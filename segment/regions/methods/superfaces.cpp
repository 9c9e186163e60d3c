// A. Kalvin and R. Taylor, "Superfaces: polygonal mesh simplification with bounded error" (1996): a region grows from a
// seed as long as its triangles stay near one plane and do not fold under it.
//
// Ours: the plane is the least squares plane of the region, where the paper keeps the set of all planes that are near
// enough; triangles that it leaves behind as it moves are given back at the end. The seed is the triangle farthest from
// the centroid that has no region yet, not a random one. O(n log n) for n triangles.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include "segment/regions/engines/moments.h"
#include "segment/regions/labelling.h"

namespace qchopper {
namespace {

constexpr std::uint32_t unlabelled = no_dual_edge;

struct RegionPlane {
    Vec3 normal;
    Vec3 point;
};

RegionPlane plane_of(const PointMoments& moments, Vec3 outward) {
    Vec3 normal = principal_axes(moments.covariance()).direction[0];
    if (dot(normal, outward) < 0) normal = -normal;
    return {normal, moments.centre()};
}

class Growth {
 public:
    Growth(const FaceGraph& graph, double tolerance)
        : graph_(graph),
          tolerance_(tolerance),
          least_cosine_(std::cos(max_chart_turn)),
          of_(graph.size(), unlabelled) {}

    std::vector<std::uint32_t> run() {
        std::vector<std::uint32_t> seeds(graph_.size());
        std::iota(seeds.begin(), seeds.end(), 0U);
        const Vec3 centre = surface_centroid(graph_);
        const auto distance = [&](std::uint32_t f) { return norm(graph_.centroid[f] - centre); };
        std::ranges::stable_sort(seeds, std::ranges::greater(), distance);
        std::uint32_t region = 0;
        for (const std::uint32_t seed : seeds) {
            if (of_[seed] == unlabelled) grow(seed, region++);
        }
        return std::move(of_);
    }

 private:
    bool is_near(std::uint32_t face, const RegionPlane& plane) const {
        if (graph_.area[face] > 0 && dot(graph_.normal[face], plane.normal) < least_cosine_) return false;
        return std::ranges::all_of(corners_of(*graph_.mesh, face),
                                   [&](Vec3 p) { return std::abs(dot(p - plane.point, plane.normal)) <= tolerance_; });
    }

    void grow(std::uint32_t seed, std::uint32_t region) {
        using Entry = std::pair<double, std::uint32_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        PointMoments moments;
        RegionPlane plane{graph_.normal[seed], graph_.centroid[seed]};
        Vec3 outward;
        std::vector<std::uint32_t> members;
        queue.emplace(0, seed);
        while (!queue.empty()) {
            const auto [cost, face] = queue.top();
            queue.pop();
            if (of_[face] != unlabelled || (face != seed && !is_near(face, plane))) continue;
            of_[face] = region;
            members.push_back(face);
            moments.add_triangle(corners_of(*graph_.mesh, face), graph_.area[face]);
            outward = outward + graph_.area[face] * graph_.normal[face];
            if (moments.weight > 0) plane = plane_of(moments, outward);
            for (const std::uint32_t e : graph_.around[face]) {
                if (e == no_dual_edge) continue;
                const std::uint32_t next = graph_.across(e, face);
                if (of_[next] == unlabelled) queue.emplace(cost + graph_.edges[e].path, next);
            }
        }
        give_back(seed, members);
    }

    // Triangles too far from the plane of those that stay.
    void give_back(std::uint32_t seed, std::vector<std::uint32_t>& members) {
        while (members.size() > 1) {
            PointMoments moments;
            Vec3 outward;
            for (const std::uint32_t f : members) {
                moments.add_triangle(corners_of(*graph_.mesh, f), graph_.area[f]);
                outward = outward + graph_.area[f] * graph_.normal[f];
            }
            const RegionPlane plane = plane_of(moments, outward);
            const bool keeps_seed = is_near(seed, plane);
            const std::size_t left_out = std::erase_if(members, [&](std::uint32_t f) {
                const bool leaves = f != seed && (!keeps_seed || !is_near(f, plane));
                if (leaves) of_[f] = unlabelled;
                return leaves;
            });
            if (left_out == 0) return;
        }
    }

    const FaceGraph& graph_;
    double tolerance_;
    double least_cosine_;
    std::vector<std::uint32_t> of_;
};

}  // namespace

Labels superfaces(const FaceGraph& graph, const RegionOptions& options) {
    return connected(graph, numbered(Growth(graph, tolerance_of(graph, options)).run()));
}

}  // namespace qchopper
