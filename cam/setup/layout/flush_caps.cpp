// The box of a turn is that of the convex hull of the footprint; of each cap all points are compared with it. A cap is
// tried along the mean of its triangles' normals across the vertical. O(points log points) for the hull.

#include "cam/setup/layout/flush_caps.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "segment/mesh/footprint.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr double min_turn_cap = 400;  // mm2; a smaller cap is not worth a turn of its own
constexpr double same_turn = 1e-12;   // sine squared

// The face of the box within whose tolerance all points lie, if there is one.
std::optional<BlockFace> face_of(const CapPoints& cap, const Pose& piece_in_setup, const Box& box, double tolerance) {
    FlushFaces is_near;
    is_near.fill(true);
    for (const Vec3& in_piece : cap.points) {
        const std::array<double, block_faces> away = inside_faces(box, apply(piece_in_setup, in_piece));
        bool is_any = false;
        for (std::size_t f = 0; f < block_faces; ++f) {
            is_near[f] = is_near[f] && away[f] <= tolerance;
            is_any = is_any || is_near[f];
        }
        if (!is_any) return std::nullopt;
    }
    const auto first = std::find(is_near.begin(), is_near.end(), true);
    return static_cast<BlockFace>(first - is_near.begin());
}

Pose pose_along(Point2 along, Vec3 up) {
    const auto [e1, e2] = frame_under(up);
    const Vec3 x = normalized(along.x * e1 + along.y * e2);
    return {{x, cross(up, x), up}, {}};
}

// The horizontal direction within a cap that is not level; nothing for one that is.
std::optional<Point2> direction_of(const CapPoints& cap, Vec3 up) {
    Vec3 normal;
    for (std::size_t i = 0; i + 2 < cap.points.size(); i += 3) {
        normal = normal + cross(cap.points[i + 1] - cap.points[i], cap.points[i + 2] - cap.points[i]);
    }
    const auto [e1, e2] = frame_under(up);
    const Point2 across{dot(e1, normal), dot(e2, normal)};
    const double length = std::hypot(across.x, across.y);
    if (!(length > 0.5 * norm(normal))) return std::nullopt;  // leans so far that no side of a block lies along it
    return Point2{-across.y / length, across.x / length};
}

// The piece before it is turned about the vertical.
struct Upright {
    std::vector<Point2> hull;  // of its footprint, in frame_under(up)
    double low = 0;            // along up
    double high = 0;

    Box box(Point2 along) const {
        constexpr double far = std::numeric_limits<double>::infinity();
        Box box{{far, far, low}, {-far, -far, high}};
        for (const Point2& p : hull) {
            const double x = along.x * p.x + along.y * p.y;
            const double y = along.x * p.y - along.y * p.x;
            box.min = {std::min(box.min.x, x), std::min(box.min.y, y), low};
            box.max = {std::max(box.max.x, x), std::max(box.max.y, y), high};
        }
        return box;
    }
};

bool is_same_turn(Point2 a, Point2 b) {
    const double sine = a.x * b.y - a.y * b.x;
    const double cosine = a.x * b.x + a.y * b.y;
    return std::min(sine * sine, cosine * cosine) < same_turn;
}

// mm3: the volume of the block that ends at the flush caps, and that for which the area of the others counts.
double cost_of(Point2 along, const Upright& upright, std::span<const CapPoints> caps, Vec3 up, std::int32_t base,
               const Margins& margins, double tolerance) {
    const Box box = upright.box(along);
    double milled = 0;
    for (const CapPoints& cap : caps) milled += cap.cut == base ? 0 : cap.area_mm2;
    FlushFaces faces{};
    for (const FlushCap& cap : flush_caps(caps, pose_along(along, up), box, base, tolerance)) {
        faces[static_cast<std::size_t>(cap.face)] = true;
        milled -= cap.area_mm2;
    }
    const Vec3 size = size_with_foam(box.size(), margins, faces);
    return size.x * size.y * size.z + foam_per_milled_cap * milled;
}

}  // namespace

std::vector<CapPoints> caps_with_points(const TriangleMesh& mesh) {
    std::map<std::int32_t, CapPoints> caps;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::int32_t cut = cap_of(mesh, t);
        if (cut == no_cap) continue;
        CapPoints& cap = caps[cut];
        cap.cut = cut;
        cap.area_mm2 += norm(area_vector(mesh, t));
        for (const Vec3& corner : corners_of(mesh, t)) cap.points.push_back(corner);
    }
    std::vector<CapPoints> all;
    all.reserve(caps.size());
    for (auto& [cut, cap] : caps) all.push_back(std::move(cap));
    return all;
}

std::vector<FlushCap> flush_caps(std::span<const CapPoints> caps, const Pose& piece_in_setup, const Box& box,
                                 std::optional<std::int32_t> base, double tolerance) {
    std::vector<FlushCap> flush;
    for (const CapPoints& cap : caps) {
        if (cap.cut == base) continue;
        const std::optional<BlockFace> face = face_of(cap, piece_in_setup, box, tolerance);
        if (face) flush.push_back({cap.cut, *face, cap.area_mm2});
    }
    return flush;
}

std::array<double, block_faces> area_at_faces(std::span<const FlushCap> caps) {
    std::array<double, block_faces> area{};
    for (const FlushCap& cap : caps) area[static_cast<std::size_t>(cap.face)] += cap.area_mm2;
    return area;
}

std::vector<Point2> turns_to_try(std::span<const CapPoints> caps, std::span<const Vec3> piece, Vec3 up,
                                 std::optional<std::int32_t> base, const Margins& margins, double tolerance) {
    assert(!piece.empty());
    const auto [e1, e2] = frame_under(up);
    std::vector<Point2> footprint;
    footprint.reserve(piece.size());
    for (const Vec3& p : piece) footprint.push_back({dot(e1, p), dot(e2, p)});
    if (!base || caps.empty()) return {smallest_rectangle(std::move(footprint)).along};
    const auto is_lower = [&](Vec3 a, Vec3 b) { return dot(up, a) < dot(up, b); };
    const auto [lowest, highest] = std::minmax_element(piece.begin(), piece.end(), is_lower);
    const Upright upright{convex_hull(std::move(footprint)), dot(up, *lowest), dot(up, *highest)};
    std::vector<Point2> turns;
    for (const CapPoints& cap : caps) {
        if (cap.cut == *base || cap.area_mm2 < min_turn_cap) continue;
        const std::optional<Point2> direction = direction_of(cap, up);
        if (!direction) continue;
        const auto is_known = [&](Point2 turn) { return is_same_turn(turn, *direction); };
        if (std::any_of(turns.begin(), turns.end(), is_known)) continue;
        const Vec3 size = upright.box(*direction).size();
        turns.push_back(size.x >= size.y ? *direction : Point2{-direction->y, direction->x});
    }
    turns.push_back(smallest_rectangle(upright.hull).along);
    std::vector<std::pair<double, Point2>> by_cost;
    by_cost.reserve(turns.size());
    for (const Point2& turn : turns)
        by_cost.emplace_back(cost_of(turn, upright, caps, up, *base, margins, tolerance), turn);
    std::stable_sort(by_cost.begin(), by_cost.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < turns.size(); ++i) turns[i] = by_cost[i].second;
    return turns;
}

}  // namespace qchopper
