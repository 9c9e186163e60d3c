// Per direction the target is turned into the direction's frame, where a tree gives the triangles in the box of a move,
// which reaches up to the top of the target: the shank is swept too. A triangle is bisected as long as its bound leaves
// a deeper point (branch and bound). Moves are shared out in fixed lots, whose results are merged in their order.
// O(moves * (log triangles + triangles near the move * their parts)).

#include "sim/replay/gouge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "base/parallel.h"
#include "segment/mesh/triangle_tree.h"
#include "sim/replay/hole_check.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr std::size_t lot = 512;           // lines
constexpr double flat_cap = 0.05;          // mm, of the corners of a cap from its plane
constexpr double rounding = 1e-6;          // mm, generous
constexpr std::size_t max_parts = 20'000;  // of a triangle; then the bound is taken

struct Part {
    std::array<Vec3, 3> corner;
    double bound = 0;  // the distance of all of its points is at least that
};

Vec3 middle_of(const std::array<Vec3, 3>& t) {
    return (1.0 / 3) * (t[0] + t[1] + t[2]);
}

// Distance at the middle, and a lower bound for the whole part.
double evaluate(const SweptCutter& swept, Part& part) {
    const Vec3 middle = middle_of(part.corner);
    Vec3 gradient;
    const bool is_ball = swept.cutter().shape == ToolShape::ball;
    const double distance = is_ball ? swept.ball_distance(middle, gradient) : swept.distance(middle);
    double radius = 0;
    double slope = 0;
    for (const Vec3 corner : part.corner) {
        radius = std::max(radius, norm(corner - middle));
        slope = std::min(slope, dot(gradient, corner - middle));
    }
    part.bound = distance - (is_ball ? std::min(radius, -slope) : radius);
    if (!is_ball) part.bound = std::max(part.bound, swept.min_from_cylinder(part.corner));
    return distance;
}

// A ball about a triangle.
struct BoundingBall {
    Vec3 middle;
    double radius = 0;
};

BoundingBall bounds_of(const std::array<Vec3, 3>& triangle) {
    BoundingBall bounds{middle_of(triangle), 0};
    for (const Vec3 corner : triangle) bounds.radius = std::max(bounds.radius, norm(corner - bounds.middle));
    return bounds;
}

struct Hit {
    std::uint32_t triangle = 0;
    float depth = 0;
    std::uint32_t line = 0;
};

using Hits = std::unordered_map<std::uint32_t, Hit>;  // by triangle
using StraightPart = std::array<Vec3, 2>;

// How far beside a straight part the ends of others lie, at most.
double farthest_beside(const StraightPart& part, const std::vector<StraightPart>& others) {
    const Vec3 along = part[1] - part[0];
    const double length2 = dot(along, along);
    double farthest = 0;
    for (const StraightPart& other : others) {
        for (const Vec3 end : other) {
            const double place = length2 > 0 ? std::clamp(dot(end - part[0], along) / length2, 0.0, 1.0) : 0;
            farthest = std::max(farthest, norm(end - part[0] - place * along));
        }
    }
    return farthest;
}

class DirectionGouges {
 public:
    DirectionGouges(const ReplayScene& scene, std::size_t orientation)
        : frame_(tool_axis_frame(scene.orientations[orientation].tool_axis)),
          turned_(in_frame(*scene.target, frame_)),
          tree_(turned_) {
        top_ = -1e9;
        for (const Vec3 p : turned_.points) top_ = std::max(top_, p.z);
        bounds_.reserve(turned_.triangles.size());
        for (std::uint32_t t = 0; t < turned_.triangles.size(); ++t)
            bounds_.push_back(bounds_of(corners_of(turned_, t)));
    }
    // The parts of a line one after the other. `hole`: the one that the line drills, whose cap is not asked; nullptr:
    // none.
    void test(const Cutter& cutter, const std::vector<StraightPart>& parts, double floor, std::uint32_t line,
              const SceneHole* hole, Hits& hits) const;

 private:
    static TriangleMesh in_frame(const TriangleMesh& mesh, const Pose& frame) {
        TriangleMesh turned{mesh.points, mesh.triangles, {}, {}};
        for (Vec3& p : turned.points) p = apply_inverse(frame, p);
        return turned;
    }
    struct Asked {
        double floor = 0;
        std::uint32_t line = 0;
        const SceneHole* hole = nullptr;
        double mouth = 0;  // of the hole, its height in this frame
    };
    // Of the swept tool, up to the top of the target.
    FloatBox box_of(const StraightPart* begin, const StraightPart* end, double radius) const;
    void test_triangle(const SweptCutter& swept, Vec3 from, std::uint32_t t, const Asked& asked, Hits& hits) const;

