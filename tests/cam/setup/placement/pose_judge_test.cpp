// The judge of poses against a plain second implementation: a chain of frames, speeds by differences, and distances
// from points that are spread densely over the bodies.

#include "cam/setup/placement/pose_judge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>

#include "cam/setup/block_placement.h"
#include "cam/setup/holder_clearance.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degrees = 180 / pi;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name);
}

Pose about(char axis, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    if (axis == 'z') return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
    return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}}, {}};
}

Pose shifted(Vec3 by) {
    return {Pose{}.row, by};
}

// Frames behind each axis, from the base to the flange, as the paper of arm.h draws the arm.
std::array<Pose, 7> chain(const ArmGeometry& g, const Joints& q) {
    const auto t = [&](std::size_t i) { return g.sign[i] * q[i] - g.offset[i]; };
    std::array<Pose, 7> frames;
    frames[1] = about('z', t(0));
    frames[2] = frames[1] * shifted({g.a1, 0, g.c1}) * about('y', t(1));
    frames[3] = frames[2] * shifted({0, 0, g.c2}) * about('y', t(2));
    frames[4] = frames[3] * shifted({g.a2, g.b, g.c3}) * about('z', t(3));
    frames[5] = frames[4] * about('y', t(4));
    frames[6] = frames[5] * about('z', t(5)) * shifted({0, 0, g.c4});
    return frames;
}

// Where the frame of a link lies while the arm stands straight up.
Vec3 origin_upright(const ArmGeometry& g, int link) {
    switch (link) {
        case 2:
            return {g.a1, 0, g.c1};
        case 3:
            return {g.a1, 0, g.c1 + g.c2};
        case 4:
        case 5:
            return {g.a1 + g.a2, g.b, g.c1 + g.c2 + g.c3};
        case 6:
            return {g.a1 + g.a2, g.b, g.c1 + g.c2 + g.c3 + g.c4};
        default:
            return {};
    }
}

