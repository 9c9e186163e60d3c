// Places of a grid are judged by the extreme poses alone, nearest to the middle of the table first; the best is refined
// in steps that are halved. Then all poses are judged at the best places, until no other can be better. Everywhere a
// branch, an angle of the table or a place is left as soon as it is known to be worse than the best so far. The grid is
// finer than 20 cm and 30 degrees and holds all places of such a scan about the middle of the table; where none of it
// holds, a finer one is searched.

#include "cam/setup/place_block.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "cam/setup/holder_limit.h"
#include "cam/setup/pose_judge.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;  // of scores
constexpr int tool_turns = 36;     // 10 degrees apart
constexpr double table_step = 15 * degree;
constexpr int table_angles = 24;     // 15 degrees apart
constexpr double score_slack = 0.1;  // a place that is worse than the best by less may be the best of all poses
constexpr std::size_t most_compared = 4;

struct PlaceGrid {
    double shift;  // mm
    double turn;   // radians
};
constexpr PlaceGrid first_grid{100, 30 * degree};
constexpr PlaceGrid fine_grid{50, 10 * degree};
constexpr std::array<PlaceGrid, 4> refinements{
    {{50, 15 * degree}, {25, 10 * degree}, {10, 5 * degree}, {5, 2 * degree}}};

// Which cures may be used.
struct Freedom {
    bool tool_turns = true;
    bool branches = true;
    bool table_angles = true;
};

struct PlaceScore {
    double score = nothing;
    BlockPlacement placement;
    std::vector<std::vector<RegionHold>> holds;  // by direction and region
};

std::vector<ArmBranch> all_branches() {
    std::vector<ArmBranch> branches;
    for (const bool back : {false, true}) {
        for (const bool elbow : {false, true}) {
            for (const bool wrist : {false, true}) branches.push_back({back, elbow, wrist});
        }
    }
    return branches;
}

