// Distances of corners, because a triangle is never farther from a plane than one of them. For the tools a face is
// small triangles about points of a grid, each with its distance from the rim, moved outwards by what the saw may be
// off at the farthest point of the face: foam between there and the cap is milled by no tool that stays out of it.
// O(caps * triangles), and for caps that are sawn O(points * edges of the rim), at most 10,000 points for a square.

#include "sim/replay/flush_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/text.h"
#include "sim/replay/gouge.h"

namespace qchopper {
namespace {

constexpr double flat = 1e-3;  // mm; piece.stl is single precision
constexpr std::size_t block_faces = SceneCap::faces;
constexpr std::array<const char*, block_faces> face_words{"-x", "+x", "-y", "+y", "top"};
constexpr double touches = 0.01;       // mm; less than that in a tool is not milled
constexpr double finest_grid = 3;      // mm
constexpr double points_along = 100;   // a grid of a large face is coarser
constexpr double half_triangle = 0.5;  // mm

struct CapSurface {
    double area_mm2 = 0;
    std::array<double, block_faces> farthest{};  // of its points, from each face of the block
    std::vector<std::size_t> triangles;
};

CapSurface surface_of(const SceneCap& cap, const ReplayScene& scene) {
    CapSurface surface;
    const TriangleMesh& mesh = *scene.target;
    const Box& block = scene.block;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_in_plane(mesh, t, cap.point, cap.outward)) continue;
        surface.triangles.push_back(t);
        surface.area_mm2 += norm(area_vector(mesh, t));
        for (const Vec3 p : corners_of(mesh, t)) {
            const std::array<double, block_faces> away{p.x - block.min.x, block.max.x - p.x, p.y - block.min.y,
                                                       block.max.y - p.y, block.max.z - p.z};
            for (std::size_t f = 0; f < block_faces; ++f) {
                surface.farthest[f] = std::max(surface.farthest[f], std::abs(away[f]));
            }
        }
    }
    return surface;
}

std::string name_of(const SceneCap& cap) {
    return "the cap of cut " + std::to_string(cap.cut);
}

void check_named(const SceneCap& cap, const CapSurface& surface, const ReplayScene& scene, FindingLog& log) {
    const std::string said = " is said to be face " + std::string(face_words[*cap.face]) + " of the block, and ";
    if (!(surface.area_mm2 > 0)) {
        constexpr double nothing = std::numeric_limits<double>::infinity();
        log.add(FindingKind::flush_face, {}, 0, nothing,
                [&] { return name_of(cap) + said + "the piece has no surface in its plane"; });
        return;
    }
    const double away = surface.farthest[*cap.face];
    const double most = scene.flush_tolerance + flush_slack;
    if (away <= most + flat) return;
    log.add(FindingKind::flush_face, {}, away, away, [&] {
        return name_of(cap) + said + "lies up to " + fixed(away, 2) + " mm from it, at most " + fixed(most, 2) +
               " are allowed";
    });
}

// In a cell that keeps no foam at a face, a cap that is milled may lie there.
bool keeps_foam(const ReplayScene& scene, std::size_t face) {
    const Margins& margins = scene.cell->margins;
    return (face == block_faces - 1 ? margins.top : margins.sides) > scene.flush_tolerance;
}

void check_milled(const SceneCap& cap, const CapSurface& surface, const ReplayScene& scene, FindingLog& log) {
    if (surface.area_mm2 <= min_flush_cap) return;
    const double near = scene.flush_tolerance - flush_slack;
    for (std::size_t f = 0; f < block_faces; ++f) {
        const double away = surface.farthest[f];
        if (away > near || !keeps_foam(scene, f)) continue;
        log.add(FindingKind::flush_face, {}, away, near - away, [&] {
            return name_of(cap) + " lies within " + fixed(away, 2) + " mm of face " + face_words[f] +
                   " of the block, and the job does not say that it is sawn";
        });
    }
}

struct Point {
    double x = 0;
    double y = 0;
};
using Edge = std::array<Point, 2>;

double distance(Point p, const Edge& edge) {
    const Point along{edge[1].x - edge[0].x, edge[1].y - edge[0].y};
    const Point from{p.x - edge[0].x, p.y - edge[0].y};
    const double square = along.x * along.x + along.y * along.y;
    const double at = square > 0 ? std::clamp((from.x * along.x + from.y * along.y) / square, 0.0, 1.0) : 0;
    return std::hypot(from.x - at * along.x, from.y - at * along.y);
}

