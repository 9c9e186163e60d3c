// A cap of the piece below is clipped by the later cuts of the piece above. What is then connected lies below one
// single piece, so one point decides whether that is the one. No polygons are intersected but with half-planes, and
// edges that polygons share are clipped once, so outlines follow from the corners' numbers alone. O(n log n) for n
// triangles of both caps.

#include "segment/joint/flat_region.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/plane_section.h"

namespace qchopper {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

struct PolygonCorner {
    std::uint32_t polygon = 0;
    std::uint32_t at = 0;
};
// Half-edges by their ends. Of two alike, in caps that overlap themselves, the last one.
using HalfEdges = std::map<Edge, PolygonCorner>;

HalfEdges half_edges(const FlatPolygons& flat) {
    HalfEdges edges;
    for (std::uint32_t p = 0; p < flat.polygons.size(); ++p) {
        const std::vector<std::uint32_t>& polygon = flat.polygons[p];
        for (std::uint32_t i = 0; i < polygon.size(); ++i) {
            edges[{polygon[i], polygon[(i + 1) % polygon.size()]}] = {p, i};
        }
    }
    return edges;
}

// The edge without neighbour that follows an edge without neighbour: around its end, through the polygons there.
Edge next_on_outline(const FlatPolygons& flat, const HalfEdges& edges, const Edge& edge) {
    Edge turning = edge;
    for (std::size_t turns = 0; turns <= edges.size(); ++turns) {
        const PolygonCorner& corner = edges.at(turning);
        const std::vector<std::uint32_t>& polygon = flat.polygons[corner.polygon];
        const std::size_t size = polygon.size();
        const Edge next{polygon[(corner.at + 1) % size], polygon[(corner.at + 2) % size]};
        const auto neighbour = edges.find({next.second, next.first});
        if (neighbour == edges.end()) return next;
        turning = neighbour->first;
    }
    return edge;
}

// The number of the point where an edge crosses a plane, the same for both polygons of the edge.
class Crossings {
 public:
    Crossings(FlatPolygons& flat, const Plane& plane) : flat_(flat), plane_(plane) {}
    std::uint32_t of(std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = made_.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(flat_.points.size()));
        if (is_new) {
            EdgeEnd upper{flat_.points[a], height(plane_.normal, flat_.points[a])};
            EdgeEnd lower{flat_.points[b], height(plane_.normal, flat_.points[b])};
            if (upper.height < lower.height) std::swap(upper, lower);
            flat_.points.push_back(edge_crossing(upper, lower, plane_.offset));
        }
        return at->second;
    }

 private:
    FlatPolygons& flat_;
    const Plane& plane_;
    std::map<Edge, std::uint32_t> made_;
};

void clip(FlatPolygons& flat, const HalfSpace& half_space) {
    std::vector<std::vector<std::uint32_t>> kept;
    Crossings crossings(flat, half_space.plane);
    const auto is_kept = [&](std::uint32_t p) {
        const bool above = height(half_space.plane.normal, flat.points[p]) >= half_space.plane.offset;
        return above == half_space.above;
    };
    for (const std::vector<std::uint32_t>& polygon : flat.polygons) {
        std::vector<std::uint32_t> part;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const std::uint32_t a = polygon[i];
            const std::uint32_t b = polygon[(i + 1) % polygon.size()];
            if (is_kept(a)) part.push_back(a);
            if (is_kept(a) != is_kept(b)) part.push_back(crossings.of(a, b));
        }
        if (part.size() >= 3) kept.push_back(std::move(part));
    }
    flat.polygons = std::move(kept);
}

double twice_area(const std::vector<Point2>& points, const std::vector<std::uint32_t>& polygon) {
    return 2 * signed_area(points, polygon);
}

std::vector<Point2> flattened_points(const FlatPolygons& flat, const Plane& plane) {
    std::vector<Point2> points;
    points.reserve(flat.points.size());
    for (const Vec3& p : flat.points) points.push_back(on_plane(plane, p));
    return points;
}

// Whether the point is in one of the triangles.
bool is_in_any(const FlatPolygons& flat, const std::vector<Point2>& points, Point2 p) {
    return std::any_of(flat.polygons.begin(), flat.polygons.end(),
                       [&](const std::vector<std::uint32_t>& polygon) { return is_inside(points, polygon, p); });
}

Point2 middle(const std::vector<Point2>& points, const std::vector<std::uint32_t>& polygon) {
    Point2 sum;
    for (const std::uint32_t corner : polygon) sum = {sum.x + points[corner].x, sum.y + points[corner].y};
    const double count = static_cast<double>(polygon.size());
    return {sum.x / count, sum.y / count};
}

// Per polygon the number of its connected part.
std::vector<std::uint32_t> parts_of(const FlatPolygons& flat) {
    const HalfEdges edges = half_edges(flat);
    DisjointSets sets(flat.polygons.size());
    for (const auto& [edge, corner] : edges) {
        const auto neighbour = edges.find({edge.second, edge.first});
        if (neighbour != edges.end()) sets.unite(corner.polygon, neighbour->second.polygon);
    }
    std::vector<std::uint32_t> part(flat.polygons.size());
    for (std::uint32_t p = 0; p < part.size(); ++p) part[p] = sets.root(p);
    return part;
}

