// The spindle nose stays where it is while tools are changed: the tip moves by the difference of their lengths.
// O(poses).

#include "sim/replay/walk/gantry_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/text.h"
#include "cam/cell/machine_bodies.h"
#include "sim/replay/walk/program_walk.h"

namespace qchopper {
namespace {

constexpr double pose_step = 5;         // mm
constexpr double home_distance = 0.02;  // mm
constexpr double beyond_travel = 0.1;   // mm

class GantryWalk : public ProgramWalk {
 public:
    GantryWalk(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log)
        : ProgramWalk(program, scene, log),
          setup_in_cell_(scene.orientations.front().setup_in_cell),
          home_(apply_inverse(setup_in_cell_, machine_.start.tip)),
          tip_(home_) {}

 private:
    void take_rapid(const ProgramStep& step) override;
    void take_line(const ProgramStep& step) override;
    void take_tool_change(const ProgramStep& step) override;
    bool is_home(bool /*with_table*/) const override { return norm(tip_ - home_) <= home_distance; }

    std::uint32_t index_of(std::uint32_t number) const;
    void check_tool(const ProgramStep& step);
    void check_first(const ProgramStep& step);
    void check_travel(Vec3 tip, SourcePlace place);
    void check_obstacles(Vec3 from, Vec3 to, SourcePlace place);
    void add_sweep(const std::vector<Vec3>& ways, bool is_checked_only, SourcePlace place);
    void settle_corner();
    std::vector<Vec3> rapid_ways(Vec3 to) const;

