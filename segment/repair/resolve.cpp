// The local step of M. Attene, "A lightweight approach to repairing digitized polygon meshes" (2010): remove the
// intersecting triangles, fill the hole, check the filling exactly, and retry with a wider neighbourhood where it
// fails. A pass costs a search for all intersections, O(triangles) and a triangulation of each loop that is tried
// (fill_loop).

#include "segment/repair/resolve.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/repair/faces.h"
#include "segment/repair/fill_holes.h"
#include "segment/repair/intersections/exact_pair.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/repair/surface_region.h"

namespace qchopper {
namespace {

constexpr std::size_t max_triangles_of_region = 20'000;
constexpr std::size_t max_edges_of_loop = 400;
constexpr std::size_t max_places_listed = 10;

std::size_t count_of(const SelfIntersections& found) {
    return found.pairs.size() + found.without_area.size();
}

bool do_meet(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

// Intersecting triangles that are connected by pairs that meet or by shared points.
struct IntersectionPlace {
    std::vector<std::uint32_t> triangles;  // ascending
};

// In the order of their first triangles.
std::vector<IntersectionPlace> places_of(const TriangleMesh& mesh, const SelfIntersections& found) {
    std::vector<std::uint32_t> triangles = found.without_area;
    for (const auto& [a, b] : found.pairs) {
        triangles.push_back(a);
        triangles.push_back(b);
    }
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    const auto number = [&](std::uint32_t t) {
        return static_cast<std::uint32_t>(std::lower_bound(triangles.begin(), triangles.end(), t) - triangles.begin());
    };
    DisjointSets sets(triangles.size());
    for (const auto& [a, b] : found.pairs) sets.unite(number(a), number(b));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> corners;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t corner : mesh.triangles[triangles[i]]) corners.emplace_back(corner, i);
    }
    std::sort(corners.begin(), corners.end());
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].first == corners[i - 1].first) sets.unite(corners[i].second, corners[i - 1].second);
    }
    std::vector<IntersectionPlace> places;
    std::vector<std::size_t> place_of(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const std::uint32_t root = sets.root(i);
        if (root == i) {
            place_of[i] = places.size();
            places.emplace_back();
        }
        places[place_of[root]].triangles.push_back(triangles[i]);
    }
    return places;
}

// One pass over all places of a mesh. Places near one that was repaired in this pass wait for the next pass.
class ResolvePass {
 public:
    ResolvePass(const TriangleMesh& mesh, const ResolveOptions& options)
        : mesh_(mesh), options_(options), incidence_(mesh), tree_(mesh), is_kept_(mesh.triangles.size(), true) {
        max_extent_ = options.max_extent * norm(bounds(mesh).size());
    }

    // Returns whether the place is repaired.
    bool repair_place(const IntersectionPlace& place) {
        SurfaceRegion region(incidence_, place.triangles);
        for (int round = 0; round < options_.rounds; ++round) {
            if (round > 0) region.grow();
            region.tidy();
            const Box box = box_of(region);
            if (region.triangles().size() > max_triangles_of_region || norm(box.size()) > max_extent_) return false;
            if (std::any_of(repaired_.begin(), repaired_.end(), [&](const Box& b) { return do_meet(b, box); }))
                return false;
            const std::optional<std::vector<Triangle>> filling = filling_of(region);
            if (!filling) continue;
            for (const std::uint32_t t : region.triangles()) is_kept_[t] = false;
            removed += region.triangles().size();
            added_.insert(added_.end(), filling->begin(), filling->end());
            repaired_.push_back(box);
            return true;
        }
        return false;
    }

    // Changes the mesh of this pass, which must not be used after that.
    void apply(TriangleMesh& mesh, SourceFaces* sources) const {
        keep_triangles(mesh, is_kept_, sources);
        mesh.triangles.insert(mesh.triangles.end(), added_.begin(), added_.end());
        if (sources != nullptr) sources->of.resize(mesh.triangles.size(), new_face);
    }

    std::size_t removed = 0;
    std::size_t added() const { return added_.size(); }

 private:
    Box box_of(const SurfaceRegion& region) const {
        const Vec3 first = mesh_.points[mesh_.triangles[region.triangles()[0]][0]];
        Box box{first, first};
        for (const std::uint32_t t : region.triangles()) {
            for (const std::uint32_t corner : mesh_.triangles[t]) extend(box, mesh_.points[corner]);
        }
        return box;
    }

    // Triangles that close the region's borders and meet no other triangle; nothing if none are found.
    std::optional<std::vector<Triangle>> filling_of(const SurfaceRegion& region) const {
        const auto loops = region.loops();
        if (!loops) return std::nullopt;
        std::vector<Triangle> filling;
        for (const auto& [loop] : *loops) {
            if (loop.size() > max_edges_of_loop) return std::nullopt;
            std::vector<Vec3> points;
            std::vector<Vec3> beyond;
            for (const std::uint32_t h : loop) {
                points.push_back(mesh_.points[start_of(mesh_, h)]);
                beyond.push_back(mesh_.points[opposite_corner(incidence_.twin[h])]);
            }
            const std::vector<Triangle> triangles = fill_loop(points, beyond);
            if (triangles.size() + 2 != loop.size()) return std::nullopt;
            for (const Triangle& t : triangles) {
                filling.push_back(
                    {start_of(mesh_, loop[t[0]]), start_of(mesh_, loop[t[1]]), start_of(mesh_, loop[t[2]])});
            }
        }
        if (!is_manifold(region, filling) || meets_anything(region, filling)) return std::nullopt;
        return filling;
    }