// Where the rim crosses the row at y, by x.
std::vector<double> crossings(const std::vector<Edge>& rim, double y) {
    std::vector<double> at;
    for (const auto& [a, b] : rim) {
        if ((a.y <= y) == (b.y <= y)) continue;
        at.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::sort(at.begin(), at.end());
    return at;
}

// A face that is sawn, moved outwards by what it may be off.
class SawnFace {
 public:
    SawnFace(const SceneCap& cap, const CapSurface& surface, const TriangleMesh& mesh)
        : point_(cap.point), outward_(cap.outward) {
        along_ = normalized(cross(std::abs(outward_.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, outward_));
        across_ = cross(outward_, along_);
        add_rim(surface, mesh);
        add_points(surface.area_mm2);
    }

    // Triangles about the points farther from the rim than a distance.
    void add_inside(double from_rim, TriangleMesh& tiles, std::vector<double>& distances) const {
        for (const auto& [at, far] : points_) {
            if (far <= from_rim) continue;
            const auto first = static_cast<std::uint32_t>(tiles.points.size());
            for (const Point by :
                 {Point{-half_triangle, -half_triangle}, {half_triangle, -half_triangle}, {0, half_triangle}}) {
                tiles.points.push_back(at_ + (at.x + by.x) * along_ + (at.y + by.y) * across_);
            }
            tiles.triangles.push_back({first, first + 1, first + 2});
            distances.push_back(far);
        }
    }

 private:
    Point in_plane(Vec3 p) const { return {dot(p - point_, along_), dot(p - point_, across_)}; }

    // Edges of one triangle of the cap only. `at_` is the origin of the plane, moved outwards.
    void add_rim(const CapSurface& surface, const TriangleMesh& mesh) {
        std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (const std::size_t t : surface.triangles) {
            const Triangle& corner = mesh.triangles[t];
            for (std::size_t k = 0; k < 3; ++k) edges.insert({corner[k], corner[(k + 1) % 3]});
        }
        constexpr double far = std::numeric_limits<double>::infinity();
        low_ = {far, far};
        high_ = {-far, -far};
        for (const auto& [a, b] : edges) {
            if (edges.contains({b, a})) continue;
            rim_.push_back({in_plane(mesh.points[a]), in_plane(mesh.points[b])});
            for (const Point& p : rim_.back()) {
                low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
                high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
            }
        }
        if (rim_.empty()) return;
        const double half = 0.5 * std::hypot(high_.x - low_.x, high_.y - low_.y);
        at_ = point_ + (sawn_beyond + half * sawn_turn) * outward_;
    }

    void add_points(double area_mm2) {
        if (rim_.empty()) return;
        const double step = std::max(finest_grid, std::sqrt(area_mm2) / points_along);
        for (double y = low_.y + 0.5 * step; y < high_.y; y += step) {
            const std::vector<double> between = crossings(rim_, y);
            for (std::size_t k = 0; k + 1 < between.size(); k += 2) {
                const double first = low_.x + step * (std::ceil((between[k] - low_.x) / step - 0.5) + 0.5);
                for (double x = first; x < between[k + 1]; x += step) {
                    double nearest = std::numeric_limits<double>::infinity();
                    for (const Edge& edge : rim_) nearest = std::min(nearest, distance({x, y}, edge));
                    points_.push_back({{x, y}, nearest});
                }
            }
        }
    }

    Vec3 point_;
    Vec3 outward_;
    Vec3 along_;
    Vec3 across_;
    Vec3 at_;
    std::vector<Edge> rim_;
    Point low_;
    Point high_;
    std::vector<std::pair<Point, double>> points_;  // with their distance from the rim
};

ToolPath of_tool(const ToolPath& path, std::uint32_t tool) {
    ToolPath lines;
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        if (path.lines[i].tool != tool) continue;
        lines.lines.push_back(path.lines[i]);
        if (path.before(i) != nullptr && path.before(i)->tool != tool) lines.lines.back().follows_line = false;
    }
    return lines;
}

}  // namespace

bool is_in_plane(const TriangleMesh& mesh, std::size_t triangle, Vec3 point, Vec3 outward) {
    const std::array<Vec3, 3> corners = corners_of(mesh, triangle);
    const auto is_near = [&](Vec3 p) { return std::abs(dot(outward, p - point)) <= flat; };
    return std::all_of(corners.begin(), corners.end(), is_near) && dot(area_vector(mesh, triangle), outward) > 0;
}

void check_flush_faces(const ReplayScene& scene, FindingLog& log) {
    for (const SceneCap& cap : scene.caps) {
        const CapSurface surface = surface_of(cap, scene);
        if (cap.face) {
            check_named(cap, surface, scene, log);
        } else {
            check_milled(cap, surface, scene, log);
        }
    }
}

void check_beside_flush_faces(const ToolPath& path, const ReplayScene& scene, FindingLog& log, const Context& context) {
    std::vector<SawnFace> faces;
    for (const SceneCap& cap : scene.caps) {
        if (cap.face) faces.emplace_back(cap, surface_of(cap, scene), *scene.target);
    }
    if (faces.empty()) return;
    const std::vector<CuttingTool>& tools = scene.cell->machine->tools;
    for (std::uint32_t tool = 0; tool < tools.size(); ++tool) {
        if (is_drill(tools[tool])) continue;
        TriangleMesh tiles;
        std::vector<double> from_rim;
        for (const SawnFace& face : faces) face.add_inside(0.5 * tools[tool].diameter + run_over, tiles, from_rim);
        const ToolPath lines = of_tool(path, tool);
        if (lines.lines.empty() || tiles.triangles.empty()) continue;
        ReplayScene of_faces = scene;
        of_faces.target = &tiles;
        const GougeFigures milled = find_gouges(lines, of_faces, touches, context);
        if (!(milled.largest > 0)) continue;
        double farthest = 0;
        for (std::size_t t = 0; t < from_rim.size(); ++t) {
            if (milled.depth[t] > 0) farthest = std::max(farthest, from_rim[t]);
        }
        log.add(FindingKind::flush_face, milled.place, milled.largest, milled.largest, [&] {
            return "tool " + std::to_string(tools[tool].number) + " comes to a sawn face: " + fixed(milled.largest, 2) +
                   " mm would be milled off it, up to " + fixed(farthest, 1) +
                   " mm from its rim, were the block off by what the saw allows";
        });
    }
}

}  // namespace qchopper