    Pose setup_in_cell_;
    Vec3 home_;
    Vec3 tip_;
    std::optional<std::uint32_t> in_spindle_;  // index in CellMachine::tools
    double deviation_ = 0;                     // P of the corner at the end of the last line; 0: it is exact
};

// The way on which both axes go equally fast until one is there, then straight there; both ends included.
std::vector<Vec3> GantryWalk::rapid_ways(Vec3 to) const {
    const Vec3 way = to - tip_;
    const double both = std::min(std::abs(way.x), std::abs(way.y));
    const Vec3 middle{tip_.x + std::copysign(both, way.x), tip_.y + std::copysign(both, way.y), tip_.z};
    if (way.z != 0 || both == 0) return {tip_, to};
    return {tip_, middle, to, tip_, to};
}

void GantryWalk::add_sweep(const std::vector<Vec3>& ways, bool is_checked_only, SourcePlace place) {
    const double rapid_feed = std::max(1.0, machine_.program.link_feed_mm_per_s);
    JointSweep sweep{{}, place, tool_, 0, is_checked_only, use_};
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
        const double length = norm(ways[i + 1] - ways[i]);
        const auto count = static_cast<std::size_t>(std::ceil(std::min(length / pose_step, 1e5))) + 1;
        for (std::size_t k = 0; k <= count; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(count);
            sweep.poses.push_back({ways[i] + share * (ways[i + 1] - ways[i]), {0, 0, 1}});
        }
        check_obstacles(ways[i], ways[i + 1], place);
    }
    if (!is_checked_only) sweep.seconds = norm(ways.back() - tip_) / rapid_feed;
    path_.order.push_back({false, path_.sweeps.size()});
    path_.sweeps.push_back(std::move(sweep));
}

void GantryWalk::take_rapid(const ProgramStep& step) {
    Vec3 to = tip_;
    for (int i = 0; i < 3; ++i) {
        if ((step.given >> static_cast<unsigned>(i) & 1U) != 0) to[i] = step.values[static_cast<std::size_t>(i)];
    }
    check_tool(step);
    check_first(step);
    // A chunk may be started from home: that way along X and Y is looked at, and not gone.
    if (is_in_chunk_ && free_from_home_.line > 0 && std::hypot(to.x - tip_.x, to.y - tip_.y) > 0) {
        const SourcePlace comment = std::exchange(free_from_home_, {});
        const Vec3 tip = std::exchange(tip_, {home_.x, home_.y, to.z});
        if (norm(tip - tip_) > home_distance) add_sweep(rapid_ways(to), true, comment);
        tip_ = tip;
    }
    add_sweep(rapid_ways(to), false, step.place);
    tip_ = to;
    check_travel(tip_, step.place);
    has_moved_ = true;
    follows_line_ = false;
}

// The program begins with a rapid up to the height of home, then over to it.
void GantryWalk::check_first(const ProgramStep& step) {
    if (has_moved_) return;
    const bool goes_up = step.given == 0b100 && std::abs(step.values[2] - home_.z) <= home_distance;
    if (goes_up) return;
    log_.add(FindingKind::not_home, step.place,
             "the first move does not lead home, expected: a G0 to the height of the start of the cell file");
}

void GantryWalk::take_line(const ProgramStep& step) {
    const ModalState& state = program_.states[step.state];
    check_tool(step);
    const Vec3 to{step.values[0], step.values[1], step.values[2]};
    const bool is_tilted = norm(scene_.orientations[direction_].tool_axis - Vec3{0, 0, 1}) > 1e-9;
    if (is_tilted) {
        log_.add(FindingKind::tool_axis, step.place,
                 "the orientation of the chunk is tilted, and a gantry tilts nothing");
    }
    TipLine line;
    line.from = tip_;
    line.to = to;
    line.place = step.place;
    line.chunk = chunk_;
    line.tool = tool_;
    line.orientation = direction_;
    line.feed = state.feed;
    line.acceleration = machine_.program.acceleration;
    line.is_aligned = !is_tilted;
    line.follows_line = follows_line_;
    line.signals = signals_.in_chunk();
    line.hole = step.hole;
    line.use = use_;
    path_.order.push_back({true, path_.lines.size()});
    path_.lines.push_back(line);
    settle_corner();
    deviation_ = step.is_rounded ? state.rounding : 0;
    check_obstacles(tip_, to, step.place);
    tip_ = to;
    check_travel(tip_, step.place);
    follows_line_ = true;
}

// The corner where the last line begins: where the line before it is left.
void GantryWalk::settle_corner() {
    const std::size_t i = path_.lines.size() - 1;
    if (!path_.lines[i].follows_line || deviation_ <= 0) return;
    TipLine& before = path_.lines[i - 1];
    const Vec3 a = before.to - before.from;
    const Vec3 b = path_.lines[i].to - before.to;
    if (!(norm(a) > 0) || !(norm(b) > 0)) return;
    const double cosine = 0.5 * norm((1 / norm(b)) * b - (1 / norm(a)) * a);
    const double half = 0.5 * std::min(norm(a), norm(b));
    before.rounding = 2 * deviation_ >= half * cosine ? half : 2 * deviation_ / cosine;
}

std::uint32_t GantryWalk::index_of(std::uint32_t number) const {
    for (std::size_t i = 0; i < machine_.tools.size(); ++i) {
        if (machine_.tools[i].number == number) return static_cast<std::uint32_t>(i);
    }
    return std::numeric_limits<std::uint32_t>::max();
}

void GantryWalk::take_tool_change(const ProgramStep& step) {
    check_stop(step.place);
    const std::uint32_t next = index_of(step.number);
    if (next >= machine_.tools.size()) {
        log_.add(FindingKind::tool_change, step.place, step.number, 0,
                 [&] { return "T" + std::to_string(step.number) + " is no tool of the cell file"; });
        return;
    }
    if (in_spindle_) tip_.z -= gauge_length(machine_.tools[next]) - gauge_length(machine_.tools[*in_spindle_]);
    in_spindle_ = next;
    follows_line_ = false;
}

// The tool of the chunk is in the spindle, and its length is that of the register.
void GantryWalk::check_tool(const ProgramStep& step) {
    const ModalState& state = program_.states[step.state];
    const std::uint32_t number = is_in_chunk_ ? tool().number : state.tool_number;
    if (state.tool_number != number) {
        log_.add(FindingKind::tool_change, step.place, state.tool_number, 0, [&] {
            return "T" + std::to_string(state.tool_number) + " is in the spindle, the chunk is of tool " +
                   std::to_string(number);
        });
    }
    if (state.length_register == number) return;
    log_.add(FindingKind::tool_frame, step.place, state.length_register, 0, [&] {
        return "G43 takes the length of H" + std::to_string(state.length_register) + ", expected: H" +
               std::to_string(number);
    });
}

void GantryWalk::check_travel(Vec3 tip, SourcePlace place) {
    const Vec3 in_cell = apply(setup_in_cell_, tip);
    const Box& travel = scene_.cell->workspace;
    double beyond = 0;
    for (int axis = 0; axis < 3; ++axis) {
        beyond = std::max({beyond, travel.min[axis] - in_cell[axis], in_cell[axis] - travel.max[axis]});
    }
    if (beyond <= beyond_travel) return;
    log_.add(FindingKind::outside_reach, place, beyond, beyond,
             [&] { return "the tip goes " + fixed(beyond, 1) + " mm beyond the travel of the machine"; });
}

// The box around each body on its way, against each obstacle; on a diagonal in pieces.
void GantryWalk::check_obstacles(Vec3 from, Vec3 to, SourcePlace place) {
    constexpr double piece = 20;  // mm
    const std::vector<Obstacle>& obstacles = machine_.obstacles;
    if (obstacles.empty()) return;
    const auto count = static_cast<std::size_t>(std::ceil(std::min(norm(to - from) / piece, 1e4))) + 1;
    for (const AxisBody& body : bodies_over_tip(tool(), machine_)) {
        const double radius = body.shape.radius;
        const double low = std::min(-body.shape.from.z, -body.shape.to.z);
        const double high = std::max(-body.shape.from.z, -body.shape.to.z);
        for (std::size_t k = 0; k < count; ++k) {
            const Vec3 a = apply(setup_in_cell_, from + (static_cast<double>(k) / count) * (to - from));
            const Vec3 b = apply(setup_in_cell_, from + (static_cast<double>(k + 1) / count) * (to - from));
            for (const Obstacle& obstacle : obstacles) {
                const auto apart = [&](int axis, double below, double above) {
                    return std::max(a[axis], b[axis]) + above < obstacle.box.min[axis] ||
                           std::min(a[axis], b[axis]) + below > obstacle.box.max[axis];
                };
                if (apart(0, -radius, radius) || apart(1, -radius, radius) || apart(2, low, high)) continue;
                return log_.add(FindingKind::collision, place, "tool, holder or spindle meets an obstacle");
            }
        }
    }
}

}  // namespace

ToolPath walk_gantry(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log, const Context& context) {
    return GantryWalk(program, scene, log).run(context);
}

}  // namespace qchopper