// A body as a predicate of distance from a point, and as a cloud of points.
struct PlainBody {
    bool is_round = false;  // a capsule
    Vec3 from;
    Vec3 to;
    double radius = 0;
    double distance_of(Vec3 p) const {
        const Vec3 axis = normalized(to - from);
        const double length = norm(to - from);
        const double along = dot(p - from, axis);
        const double across = norm((p - from) - along * axis);
        const double beyond = std::max({-along, along - length, 0.0});
        if (is_round) return std::max(0.0, std::hypot(beyond, across) - radius);
        return std::hypot(beyond, std::max(0.0, across - radius));
    }
    // Of a capsule the points of its axis, whose distance is less by the radius; of a cylinder those of its surface.
    std::vector<Vec3> points() const {
        std::vector<Vec3> all;
        const Vec3 axis = normalized(to - from);
        const Vec3 x = normalized(cross(axis, std::abs(axis.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
        const Vec3 y = cross(axis, x);
        const int steps = static_cast<int>(std::ceil(norm(to - from) / (is_round ? 1 : 5)));
        for (int i = 0; i <= steps; ++i) {
            const Vec3 middle = from + (static_cast<double>(i) / steps) * (to - from);
            if (is_round) {
                all.push_back(middle);
                continue;
            }
            const bool is_end = i == 0 || i == steps;
            for (double r = radius; r > 0; r -= 5) {
                const int around = static_cast<int>(std::ceil(2 * pi * r / 5));
                for (int k = 0; k < around; ++k) {
                    const double a = 2 * pi * k / around;
                    all.push_back(middle + r * std::cos(a) * x + r * std::sin(a) * y);
                }
                if (!is_end) break;
            }
        }
        return all;
    }
};

double outside(const PlacedBox& box, Vec3 p) {
    const Vec3 own = apply_inverse(box.box_in_frame, p);
    Vec3 off;
    for (int i = 0; i < 3; ++i) off[i] = std::max(0.0, std::abs(own[i]) - box.half[i]);
    return norm(off);
}

template <class Distance>
double least(const PlainBody& body, const Distance& distance) {
    double found = 1e9;
    for (const Vec3& p : body.points()) found = std::min(found, distance(p));
    return std::max(0.0, found - (body.is_round ? body.radius : 0));
}

// Smallest margin by check; absent where nothing was to be checked.
using PlainMargins = std::array<double, pose_checks>;

class PlainJudge {
 public:
    PlainJudge(const Cell& cell, const CuttingTool& tool, const StandingBlock& block)
        : cell_(cell), machine_(*cell.machine), robot_(*machine_.robot), tool_(tool), block_(block) {}

    PlainMargins judge(const Joints& given, Vec3 tip_in_setup, Vec3 tool_axis_in_setup) {
        margins_.fill(1e9);
        Joints q = given;
        for (std::size_t axis = 0; axis < 6; ++axis) q[axis] = best_turn(robot_.ranges[axis], q[axis]);
        frames_ = chain(robot_.geometry, q);
        for (Pose& frame : frames_) frame = robot_.base_in_cell * frame;
        limits(q);
        singularities(q);
        speeds(q);
        bodies();
        arm();
        tool();
        const double sine = std::hypot(tool_axis_in_setup.x, tool_axis_in_setup.y);
        double above = tool_.stick_out;
        for (const HolderStep& step : tool_.holder) {
            keep(PoseCheck::holder_to_block, tip_in_setup.z + above * tool_axis_in_setup.z - sine * step.diameter / 2);
            above += step.length;
        }
        keep(PoseCheck::holder_to_block,
             tip_in_setup.z + above * tool_axis_in_setup.z - sine * machine_.spindle.body_radius);
        return margins_;
    }

 private:
    void keep(PoseCheck check, double measured) {
        double& own = margins_[static_cast<std::size_t>(check)];
        own = std::min(own, measured - rule_of(check).needed);
    }

    // Of all turns of an axis that which lies deepest in its range.
    static double best_turn(const JointRange& range, double joint) {
        double best = joint;
        const auto inside = [&](double q) { return std::min(q - range.min, range.max - q); };
        for (const double q : {joint - 2 * pi, joint + 2 * pi}) best = inside(q) > inside(best) ? q : best;
        return best;
    }

    void limits(const Joints& q) {
        for (std::size_t i = 0; i < 6; ++i) {
            keep(PoseCheck::joint_limit, degrees * std::min(q[i] - robot_.ranges[i].min, robot_.ranges[i].max - q[i]));
        }
        keep(PoseCheck::cable, degrees * std::min(q[3] - robot_.cable->axis_4.min, robot_.cable->axis_4.max - q[3]));
        keep(PoseCheck::cable, degrees * std::min(q[5] - robot_.cable->axis_6.min, robot_.cable->axis_6.max - q[5]));
    }

    void singularities(const Joints& q) {
        const ArmSingularity near = singularity(robot_.geometry, q);
        keep(PoseCheck::wrist, degrees * std::asin(near.wrist));
        keep(PoseCheck::shoulder, near.shoulder);
        keep(PoseCheck::elbow, 100 * near.elbow);
        const ArmGeometry& g = robot_.geometry;
        const double fore = std::hypot(g.a2, g.c3);
        const double apart = norm(frames_[4].shift - apply(frames_[1], {g.a1, g.b, g.c1}));
        keep(PoseCheck::reach, std::min(g.c2 + fore - apart, apart - std::abs(g.c2 - fore)));
    }

    // Over 2,000 directions, the joints that follow by differences.
    void speeds(const Joints& q) {
        constexpr double step = 1e-6;
        const Pose flange = frames_[6];
        Jacobian columns{};
        for (std::size_t axis = 0; axis < 6; ++axis) {
            Joints moved = q;
            moved[axis] += step;
            const Pose after = robot_.base_in_cell * chain(robot_.geometry, moved)[6];
            const Vec3 linear = (1 / step) * (after.shift - flange.shift);
            Pose turn;
            const Pose back = inverse(flange);
            turn = after * back;
            const Vec3 angular = (0.5 / step) * Vec3{turn.row[2].y - turn.row[1].z, turn.row[0].z - turn.row[2].x,
                                                     turn.row[1].x - turn.row[0].y};
            for (int i = 0; i < 3; ++i) {
                columns[static_cast<std::size_t>(i)][axis] = linear[i];
                columns[static_cast<std::size_t>(i) + 3][axis] = 1000 * angular[i];
            }
        }
        std::array<Joints, 3> per_axis{};
        for (std::size_t i = 0; i < 3; ++i) {
            std::array<double, 6> wanted{};
            wanted[i] = tool_.feed_max_mm_per_s;
            per_axis[i] = solve(columns, wanted);
        }
        for (int i = 0; i < 2000; ++i) {
            const double z = 1 - (2.0 * i + 1) / 2000;
            const double a = i * pi * (3 - std::sqrt(5.0));
            const double r = std::sqrt(1 - z * z);
            for (std::size_t axis = 0; axis < 6; ++axis) {
                const double speed =
                    r * std::cos(a) * per_axis[0][axis] + r * std::sin(a) * per_axis[1][axis] + z * per_axis[2][axis];
                keep(PoseCheck::joint_speed, degrees * (robot_.ranges[axis].speed - std::abs(speed)));
            }
        }
    }

    // Gauss and Jordan.
    static Joints solve(Jacobian a, std::array<double, 6> b) {
        for (std::size_t i = 0; i < 6; ++i) {
            std::size_t pivot = i;
            for (std::size_t r = i; r < 6; ++r) pivot = std::abs(a[r][i]) > std::abs(a[pivot][i]) ? r : pivot;
            std::swap(a[i], a[pivot]);
            std::swap(b[i], b[pivot]);
            for (std::size_t r = 0; r < 6; ++r) {
                if (r == i) continue;
                const double f = a[r][i] / a[i][i];
                for (std::size_t c = i; c < 6; ++c) a[r][c] -= f * a[i][c];
                b[r] -= f * b[i];
            }
        }
        for (std::size_t i = 0; i < 6; ++i) b[i] /= a[i][i];
        return b;
    }

    void bodies() {
        links_.clear();
        for (const LinkCapsule& own : robot_.capsules) {
            const Vec3 origin = origin_upright(robot_.geometry, own.link);
            const Pose& frame = frames_[static_cast<std::size_t>(own.link)];
            const Capsule& c = own.shape;
            links_.push_back({true, apply(frame, c.from - origin), apply(frame, c.to - origin), c.radius});
        }
        const Pose nose = frames_[6] * machine_.spindle.spindle_in_flange;
        const auto along = [&](double z) { return apply(nose, {0, 0, z}); };
        double z = 0;
        on_axis_.clear();
        on_axis_.push_back({false, along(0), along(-machine_.spindle.body_length), machine_.spindle.body_radius});
        for (auto step = tool_.holder.rbegin(); step != tool_.holder.rend(); ++step) {
            on_axis_.push_back({false, along(z), along(z + step->length), step->diameter / 2});
            z += step->length;
        }
        on_axis_.push_back({false, along(z), along(z + tool_.stick_out), tool_.diameter / 2});
    }

    double from_table(Vec3 p) const {
        if (const auto& rotary = machine_.rotary_table) {
            const Vec3 own = apply_inverse(rotary->table_in_cell, p);
            const double up = std::max({own.z, -own.z - rotary->table_in_cell.shift.z, 0.0});
            return std::hypot(up, std::max(0.0, std::hypot(own.x, own.y) - rotary->radius));
        }
        const Table& t = cell_.table;
        return norm(Vec3{std::max(0.0, std::abs(p.x - t.centre_x) - t.size_x / 2),
                         std::max(0.0, std::abs(p.y - t.centre_y) - t.size_y / 2),
                         std::max({0.0, p.z - t.height, -p.z})});
    }

    double from_obstacles(Vec3 p) const {
        double found = 1e9;
        for (const Obstacle& o : machine_.obstacles) {
            Vec3 off;
            for (int i = 0; i < 3; ++i) off[i] = std::max({o.box.min[i] - p[i], p[i] - o.box.max[i], 0.0});
            found = std::min(found, norm(off));
        }
        return found;
    }

    // Links 2, 3 and 5 in this order, of which 2 and 5 may not touch.
    void arm() {
        for (const PlainBody& link : links_) {
            keep(PoseCheck::arm_to_floor, std::min(link.from.z, link.to.z) - link.radius);
            // Link 5 is over the tip as the spindle is, and may come where foam has been removed.
            if (&link != &links_[2]) {
                keep(PoseCheck::arm_to_block, least(link, [&](Vec3 p) { return outside(block_.block, p); }));
            }
            keep(PoseCheck::arm_to_table, least(link, [&](Vec3 p) { return from_table(p); }));
            if (!machine_.obstacles.empty()) {
                keep(PoseCheck::arm_to_obstacle, least(link, [&](Vec3 p) { return from_obstacles(p); }));
            }
        }
        keep(PoseCheck::arm_to_arm, least(links_[2], [&](Vec3 p) { return links_[0].distance_of(p); }));
    }

    void tool() {
        for (std::size_t i = 0; i < on_axis_.size(); ++i) {
            const PlainBody& body = on_axis_[i];
            keep(PoseCheck::tool_to_table, least(body, [&](Vec3 p) { return from_table(p); }));
            if (!machine_.obstacles.empty()) {
                keep(PoseCheck::tool_to_obstacle, least(body, [&](Vec3 p) { return from_obstacles(p); }));
            }
            double low = 1e9;
            for (const Vec3& p : body.points()) low = std::min(low, p.z);
            keep(PoseCheck::tool_to_floor, low);
            keep(PoseCheck::tool_to_arm, least(body, [&](Vec3 p) { return links_[0].distance_of(p); }));
            // The first is the spindle, which may come to the forearm.
            if (i > 0) keep(PoseCheck::tool_to_arm, least(body, [&](Vec3 p) { return links_[1].distance_of(p); }));
        }
    }

    const Cell& cell_;
    const CellMachine& machine_;
    const Robot& robot_;
    const CuttingTool& tool_;
    const StandingBlock& block_;
    std::array<Pose, 7> frames_;
    std::vector<PlainBody> links_;
    std::vector<PlainBody> on_axis_;
    PlainMargins margins_{};
};

double tolerance(PoseCheck check) {
    switch (check) {
        case PoseCheck::joint_limit:
        case PoseCheck::cable:
        case PoseCheck::wrist:
        case PoseCheck::shoulder:
        case PoseCheck::elbow:
        case PoseCheck::reach:
        case PoseCheck::holder_to_block:
        case PoseCheck::arm_to_floor:
            return 1e-5;
        case PoseCheck::joint_speed:
            return 2;  // degrees/s, of the directions
        default:
            return 5;  // mm, between the points
    }
}

struct Verdicts {
    int held = 0;
    int refused = 0;
    int unsure = 0;
};

// Poses over the table, as far as joints hold them.
void compare(const Cell& cell, int count, std::mt19937& random, Verdicts& verdicts) {
    const CuttingTool& tool = longest_tool(cell.machine->tools);
    PoseJudge judge(cell, tool);
    const Robot& robot = *cell.machine->robot;
    const ToolArm arm = tool_arm(robot, cell.machine->spindle, tool);
    const Pose setup = setup_in_cell(cell, 12, {20, -30, 0.3, {}}, 0);
    const StandingBlock block = judge.standing(setup, {{-150, -200, -12}, {150, 200, 238}});
    std::uniform_real_distribution<double> unit(0, 1);
    for (int done = 0; done < count;) {
        const double z = 0.2 + 0.8 * unit(random);
        const double a = 2 * pi * unit(random);
        const Vec3 tool_axis{std::sqrt(1 - z * z) * std::cos(a), std::sqrt(1 - z * z) * std::sin(a), z};
        const Vec3 tip{900 * (unit(random) - 0.5), 900 * (unit(random) - 0.5), 500 * unit(random) - 30};
        const double turn = 2 * pi * unit(random) - pi;
        const Pose flange =
            inverse(robot.base_in_cell) * setup * tip_frame(tip, tool_axis, turn) * inverse(arm.tip_in_flange);
        const ArmAnswers answers = inverse(robot.geometry, flange);
        if (answers.empty()) continue;
        const ArmAnswer& answer = answers[static_cast<std::size_t>(done) % answers.size()];
        // The joints do what they are asked for, by the plain chain.
        const Pose plain = chain(robot.geometry, answer.joints)[6];
        ASSERT_LT(norm(plain.shift - flange.shift), 1e-5);
        ++done;
        MarginTally tally;
        ArmPosture posture{answer.configuration, turn, false};
        const PoseRegion region{{{PoseKind::tip, tip, 0}}, 1};
        judge.judge(block, tool_axis, region, 1, posture, -1e9, tally);
        const PlainMargins expected = PlainJudge(cell, tool, block).judge(answer.joints, tip, tool_axis);
        bool is_held = true;
        bool is_sure = true;
        bool is_refused = false;
        for (std::size_t c = 0; c < pose_checks; ++c) {
            const auto check = static_cast<PoseCheck>(c);
            const TightestMargin& own = tally.of(check);
            EXPECT_EQ(std::isfinite(own.relative), expected[c] < 1e8) << rule_of(check).key;
            if (!std::isfinite(own.relative)) continue;
            EXPECT_NEAR(own.margin, expected[c], tolerance(check)) << rule_of(check).key;
            is_held = is_held && own.relative >= -1e-9;
            is_refused = is_refused || expected[c] < -tolerance(check);
            is_sure = is_sure && std::abs(expected[c]) >= tolerance(check);
        }
        verdicts.unsure += is_sure ? 0 : 1;
        if (is_sure || is_refused) {
            EXPECT_EQ(is_held, !is_refused);
        }
        (is_held ? verdicts.held : verdicts.refused) += 1;
    }
}

TEST(PoseJudge, AgreesWithAPlainSecondImplementationOnAThousandPoses) {
    std::mt19937 random(11);
    Verdicts verdicts;
    compare(ready_cell("kr60-ha.toml"), 334, random, verdicts);
    compare(ready_cell("irb6640-185-2.8.toml"), 333, random, verdicts);
    compare(ready_cell("kr120-r2500-pro-rotary.toml"), 333, random, verdicts);
    EXPECT_GT(verdicts.held, 100);
    EXPECT_GT(verdicts.refused, 300);
    EXPECT_LT(verdicts.unsure, 100);
}

// Counts those of many poses all over a cell that one check alone refuses.
void count_refused_alone(double speed, std::array<int, pose_checks>& alone) {
    Cell cell = ready_cell("kr120-r2500-pro-rotary.toml");
    Robot& robot = *cell.machine->robot;
    for (JointRange& range : robot.ranges) range.speed *= speed;
    robot.base_in_cell.shift.z = 200;
    robot.cable->axis_4 = {-2, 2};
    cell.machine->spindle.spindle_in_flange = Pose{{Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}}, {350, 0, 100}};
    cell.machine->obstacles.push_back({"beam", {{200, -1500, 1700}, {1700, 1500, 1800}}});
    PoseJudge judge(cell, longest_tool(cell.machine->tools));
    const ToolArm arm = tool_arm(robot, cell.machine->spindle, longest_tool(cell.machine->tools));
    const Pose setup = setup_in_cell(cell, 12, {}, 0);
    const StandingBlock block = judge.standing(setup, {{-150, -200, -12}, {150, 200, 238}});
    std::mt19937 random(4);
    for (int i = 0; i < 60'000; ++i) {
        Joints joints{};
        for (std::size_t axis = 0; axis < 6; ++axis) {
            const JointRange& range = robot.ranges[axis];
            joints[axis] = std::uniform_real_distribution<double>(range.min - 0.05, range.max + 0.05)(random);
        }
        const Pose tip = inverse(setup) * robot.base_in_cell * forward(robot.geometry, joints) * arm.tip_in_flange;
        const Vec3 tool_axis = -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z};
        const Pose level = tip_frame({}, tool_axis, 0);
        const Vec3 x{tip.row[0].x, tip.row[1].x, tip.row[2].x};
        const double turn = std::atan2(dot(Vec3{level.row[0].y, level.row[1].y, level.row[2].y}, x),
                                       dot(Vec3{level.row[0].x, level.row[1].x, level.row[2].x}, x));
        ArmPosture posture{configuration_of(robot.geometry, joints), turn, false};
        MarginTally tally;
        judge.judge(block, tool_axis, {{{PoseKind::tip, tip.shift, 0}}, 1}, 1, posture, -1e9, tally);
        std::vector<std::size_t> refusing;
        for (std::size_t c = 0; c < pose_checks; ++c) {
            if (tally.of(static_cast<PoseCheck>(c)).relative < 0) refusing.push_back(c);
        }
        if (refusing.size() == 1) ++alone[refusing.front()];
    }
}

TEST(PoseJudge, HasNoCheckThatOthersMakeNeedless) {
    std::array<int, pose_checks> alone{};
    count_refused_alone(0.3, alone);
    count_refused_alone(3, alone);
    for (const PoseCheck check :
         {PoseCheck::joint_limit, PoseCheck::cable, PoseCheck::shoulder, PoseCheck::elbow, PoseCheck::wrist,
          PoseCheck::joint_speed, PoseCheck::arm_to_block, PoseCheck::arm_to_table, PoseCheck::arm_to_floor,
          PoseCheck::arm_to_obstacle, PoseCheck::arm_to_arm, PoseCheck::holder_to_block, PoseCheck::tool_to_table,
          PoseCheck::tool_to_obstacle, PoseCheck::tool_to_arm}) {
        EXPECT_GT(alone[static_cast<std::size_t>(check)], 0) << rule_of(check).key;
    }
}

}  // namespace
}  // namespace qchopper