    // The corner of a triangle that is not on this edge of it.
    std::uint32_t opposite_corner(std::uint32_t half_edge) const {
        return start_of(mesh_, previous_in_triangle(half_edge));
    }

    // Every directed edge at most once, together with the triangles that stay.
    bool is_manifold(const SurfaceRegion& region, const std::vector<Triangle>& filling) const {
        std::vector<std::array<std::uint32_t, 2>> runs;
        for (const Triangle& t : filling) {
            for (std::size_t k = 0; k < 3; ++k) runs.push_back({t[k], t[(k + 1) % 3]});
        }
        std::sort(runs.begin(), runs.end());
        if (std::adjacent_find(runs.begin(), runs.end()) != runs.end()) return false;
        return std::all_of(runs.begin(), runs.end(), [&](const std::array<std::uint32_t, 2>& run) {
            bool is_free = true;
            incidence_.for_each_at(run[0], [&](std::uint32_t t) {
                if (region.has(t)) return;
                const Triangle& other = mesh_.triangles[t];
                for (std::size_t k = 0; k < 3; ++k) {
                    if (other[k] == run[0] && other[(k + 1) % 3] == run[1]) is_free = false;
                }
            });
            return is_free;
        });
    }

    bool meets_anything(const SurfaceRegion& region, const std::vector<Triangle>& filling) const {
        std::vector<Corners> corners;
        std::vector<FloatBox> boxes;
        for (const Triangle& t : filling) {
            corners.push_back({mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]});
            if (!has_area(corners.back())) return true;
            boxes.push_back(tree_.box_of(corners.back()));
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            for (std::size_t j = i + 1; j < corners.size(); ++j) {
                if (qchopper::do_meet(boxes[i], boxes[j]) && qchopper::do_meet(corners[i], corners[j])) return true;
            }
            bool is_met = false;
            tree_.for_each_near(boxes[i], [&](std::uint32_t t) {
                if (is_met || !is_kept_[t] || region.has(t)) return;
                const Corners other = corners_of(mesh_, t);
                is_met = has_area(other) && qchopper::do_meet(corners[i], other);
            });
            if (is_met) return true;
        }
        return false;
    }

    const TriangleMesh& mesh_;
    const ResolveOptions& options_;
    const MeshIncidence incidence_;
    const TriangleTree tree_;
    std::vector<bool> is_kept_;
    double max_extent_ = 0;
    std::vector<Box> repaired_;  // around the repaired places
    std::vector<Triangle> added_;
};

// Drops points that were used and are no longer; the others keep their order. Returns their number.
std::size_t drop_unused(TriangleMesh& mesh, const std::vector<bool>& was_used) {
    constexpr std::uint32_t gone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> place(mesh.points.size(), gone);
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) place[corner] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        if (place[v] == gone && was_used[v]) continue;
        mesh.points[kept] = mesh.points[v];
        place[v] = kept++;
    }
    const std::size_t dropped = mesh.points.size() - kept;
    mesh.points.resize(kept);
    for (Triangle& t : mesh.triangles) {
        for (std::uint32_t& corner : t) corner = place[corner];
    }
    return dropped;
}

std::vector<Vec3> some_places(const TriangleMesh& mesh, const SelfIntersections& found) {
    std::vector<Vec3> some;
    for (const IntersectionPlace& place : places_of(mesh, found)) {
        if (some.size() == max_places_listed) break;
        const std::uint32_t first = place.triangles.front();
        const auto pair = std::find_if(found.pairs.begin(), found.pairs.end(),
                                       [&](const auto& p) { return p[0] == first || p[1] == first; });
        some.push_back(pair != found.pairs.end() ? meeting_place(mesh, *pair) : mesh.points[mesh.triangles[first][0]]);
    }
    return some;
}

}  // namespace

Resolved resolve_self_intersections(TriangleMesh& mesh, const ResolveOptions& options, const Context& context,
                                    SourceFaces* sources) {
    assert(mesh.cap_of.empty());
    Resolved result;
    const SelfIntersectionOptions limits{options.max_pairs};
    SelfIntersections found = self_intersections(mesh, limits, context);
    result.pairs = result.left = count_of(found);
    if (found.is_free()) return result;
    std::vector<bool> was_used(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) was_used[corner] = true;
    }
    for (std::size_t pass = 0; pass < options.passes && found.is_complete && result.left > 0; ++pass) {
        ResolvePass resolving(mesh, options);
        const std::vector<IntersectionPlace> places = places_of(mesh, found);
        std::size_t repaired = 0;
        for (std::size_t i = 0; i < places.size(); ++i) {
            context.check_cancelled();
            repaired += resolving.repair_place(places[i]);
            context.progress("self-intersecting places tried", i + 1, places.size());
        }
        if (repaired == 0) break;
        resolving.apply(mesh, sources);
        result.places += repaired;
        result.removed += resolving.removed;
        result.added += resolving.added();
        found = self_intersections(mesh, limits, context);
        result.left = count_of(found);
    }
    result.where_left = some_places(mesh, found);
    if (result.places > 0) result.dropped = drop_unused(mesh, was_used);
    return result;
}

}  // namespace qchopper