class PlaceSearch {
 public:
    PlaceSearch(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions,
                const Context& context)
        : setup_(setup),
          cell_(cell),
          directions_(directions),
          context_(context),
          judge_(cell, longest_tool(cell.machine->tools)),
          branches_(all_branches()),
          preferred_(directions.size()),
          preferred_angle_(directions.size(), 0) {
        for (const CarvingTool& tool : cell.machine->tools) home_judges_.emplace_back(cell, tool);
        if (const auto& robot = cell.machine->robot) {
            home_branch_ = branch_of(robot->geometry, cell.machine->start.joints);
            const auto home = std::find(branches_.begin(), branches_.end(), home_branch_);
            std::rotate(branches_.begin(), home, home + 1);
        }
        order_.resize(directions.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        for (std::size_t d = 0; d < directions.size(); ++d) preferred_[d].assign(directions[d].regions.size(), 0);
    }

    std::size_t places() const { return places_; }
    PoseJudge& judge() { return judge_; }

    // Score of a place; below `bound` it may be any. With `all` not the extreme poses alone.
    PlaceScore judged(BlockPlacement placement, bool all, double bound, Freedom freedom = {}) {
        ++places_;
        PlaceScore place{std::numeric_limits<double>::infinity(), std::move(placement), {}};
        place.holds.resize(directions_.size());
        for (std::size_t i = 0; i < order_.size() && place.score >= bound; ++i) {
            const std::size_t d = order_[i];
            place.score = std::min(place.score, direction_score(d, all, bound, freedom, place));
            if (place.score >= bound) continue;
            // What was too bad here is asked for first at the next place.
            const auto own = order_.begin() + static_cast<std::ptrdiff_t>(i);
            std::rotate(order_.begin(), own, own + 1);
        }
        if (place.score >= bound) place.score = std::min(place.score, home_score(place.placement));
        return place;
    }

    // The places of a grid about the middle of the table, the middle first.
    std::vector<BlockPlacement> grid(PlaceGrid step) const {
        const double reach =
            has_rotary() ? cell_.machine->rotary_table->radius : 0.5 * std::max(cell_.table.size_x, cell_.table.size_y);
        const int shifts = static_cast<int>(std::floor(reach / step.shift));
        const int turns =
            has_rotary() || judge_.is_gantry() ? 1 : static_cast<int>(std::lround(2 * std::numbers::pi / step.turn));
        std::vector<BlockPlacement> all;
        for (int turn = 0; turn < turns; ++turn) {
            for (int x = -shifts; x <= shifts; ++x) {
                for (int y = -shifts; y <= shifts; ++y) {
                    BlockPlacement place{x * step.shift, y * step.shift, turn * step.turn, {}};
                    if (inside_table(cell_, setup_.block.size, place) >= 0) all.push_back(std::move(place));
                }
            }
        }
        const auto far = [](const BlockPlacement& p) {
            return std::hypot(p.x, p.y) + 200 * std::abs(std::remainder(p.turn, 2 * std::numbers::pi));
        };
        std::stable_sort(all.begin(), all.end(),
                         [&](const BlockPlacement& a, const BlockPlacement& b) { return far(a) < far(b); });
        return all;
    }

    // The first place whose extreme poses are held; nothing if there is none.
    bool any_holds(PlaceGrid step) {
        const std::vector<BlockPlacement> places = grid(step);
        return std::any_of(places.begin(), places.end(),
                           [&](const BlockPlacement& p) { return judged(p, false, 0).score >= -rounding; });
    }

    PlaceScore searched() {
        std::vector<PlaceScore> found = scanned(first_grid, {});
        if (found.empty() || found.front().score < 0) {
            found = refined(std::move(found));
            if (found.front().score < 0) {
                is_fine_ = true;
                found = refined(scanned(fine_grid, std::move(found)));
            }
        } else {
            found = refined(std::move(found));
        }
        PlaceScore best = best_of_all_poses(found);
        for (std::size_t i = 0; i < skipped_.size() && best.score < 0; ++i) {
            context_.check_cancelled();
            PlaceScore whole = judged(skipped_[i], true, std::max(best.score, -score_slack));
            if (whole.score > best.score) best = std::move(whole);
        }
        return best;
    }

    PlaceScore fixed(double bound = nothing) {
        is_angle_given_ = setup_.placement.table_angles.size() == directions_.size();
        return judged(setup_.placement, true, bound);
    }

    // The last cure that the place in the middle of the table needs, or that it is left.
    EnvelopeCure needed_cure() {
        if (inside_table(cell_, setup_.block.size, {}) < -rounding) return EnvelopeCure::block_shift;
        is_angle_given_ = false;
        struct Step {
            EnvelopeCure cure;
            Freedom freedom;
        };
        constexpr std::array<Step, 4> steps{{{EnvelopeCure::none, {false, false, false}},
                                             {EnvelopeCure::tool_turn, {true, false, false}},
                                             {EnvelopeCure::branch, {true, true, false}},
                                             {EnvelopeCure::table_turn, {true, true, true}}}};
        for (const Step& step : steps) {
            if (step.cure == EnvelopeCure::table_turn && !has_rotary()) continue;
            if (judged({}, true, 0, step.freedom).score >= -rounding) return step.cure;
        }
        return EnvelopeCure::block_shift;
    }

    StandingBlock standing(const BlockPlacement& placement, std::size_t direction) const {
        return judge_.standing(setup_in_cell(cell_, setup_.spoil, placement, direction), setup_.block.size,
                               setup_.spoil);
    }

    // Of home with each tool, the first being the one of the poses.
    double home_score(const BlockPlacement& placement) {
        MarginTally tally(false);
        const StandingBlock block = standing(placement, 0);
        for (PoseJudge& judge : home_judges_) judge.judge_home(block, tally);
        return tally.score();
    }

    std::vector<PoseJudge>& home_judges() { return home_judges_; }

 private:
    bool has_rotary() const { return cell_.machine->rotary_table.has_value(); }

    double direction_score(std::size_t d, bool all, double bound, Freedom freedom, PlaceScore& place) {
        if (!has_rotary()) return score_at(d, all, bound, freedom, place.placement, place.holds[d]);
        std::vector<double>& angles = place.placement.table_angles;
        if (is_angle_given_ || !freedom.table_angles) {
            if (!is_angle_given_) angles.assign(directions_.size(), 0);
            return score_at(d, all, bound, freedom, place.placement, place.holds[d]);
        }
        angles.resize(directions_.size(), 0);
        double best = nothing;
        double best_angle = preferred_angle_[d];
        const auto consider = [&](double angle) {
            angles[d] = std::remainder(angle, 2 * std::numbers::pi);
            std::vector<RegionHold> holds;
            const double score = score_at(d, all, std::max(bound, best), freedom, place.placement, holds);
            if (score <= best) return;
            best = score;
            best_angle = angles[d];
            place.holds[d] = std::move(holds);
        };
        // Next to the angle that was best at the last place first; a multiple of 15 degrees, or of 30 in a search.
        const int every = all || is_fine_ ? 1 : 2;
        const int first = static_cast<int>(std::lround(preferred_angle_[d] / table_step / every)) * every;
        for (int i = 0; i < table_angles; i += every) {
            const int k = i / every % 2 == 0 ? i / every / 2 : -(i / every + 1) / 2;
            consider((first + k * every) * table_step);
        }
        if (all && best >= bound) {
            for (const double step : {5 * degree, 2 * degree}) {
                const double middle = best_angle;
                consider(middle - step);
                consider(middle + step);
            }
        }
        angles[d] = best_angle;
        if (best >= bound) preferred_angle_[d] = best_angle;
        return best;
    }

    double score_at(std::size_t d, bool all, double bound, Freedom freedom, const BlockPlacement& placement,
                    std::vector<RegionHold>& holds) {
        const StandingBlock block = standing(placement, d);
        const DirectionPoses& direction = directions_[d];
        double score = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < direction.regions.size() && score >= bound; ++r) {
            const PoseRegion& region = direction.regions[r];
            RegionHold hold;
            const std::size_t count = all ? region.poses.size() : region.extremes;
            score = std::min(score,
                             region_score(block, direction.out, region, count, bound, freedom, preferred_[d][r], hold));
            holds.push_back(hold);
        }
        return score;
    }

