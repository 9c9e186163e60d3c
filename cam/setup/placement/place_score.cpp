// Branches, turns and angles are tried one after another, what was best at the last place first; each is left as soon
// as it is known to be worse than the best so far. Home while a rotary table turns is judged only of blocks that come
// so near to it, turned as the table can, that it may be the worst. O(regions * configurations * turns * angles *
// poses) at most.

#include "cam/setup/placement/place_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/units.h"
#include "cam/cell/machine_bodies.h"
#include "cam/cell/shape_distance.h"
#include "cam/setup/holder_clearance.h"

namespace qchopper {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double table_step = 15 * degree;
constexpr int table_angles = 24;

}  // namespace

std::vector<ArmConfiguration> all_configurations() {
    std::vector<ArmConfiguration> configurations;
    for (const bool back : {false, true}) {
        for (const bool elbow : {false, true}) {
            for (const bool wrist : {false, true}) configurations.push_back({back, elbow, wrist});
        }
    }
    return configurations;
}

PlaceScorer::PlaceScorer(const Setup& setup, const Cell& cell, const std::vector<OrientationPoses>& orientations)
    : setup_(setup),
      cell_(cell),
      orientations_(orientations),
      judge_(cell, longest_tool(cell.machine->tools)),
      configurations_(all_configurations()),
      hints_(orientations.size()),
      preferred_angle_(orientations.size(), 0) {
    for (const CuttingTool& tool : cell.machine->tools) home_judges_.emplace_back(cell, tool);
    if (const auto& robot = cell.machine->robot) {
        const ArmConfiguration home_configuration = configuration_of(robot->geometry, cell.machine->start.joints);
        const auto home = std::find(configurations_.begin(), configurations_.end(), home_configuration);
        std::rotate(configurations_.begin(), home, home + 1);
    }
    if (has_rotary()) {
        const Pose cell_in_table = inverse(table_in_cell(cell, 0));
        const auto add = [&](Vec3 from, Vec3 to, double radius) {
            home_bodies_.push_back({apply(cell_in_table, from), apply(cell_in_table, to), radius});
        };
        for (const CuttingTool& tool : cell.machine->tools) {
            const MovingBodies home = bodies_at(cell, tool, cell.machine->start.joints, cell.machine->start.tip);
            for (const AxisBody& body : home.on_axis) add(body.shape.from, body.shape.to, body.shape.radius);
            for (const LinkCapsule& link : home.links) {
                if (link.link > 0) add(link.shape.from, link.shape.to, link.shape.radius);
            }
        }
    }
    order_.resize(orientations.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    for (std::size_t d = 0; d < orientations.size(); ++d) hints_[d].resize(orientations[d].regions.size());
}

PlaceScore PlaceScorer::judged(BlockPlacement placement, const ScoreOptions& options) {
    ++places_;
    PlaceScore place{std::numeric_limits<double>::infinity(), std::move(placement), {}};
    place.postures.resize(orientations_.size());
    for (std::size_t i = 0; i < order_.size() && place.score >= options.bound; ++i) {
        const std::size_t d = order_[i];
        ScoreOptions own = options;
        if (!options.best_everywhere) own.enough = std::min(own.enough, place.score);
        place.score = std::min(place.score, direction_score(d, own, place));
        if (place.score >= options.bound) continue;
        // What was too bad here is asked for first at the next place.
        const auto worst = order_.begin() + static_cast<std::ptrdiff_t>(i);
        std::rotate(order_.begin(), worst, worst + 1);
    }
    return place;
}

StandingBlock PlaceScorer::standing(const BlockPlacement& placement, std::size_t orientation) const {
    return judge_.standing(setup_in_cell(cell_, setup_.spoil, placement, orientation), setup_.block_box());
}

// Of home with each tool, the first being the one of the poses.
double PlaceScorer::home_score(const BlockPlacement& placement) {
    MarginTally tally(false);
    const StandingBlock block = standing(placement, 0);
    for (PoseJudge& judge : home_judges_) judge.judge_home(block, tally);
    return tally.score();
}

double PlaceScorer::least_home_score(const BlockPlacement& placement) const {
    const Pose on_table = setup_in_table(placement, setup_.spoil);
    const Box block = setup_.block_box();
    const double top = apply(on_table, block.max).z;
    double rim = 0;
    for (const double x : {block.min.x, block.max.x}) {
        for (const double y : {block.min.y, block.max.y}) {
            const Vec3 corner = apply(on_table, Vec3{x, y, 0});
            rim = std::max(rim, std::hypot(corner.x, corner.y));
        }
    }
    const CheckRule& rule = rule_of(PoseCheck::tool_to_block);  // that of arm_to_block has the same needed and scale
    double least = std::numeric_limits<double>::infinity();
    for (const Capsule& body : home_bodies_) {
        const double above = std::min(body.from.z, body.to.z) - body.radius - top;
        const Capsule flat{{body.from.x, body.from.y, 0}, {body.to.x, body.to.y, 0}, body.radius};
        const double beside = distance(flat, Capsule{{}, {}, rim});
        least = std::min(least, std::max(above, beside));
    }
    return (least - rule.needed) / rule.scale;
}

double PlaceScorer::turning_home_score(const BlockPlacement& placement, std::size_t orientation,
                                       const ScoreOptions& options) {
    if (least_home_score(placement) >= options.enough) return options.enough;
    MarginTally tally(false);
    const Pose on_table = setup_in_table(placement, setup_.spoil);
    const double to = std::remainder(placement.table_angle(orientation), 2 * std::numbers::pi);
    for (const double angle : judged_table_angles(0, to)) {
        const StandingBlock block = judge_.standing(table_in_cell(cell_, angle) * on_table, setup_.block_box());
        for (PoseJudge& judge : home_judges_) judge.judge_home(block, tally);
        if (tally.score() < options.bound) break;
    }
    return std::min(options.enough, tally.score());
}

double PlaceScorer::direction_score(std::size_t d, const ScoreOptions& options, PlaceScore& place) {
    if (!has_rotary()) return score_at(d, options, place.placement, place.postures[d]);
    std::vector<double>& angles = place.placement.table_angles;
    if (are_angles_given_ || !options.freedom.table_angles) {
        if (!are_angles_given_) angles.assign(orientations_.size(), 0);
        return score_at(d, options, place.placement, place.postures[d]);
    }
    angles.resize(orientations_.size(), 0);
    double best = nothing;
    double best_angle = preferred_angle_[d];
    const auto consider = [&](double angle) {
        if (best >= options.enough) return;
        angles[d] = std::remainder(angle, 2 * std::numbers::pi);
        std::vector<ArmPosture> postures;
        ScoreOptions better = options;
        better.bound = std::max(options.bound, best);
        const double score = score_at(d, better, place.placement, postures);
        if (score <= best) return;
        best = score;
        best_angle = angles[d];
        place.postures[d] = std::move(postures);
    };
    // Next to the angle that was best at the last place first; a multiple of 15 degrees, or of 30 in a search.
    const int every = options.all || has_fine_angles_ ? 1 : 2;
    const int first = static_cast<int>(std::lround(preferred_angle_[d] / table_step / every)) * every;
    for (int i = 0; i < table_angles; i += every) {
        const int k = i / every % 2 == 0 ? i / every / 2 : -(i / every + 1) / 2;
        consider((first + k * every) * table_step);
    }
    if (options.all && best >= options.bound) {
        for (const double step : {5 * degree, 2 * degree}) {
            const double middle = best_angle;
            consider(middle - step);
            consider(middle + step);
        }
    }
    angles[d] = best_angle;
    if (best >= options.bound) preferred_angle_[d] = best_angle;
    return best;
}

double PlaceScorer::score_at(std::size_t d, ScoreOptions options, const BlockPlacement& placement,
                             std::vector<ArmPosture>& postures) {
    const StandingBlock block = standing(placement, d);
    const OrientationPoses& orientation = orientations_[d];
    // Home is where the table stands as for the first direction.
    double score = d == 0 ? home_score(placement) : std::numeric_limits<double>::infinity();
    for (std::size_t r = 0; r < orientation.regions.size() && score >= options.bound; ++r) {
        const PoseRegion& region = orientation.regions[r];
        const std::size_t count = options.all ? region.poses.size() : region.extremes;
        ArmPosture posture;
        if (!options.best_everywhere) options.enough = std::min(options.enough, score);
        score = std::min(score,
                         region_score({block, orientation.tool_axis, region, count}, options, hints_[d][r], posture));
        postures.push_back(posture);
    }
    if (!has_rotary() || score < options.bound) return score;
    options.enough = score;
    return turning_home_score(placement, d, options);
}

double PlaceScorer::candidate_score(const PlacedRegion& placed, double bound, RegionHint& hint, ArmPosture& posture) {
    // Alone a pose is held no worse than among the others.
    if (hint.worst < placed.count) {
        alone_.poses.assign(1, placed.region.poses[hint.worst]);
        alone_.poses.front().beside = 0;
        ArmPosture own = posture;
        MarginTally tally(false);
        judge_.judge(placed.block, placed.tool_axis, alone_, 1, own, bound, tally);
        if (tally.score() < bound) return nothing;
    }
    MarginTally tally(false);
    judge_.judge(placed.block, placed.tool_axis, placed.region, placed.count, posture, bound, tally);
    hint.worst = tally.worst_pose();
    return tally.score();
}

double PlaceScorer::region_score(const PlacedRegion& placed, const ScoreOptions& options, RegionHint& hint,
                                 ArmPosture& best_posture) {
    double best = nothing;
    const RemedyFreedom& freedom = options.freedom;
    const auto consider = [&](ArmPosture posture) {
        if (best >= options.enough) return false;
        const double score = candidate_score(placed, std::max(options.bound, best), hint, posture);
        if (score <= best) return false;
        best = score;
        best_posture = posture;
        return true;
    };
    if (judge_.is_gantry()) {
        consider({});
        return best;
    }
    const bool is_free = freedom.redundancy_angles && judge_.turns_by_axis_6();
    const int turns = freedom.redundancy_angles && !is_free ? redundancy_angles : 1;
    const std::size_t configurations = freedom.configurations ? configurations_.size() : 1;
    const std::size_t first = freedom.configurations ? hint.configuration : 0;
    for (std::size_t i = 0; i < configurations; ++i) {
        const std::size_t b = (first + i) % configurations_.size();
        for (int turn = 0; turn < turns; ++turn) {
            if (consider({configurations_[b], turn * 10 * degree, is_free}) && best >= options.bound)
                hint.configuration = b;
        }
    }
    if (turns == 1 || best < options.bound) return best;
    for (const double step : {5 * degree, 2.5 * degree, 1.25 * degree}) {
        const ArmPosture middle = best_posture;
        for (const double turn : {middle.redundancy_angle - step, middle.redundancy_angle + step}) {
            consider({middle.configuration, std::remainder(turn, 2 * std::numbers::pi), false});
        }
    }
    return best;
}

}  // namespace qchopper