    Pose frame_;
    TriangleMesh turned_;
    TriangleTree tree_;
    std::vector<BoundingBall> bounds_;  // per triangle
    double top_ = 0;
};

FloatBox DirectionGouges::box_of(const StraightPart* begin, const StraightPart* end, double radius) const {
    Box box{(*begin)[0], (*begin)[0]};
    for (const StraightPart* part = begin; part != end; ++part) {
        for (const Vec3 tip : *part) extend(box, tip);
    }
    const Vec3 least{box.min.x - radius, box.min.y - radius, box.min.z};
    return tree_.box_of({least, {box.max.x + radius, box.max.y + radius, top_}, least});
}

// Of a ball a triangle that is nowhere so deep under the whole line that a part could bring it to the floor is asked
// once: a part is nowhere farther from the line than its ends.
void DirectionGouges::test(const Cutter& cutter, const std::vector<StraightPart>& parts_in_setup, double floor,
                           std::uint32_t line, const SceneHole* hole, Hits& hits) const {
    std::vector<StraightPart> parts = parts_in_setup;
    for (StraightPart& part : parts) {
        for (Vec3& tip : part) tip = apply_inverse(frame_, tip);
    }
    const double mouth = hole != nullptr ? apply_inverse(frame_, hole->mouth).z : 0;
    std::vector<std::uint32_t> near;
    const bool is_asked_once = cutter.shape == ToolShape::ball && parts.size() > 1;
    if (is_asked_once) {
        const Vec3 from = parts.front()[0];
        const SweptCutter swept(cutter, parts.front()[1] - from);
        const double beside = farthest_beside(parts.front(), parts) - floor + 2 * rounding;
        tree_.for_each_near(box_of(parts.data(), parts.data() + parts.size(), cutter.radius), [&](std::uint32_t t) {
            const BoundingBall& bounds = bounds_[t];
            if (!swept.is_ball_beyond(bounds.middle - from, bounds.radius + beside)) near.push_back(t);
        });
    }
    for (const StraightPart& part : parts) {
        const SweptCutter swept(cutter, part[1] - part[0]);
        const auto take = [&](std::uint32_t t) { test_triangle(swept, part[0], t, {floor, line, hole, mouth}, hits); };
        if (std::min(part[0].z, part[1].z) > top_) continue;
        if (is_asked_once) {
            std::for_each(near.begin(), near.end(), take);
        } else {
            tree_.for_each_near(box_of(&part, &part + 1, cutter.radius), take);
        }
    }
}

// Of a ball most triangles are nowhere so deep for certain, because the distance changes by no more than that between
// two points.
void DirectionGouges::test_triangle(const SweptCutter& swept, Vec3 from, std::uint32_t t, const Asked& asked,
                                    Hits& hits) const {
    const auto known = hits.find(t);
    const double enough = known == hits.end() ? asked.floor : std::max<double>(asked.floor, known->second.depth);
    const BoundingBall& bounds = bounds_[t];
    const bool is_ball = swept.cutter().shape == ToolShape::ball;
    if (is_ball && swept.is_ball_beyond(bounds.middle - from, bounds.radius - enough + rounding)) return;
    std::array<Vec3, 3> corners = corners_of(turned_, t);
    const auto is_on_mouth = [&](Vec3 corner) { return std::abs(corner.z - asked.mouth) <= flat_cap; };
    if (asked.hole != nullptr && std::all_of(corners.begin(), corners.end(), is_on_mouth)) return;
    for (Vec3& corner : corners) corner = corner - from;
    const double depth = deepest_in(swept, corners, enough);
    if (depth > enough) hits[t] = {t, static_cast<float>(depth), asked.line};
}

// The hole that a line of a drill is on; nullptr: none.
const SceneHole* hole_along(const TipLine& line, const ReplayScene& scene) {
    if (!is_drill(scene.cell->machine->tools[line.tool])) return nullptr;
    const auto found = std::find_if(scene.holes.begin(), scene.holes.end(),
                                    [&](const SceneHole& hole) { return hole.is_due && is_along(hole, line, scene); });
    return found == scene.holes.end() ? nullptr : &*found;
}