    // The best branch and turn about the tool axis; `preferred` is the branch that is tried first.
    double region_score(const StandingBlock& block, Vec3 out, const PoseRegion& region, std::size_t count, double bound,
                        Freedom freedom, std::size_t& preferred, RegionHold& best_hold) {
        double best = nothing;
        const auto consider = [&](RegionHold hold) {
            MarginTally tally(false);
            judge_.judge(block, out, region, count, hold, std::max(bound, best), tally);
            if (tally.score() <= best) return false;
            best = tally.score();
            best_hold = hold;
            return true;
        };
        if (judge_.is_gantry()) {
            consider({});
            return best;
        }
        const bool is_free = freedom.tool_turns && judge_.turns_by_axis_6();
        const int turns = freedom.tool_turns && !is_free ? tool_turns : 1;
        const std::size_t branches = freedom.branches ? branches_.size() : 1;
        const std::size_t first = freedom.branches ? preferred : 0;
        for (std::size_t i = 0; i < branches; ++i) {
            const std::size_t b = (first + i) % branches_.size();
            for (int turn = 0; turn < turns; ++turn) {
                if (consider({branches_[b], turn * 10 * degree, is_free}) && best >= bound) preferred = b;
            }
        }
        if (turns == 1 || best < bound) return best;
        for (const double step : {5 * degree, 2.5 * degree, 1.25 * degree}) {
            const RegionHold middle = best_hold;
            for (const double turn : {middle.tool_turn - step, middle.tool_turn + step}) {
                consider({middle.branch, std::remainder(turn, 2 * std::numbers::pi), false});
            }
        }
        return best;
    }

    static void sort(std::vector<PlaceScore>& places) {
        std::stable_sort(places.begin(), places.end(),
                         [](const PlaceScore& a, const PlaceScore& b) { return a.score > b.score; });
    }