// Keeps the connected parts that lie on the cap of the other piece.
void keep_touching(FlatPolygons& flat, const Plane& plane, const FlatPolygons& other) {
    const std::vector<std::uint32_t> part = parts_of(flat);
    const std::vector<Point2> points = flattened_points(flat, plane);
    const std::vector<Point2> other_points = flattened_points(other, plane);
    std::map<std::uint32_t, std::uint32_t> largest;  // polygon of each part
    for (std::uint32_t p = 0; p < part.size(); ++p) {
        std::uint32_t& best = largest.try_emplace(part[p], p).first->second;
        if (twice_area(points, flat.polygons[p]) > twice_area(points, flat.polygons[best])) best = p;
    }
    std::map<std::uint32_t, bool> is_kept;
    for (const auto& [number, p] : largest) {
        is_kept[number] = is_in_any(other, other_points, middle(points, flat.polygons[p]));
    }
    std::vector<std::vector<std::uint32_t>> kept;
    for (std::uint32_t p = 0; p < part.size(); ++p) {
        if (is_kept[part[p]]) kept.push_back(std::move(flat.polygons[p]));
    }
    flat.polygons = std::move(kept);
}

double area_of(const FlatRegion& flat, const CapRegion& region) {
    double area = signed_area(flat.points, flat.loops[region.outer]);
    for (const std::size_t hole : region.holes) area += signed_area(flat.points, flat.loops[hole]);
    return area;
}

}  // namespace

Point2 on_plane(const Plane& plane, Vec3 point) {
    return flattened(frame_across(plane.normal), plane.offset * plane.normal, point);
}

Vec3 from_plane(const Plane& plane, Point2 point) {
    const PlaneFrame frame = frame_across(plane.normal);
    return plane.offset * plane.normal + point.x * frame.u + point.y * frame.v;
}

std::vector<Loop> outlines(const FlatPolygons& flat) {
    const HalfEdges edges = half_edges(flat);
    std::map<Edge, bool> is_open;  // outline edges, and whether they are in no loop yet
    for (const auto& [edge, corner] : edges) {
        if (!edges.contains({edge.second, edge.first})) is_open[edge] = true;
    }
    std::vector<Loop> loops;
    for (auto& [first, open] : is_open) {
        Loop loop;
        Edge edge = first;
        while (is_open[edge]) {
            is_open[edge] = false;
            loop.push_back(edge.first);
            edge = next_on_outline(flat, edges, edge);
        }
        if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
}

FlatPolygons cap_polygons(const Piece& piece, const HalfSpace& half_space) {
    const TriangleMesh& mesh = *piece.mesh;
    FlatPolygons flat;
    std::map<std::uint32_t, std::uint32_t> number;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != half_space.cut) continue;
        std::vector<std::uint32_t> polygon;
        for (const std::uint32_t corner : mesh.triangles[t]) {
            const auto [at, is_new] = number.try_emplace(corner, static_cast<std::uint32_t>(flat.points.size()));
            if (is_new) flat.points.push_back(mesh.points[corner]);
            polygon.push_back(at->second);
        }
        if (half_space.above) std::swap(polygon[1], polygon[2]);
        flat.polygons.push_back(std::move(polygon));
    }
    return flat;
}

namespace {

// With their outlines; regions smaller than this are left out.
FlatRegion region_of(const FlatPolygons& flat, const Plane& plane, double min_mm2) {
    FlatRegion region;
    region.points = flattened_points(flat, plane);
    region.loops = outlines(flat);
    for (CapRegion& part : nest_polygons(region.points, region.loops)) {
        const double area = area_of(region, part);
        if (area < min_mm2) continue;
        region.area_mm2 += area;
        region.regions.push_back(std::move(part));
    }
    return region;
}

}  // namespace

Vec3 middle_of(const FlatRegion& region, const Plane& plane) {
    Vec3 sum;
    double count = 0;
    for (const CapRegion& part : region.regions) {
        for (const std::uint32_t p : region.loops[part.outer]) {
            sum = sum + from_plane(plane, region.points[p]);
            ++count;
        }
    }
    return 1 / count * sum;
}

FlatRegion contact_region(const Piece& below, const HalfSpace& of_below, const Piece& above, const HalfSpace& of_above,
                          double min_mm2) {
    assert(of_below.cut == of_above.cut && !of_below.above && of_above.above);
    FlatPolygons flat = cap_polygons(below, of_below);
    const FlatPolygons other = cap_polygons(above, of_above);
    if (flat.polygons.empty() || other.polygons.empty()) return {};
    const auto later = std::find(above.half_spaces.begin(), above.half_spaces.end(), of_above);
    for (auto half_space = later + 1; half_space < above.half_spaces.end(); ++half_space) clip(flat, *half_space);
    keep_touching(flat, of_below.plane, other);
    return region_of(flat, of_below.plane, min_mm2);
}

}  // namespace qchopper