// The straight parts of a line that are tested: exact, and what rounding of its corner adds.
std::vector<StraightPart> parts_of(const ToolPath& path, std::size_t i) {
    const TipLine& line = path.lines[i];
    std::vector<StraightPart> parts{{line.from, line.to}};
    if (line.rounding <= 0 || path.after(i) == nullptr) return parts;
    const std::vector<Vec3> way = rounded_way(nullptr, line, path.after(i));
    for (std::size_t k = 1; k + 1 < way.size(); ++k) parts.push_back({way[k], way[k + 1]});
    return parts;
}

}  // namespace

double deepest_in(const SweptCutter& swept, const std::array<Vec3, 3>& triangle, double floor) {
    Part whole{triangle, 0};
    double deepest = std::max(floor, -evaluate(swept, whole));
    if (-whole.bound <= deepest + gouge_resolution) return deepest;
    // A heap, so that the part that may be deepest is divided first, and what is left over is bounded closely.
    std::vector<Part> parts{whole};
    const auto is_shallower = [](const Part& a, const Part& b) { return a.bound > b.bound; };
    for (std::size_t left = max_parts; left > 0; --left) {
        if (parts.empty() || -parts.front().bound <= deepest + gouge_resolution) return deepest;
        std::pop_heap(parts.begin(), parts.end(), is_shallower);
        const std::array<Vec3, 3> c = parts.back().corner;
        parts.pop_back();
        const Vec3 ab = 0.5 * (c[0] + c[1]);
        const Vec3 bc = 0.5 * (c[1] + c[2]);
        const Vec3 ca = 0.5 * (c[2] + c[0]);
        for (const auto& corners :
             {std::array{c[0], ab, ca}, std::array{ab, c[1], bc}, std::array{ca, bc, c[2]}, std::array{bc, ca, ab}}) {
            Part next{corners, 0};
            deepest = std::max(deepest, -evaluate(swept, next));
            if (-next.bound <= deepest + gouge_resolution) continue;
            parts.push_back(next);
            std::push_heap(parts.begin(), parts.end(), is_shallower);
        }
    }
    return parts.empty() ? deepest : std::max(deepest, -parts.front().bound);
}

GougeFigures find_gouges(const ToolPath& path, const ReplayScene& scene, double floor, const Context& context) {
    GougeFigures figures;
    figures.depth.assign(scene.target->triangles.size(), 0);
    std::vector<Cutter> cutters;
    for (const CuttingTool& tool : scene.cell->machine->tools) cutters.push_back(cutter_of(tool));
    std::size_t done = 0;
    std::uint32_t worst = 0;
    for (std::size_t orientation = 0; orientation < scene.orientations.size(); ++orientation) {
        std::vector<std::uint32_t> lines;
        for (std::size_t i = 0; i < path.lines.size(); ++i) {
            if (path.lines[i].orientation == orientation && path.lines[i].is_aligned)
                lines.push_back(static_cast<std::uint32_t>(i));
        }
        if (lines.empty()) continue;
        const DirectionGouges gouges(scene, orientation);
        const std::size_t lots = (lines.size() + lot - 1) / lot;
        constexpr std::size_t at_once = 64;
        for (std::size_t first = 0; first < lots; first += at_once) {
            context.check_cancelled();
            context.progress("moves held against the piece", done, path.lines.size());
            const std::size_t count = std::min(at_once, lots - first);
            std::vector<Hits> hits(count);
            parallel_for(0, count, [&](std::size_t k) {
                const std::size_t end = std::min(lines.size(), (first + k + 1) * lot);
                for (std::size_t i = (first + k) * lot; i < end; ++i) {
                    const SceneHole* hole = hole_along(path.lines[lines[i]], scene);
                    gouges.test(cutters[path.lines[lines[i]].tool], parts_of(path, lines[i]), floor, lines[i], hole,
                                hits[k]);
                }
            });
            for (const auto& of_lot : hits) {
                for (const auto& [triangle, hit] : of_lot) {
                    figures.depth[triangle] = std::max(figures.depth[triangle], hit.depth);
                    if (hit.depth < figures.largest || (hit.depth == figures.largest && hit.line >= worst)) continue;
                    figures.largest = hit.depth;
                    worst = hit.line;
                    figures.at = middle_of(corners_of(*scene.target, triangle));
                }
            }
            done += count * lot;
        }
    }
    if (figures.largest > 0) figures.place = path.lines[worst].place;
    return figures;
}

}  // namespace qchopper