    // The best places of a grid, as far as they are about as good as the best of all. Those left out that may hold are
    // kept in skipped_.
    std::vector<PlaceScore> scanned(PlaceGrid step, std::vector<PlaceScore> found) {
        double best = found.empty() ? nothing : found.front().score;
        const std::vector<BlockPlacement> places = grid(step);
        for (std::size_t i = 0; i < places.size(); ++i) {
            context_.check_cancelled();
            if (i % 50 == 0) context_.progress("places of the block judged", i, places.size());
            const double bound = best < 0 ? best + rounding : best - score_slack;
            PlaceScore place = judged(places[i], false, bound);
            if (place.score < bound && !found.empty()) {
                if (bound > 0) skipped_.push_back(places[i]);
                continue;
            }
            best = std::max(best, place.score);
            found.push_back(std::move(place));
        }
        if (found.empty()) found.push_back(judged({}, false, nothing));
        sort(found);
        return found;
    }

    // The best place moved as long as it becomes better.
    std::vector<PlaceScore> refined(std::vector<PlaceScore> found) {
        PlaceScore best = found.front();
        for (const PlaceGrid& step : refinements) {
            for (bool is_better = true; is_better;) {
                is_better = false;
                context_.check_cancelled();
                for (int axis = 0; axis < 3; ++axis) {
                    if (axis == 2 && (has_rotary() || judge_.is_gantry())) continue;
                    for (const double side : {-1.0, 1.0}) {
                        BlockPlacement moved = best.placement;
                        double& value = axis == 0 ? moved.x : axis == 1 ? moved.y : moved.turn;
                        value += side * (axis == 2 ? step.turn : step.shift);
                        if (inside_table(cell_, setup_.block.size, moved) < 0) continue;
                        PlaceScore place = judged(moved, false, best.score);
                        if (place.score <= best.score + 1e-6) continue;
                        best = std::move(place);
                        is_better = true;
                    }
                }
            }
        }
        found.push_back(std::move(best));
        sort(found);
        return found;
    }

    // `found` is sorted. A place is no better for all poses than for the extreme ones.
    PlaceScore best_of_all_poses(const std::vector<PlaceScore>& found) {
        PlaceScore best;
        std::size_t held = 0;
        for (const PlaceScore& place : found) {
            context_.check_cancelled();
            if (place.score <= best.score || held > most_compared) break;
            // Of places that hold not even the extreme poses the best one is enough, to tell what is wrong.
            if (best.score > nothing && best.score < 0 && place.score < 0) break;
            PlaceScore whole = judged(place.placement, true, best.score);
            if (whole.score > best.score) best = std::move(whole);
            if (best.score >= 0) ++held;
        }
        return best;
    }

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<DirectionPoses>& directions_;
    const Context& context_;
    PoseJudge judge_;
    std::vector<PoseJudge> home_judges_;
    std::vector<ArmBranch> branches_;  // that of home first
    ArmBranch home_branch_;
    std::vector<std::vector<std::size_t>> preferred_;  // branch by direction and region
    std::vector<double> preferred_angle_;
    std::vector<std::size_t> order_;  // of the directions
    bool is_angle_given_ = false;
    bool is_fine_ = false;
    std::vector<BlockPlacement> skipped_;
    std::size_t places_ = 0;
};

// Fills the report of one place.
class EnvelopeReporter {
 public:
    EnvelopeReporter(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions,
                     PlaceSearch& search, const PlaceScore& place)
        : setup_(setup), cell_(cell), directions_(directions), search_(search), place_(place) {}

    WorkEnvelope report() {
        WorkEnvelope envelope;
        envelope.is_arm_checked = true;
        envelope.placement = place_.placement;
        add_table(envelope);
        for (std::size_t d = 0; d < directions_.size(); ++d) {
            for (std::size_t r = 0; r < directions_[d].regions.size(); ++r) add_region(d, r, envelope);
        }
        add_home(envelope);
        std::sort(envelope.margins.begin(), envelope.margins.end(),
                  [](const EnvelopeMargin& a, const EnvelopeMargin& b) { return a.check < b.check; });
        return envelope;
    }

 private:
    static void keep(EnvelopeMargin margin, WorkEnvelope& envelope) {
        const auto own = std::find_if(envelope.margins.begin(), envelope.margins.end(),
                                      [&](const EnvelopeMargin& m) { return m.check == margin.check; });
        if (own == envelope.margins.end()) {
            envelope.margins.push_back(std::move(margin));
        } else if (margin.relative < own->relative) {
            *own = std::move(margin);
        }
    }

    void add_table(WorkEnvelope& envelope) const {
        const double inside = inside_table(cell_, setup_.block.size, place_.placement);
        const CheckRule& rule = rule_of(PoseCheck::block_on_table);
        EnvelopeMargin margin{rule.check, inside, inside / rule.scale, "the block and the edge of the table", {}};
        margin.pose.kind = PoseKind::corner;
        keep(std::move(margin), envelope);
    }

    void keep_all(const MarginTally& tally, const PoseJudge& judge, const auto& pose_of, WorkEnvelope& envelope) const {
        for (std::size_t c = 0; c < pose_checks; ++c) {
            const auto check = static_cast<PoseCheck>(c);
            const TightestMargin& tightest = tally.of(check);
            if (!std::isfinite(tightest.relative)) continue;
            keep({check, tightest.margin, tightest.relative, judge.pair_words(check, tightest.pair),
                  pose_of(tightest.pose)},
                 envelope);
        }
    }

    EnvelopePose pose_at(std::size_t d, const CarvingPose& pose, const StandingBlock& block, double tool_turn,
                         const std::optional<Joints>& joints) const {
        EnvelopePose own{pose.kind, d, pose.tip, {}, {}, place_.placement.table_angle(d), tool_turn, joints};
        own.tip_in_cell = apply(block.setup_in_cell, pose.tip);
        own.out_in_cell = rotate(block.setup_in_cell, directions_[d].out);
        return own;
    }

    void add_region(std::size_t d, std::size_t r, WorkEnvelope& envelope) {
        const DirectionPoses& direction = directions_[d];
        const PoseRegion& region = direction.regions[r];
        const StandingBlock block = search_.standing(place_.placement, d);
        RegionHold hold;
        if (d < place_.holds.size() && r < place_.holds[d].size()) hold = place_.holds[d][r];
        hold.turns_freely = hold.turns_freely && search_.judge().turns_by_axis_6();
        MarginTally tally;
        PoseJudge& judge = search_.judge();
        judge.judge(block, direction.out, region, region.poses.size(), hold, nothing, tally);
        keep_all(
            tally, judge,
            [&](std::size_t i) {
                const auto joints = i < judge.joints().size() ? judge.joints()[i] : std::nullopt;
                return pose_at(d, region.poses[i], block, hold.tool_turn, joints);
            },
            envelope);
        envelope.poses += region.poses.size();
        const bool holds = tally.score() >= -rounding;
        if (judge.is_gantry()) return;
        envelope.regions.push_back({d, region.poses.size(), holds, hold.branch, hold.tool_turn, tally.score()});
        add_one_branch(d, region, block, hold, holds, envelope);
    }

    // If every pose of a region that is not held could be held alone, it is the branch that must change on the way.
    void add_one_branch(std::size_t d, const PoseRegion& region, const StandingBlock& block, const RegionHold& hold,
                        bool holds, WorkEnvelope& envelope) {
        const CheckRule& rule = rule_of(PoseCheck::one_branch);
        std::size_t held = region.poses.size();
        std::size_t first_refused = 0;
        if (!holds) {
            held = 0;
            for (std::size_t i = 0; i < region.poses.size(); ++i) {
                const PoseRegion alone{{{region.poses[i].kind, region.poses[i].tip, 0}}, 1};
                if (!is_held_by_any(d, alone, block)) return;
                if (is_held(d, alone, block, hold)) {
                    ++held;
                } else if (held == i) {
                    first_refused = i;
                }
            }
        }
        const double share = 100.0 * static_cast<double>(held) / static_cast<double>(region.poses.size());
        const double margin = share - rule.needed;
        keep({rule.check, margin, margin / rule.scale,
              "a branch that holds " + std::to_string(held) + " of " + std::to_string(region.poses.size()) + " poses",
              pose_at(d, region.poses[first_refused], block, hold.tool_turn, std::nullopt)},
             envelope);
    }

    bool is_held(std::size_t d, const PoseRegion& alone, const StandingBlock& block, RegionHold hold) {
        MarginTally tally(false);
        search_.judge().judge(block, directions_[d].out, alone, 1, hold, 0, tally);
        return tally.score() >= -rounding;
    }

    bool is_held_by_any(std::size_t d, const PoseRegion& alone, const StandingBlock& block) {
        const bool is_free = search_.judge().turns_by_axis_6();
        for (const ArmBranch& branch : all_branches()) {
            for (int turn = 0; turn < (is_free ? 1 : tool_turns); ++turn) {
                if (is_held(d, alone, block, {branch, turn * 10 * degree, is_free})) return true;
            }
        }
        return false;
    }

    void add_home(WorkEnvelope& envelope) {
        const StandingBlock block = search_.standing(place_.placement, 0);
        const CellMachine& machine = *cell_.machine;
        const CarvingTool& own_tool = longest_tool(machine.tools);
        for (std::size_t t = 0; t < machine.tools.size(); ++t) {
            PoseJudge& judge = search_.home_judges()[t];
            MarginTally tally;
            judge.judge_home(block, tally);
            EnvelopePose pose;
            pose.kind = &machine.tools[t] == &own_tool ? PoseKind::home : PoseKind::tool_change;
            pose.table_angle = place_.placement.table_angle(0);
            if (machine.robot) {
                const ToolArm arm = tool_arm(*machine.robot, machine.spindle, machine.tools[t]);
                const Pose tip = arm.base_in_cell * (forward(arm.geometry, machine.start.joints) * arm.tip_in_flange);
                pose.tip_in_cell = tip.shift;
                pose.out_in_cell = -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z};
                pose.joints = machine.start.joints;
            } else {
                pose.tip_in_cell = machine.start.tip;
                pose.out_in_cell = {0, 0, 1};
            }
            pose.tip = pose.tip_in_cell;
            keep_all(
                tally, judge, [&](std::size_t) { return pose; }, envelope);
            ++envelope.poses;
        }
    }

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<DirectionPoses>& directions_;
    PlaceSearch& search_;
    const PlaceScore& place_;
};

// What is left to do where no place holds: other directions if that of the base alone is held.
EnvelopeCure nearest_cure(const WorkEnvelope& envelope, bool has_other_base) {
    const bool only_further =
        std::all_of(envelope.regions.begin(), envelope.regions.end(),
                    [](const HeldRegion& r) { return r.holds || r.direction > 0; }) &&
        std::any_of(envelope.regions.begin(), envelope.regions.end(), [](const HeldRegion& r) { return !r.holds; });
    if (only_further) return EnvelopeCure::directions;
    return has_other_base ? EnvelopeCure::base : EnvelopeCure::cut;
}

}  // namespace

WorkEnvelope place_block(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                         const PlacementOptions& options, const Context& context) {
    if (!cell.machine) return {};
    const std::vector<DirectionPoses> directions = carving_poses(setup, mesh, cell, options.poses);
    return place_block(setup, directions, cell, options, context);
}

WorkEnvelope place_block(const Setup& setup, const std::vector<DirectionPoses>& directions, const Cell& cell,
                         const PlacementOptions& options, const Context& context) {
    if (!cell.machine) return {};
    assert(!directions.empty());
    PlaceSearch search(setup, cell, directions, context);
    const PlaceScore place = options.is_searched ? search.searched() : search.fixed();
    const std::size_t places = search.places();
    WorkEnvelope envelope = EnvelopeReporter(setup, cell, directions, search, place).report();
    envelope.places = places;
    envelope.cure = envelope.holds() ? search.needed_cure() : nearest_cure(envelope, options.has_other_base);
    return envelope;
}

bool holds_at_placement(const Setup& setup, const std::vector<DirectionPoses>& directions, const Cell& cell) {
    if (!cell.machine) return true;
    if (inside_table(cell, setup.block.size, setup.placement) < -rounding) return false;
    const Context context;
    return PlaceSearch(setup, cell, directions, context).fixed(0).score >= -rounding;
}

bool fits_machine(const Setup& setup, const TriangleMesh& mesh, const Cell& cell) {
    if (!cell.machine) return true;
    PoseOptions options;
    options.extremes_only = true;
    options.map_cell = options.step / 2;
    const std::vector<DirectionPoses> directions = carving_poses(setup, mesh, cell, options);
    const Context context;
    return PlaceSearch(setup, cell, directions, context).any_holds(first_grid);
}

}  // namespace qchopper
