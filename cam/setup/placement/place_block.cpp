// Places of a grid are judged by the extreme poses alone, nearest to the middle of the table first; the best is refined
// in steps that are halved. Then all poses are judged at the best places, until no other can be better. Everywhere a
// configuration, an angle of the table or a place is left as soon as it is known to be worse than the best so far. The
// grid is finer than 20 cm and 30 degrees and holds all places of such a scan about the middle of the table; where none
// of it holds, a finer one is searched. O(places of the grid * extreme poses + best places * poses) poses are judged,
// some 10 microseconds each (pose_judge.cpp).

#include "cam/setup/placement/place_block.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/units.h"
#include "cam/setup/placement/place_score.h"
#include "cam/setup/placement/reachability_report.h"

namespace qchopper {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-9;     // of scores
constexpr double score_slack = 0.02;  // a place that is worse than the best by less may be the best of all poses
constexpr std::size_t max_compared = 4;

struct PlaceGrid {
    double shift;  // mm
    double turn;   // radians
};
constexpr PlaceGrid first_grid{100, 30 * degree};
constexpr PlaceGrid fine_grid{50, 10 * degree};
constexpr std::array<PlaceGrid, 4> refinements{
    {{50, 15 * degree}, {25, 10 * degree}, {10, 5 * degree}, {5, 2 * degree}}};

const ScoreOptions in_full{.all = true, .best_everywhere = true};

class PlaceSearch {
 public:
    PlaceSearch(const Setup& setup, const Cell& cell, const std::vector<OrientationPoses>& orientations,
                const Context& context)
        : setup_(setup), cell_(cell), context_(context), scorer_(setup, cell, orientations) {
        are_angles_given_ = setup.placement.table_angles.size() == orientations.size();
    }

    PlaceScorer& scorer() { return scorer_; }

    // The places of a grid about the middle of the table, the middle first.
    std::vector<BlockPlacement> grid(PlaceGrid step) const {
        const double reach = scorer_.has_rotary() ? cell_.machine->rotary_table->radius
                                                  : 0.5 * std::max(cell_.table.size_x, cell_.table.size_y);
        const int shifts = static_cast<int>(std::floor(reach / step.shift));
        const int turns = scorer_.has_rotary() ? 1 : static_cast<int>(std::lround(2 * std::numbers::pi / step.turn));
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
        return std::any_of(places.begin(), places.end(), [&](const BlockPlacement& p) {
            return scorer_.judged(p, {false, 0, {}, 0}).score >= -rounding;
        });
    }

    // The first place whose poses are all held.
    std::optional<BlockPlacement> first_held(BlockPlacement first) {
        std::vector<BlockPlacement> places = grid(first_grid);
        first.table_angles.clear();
        if (inside_table(cell_, setup_.block.size, first) >= 0) places.insert(places.begin(), std::move(first));
        for (const BlockPlacement& place : places) {
            context_.check_cancelled();
            if (scorer_.judged(place, {false, 0, {}, 0}).score < -rounding) continue;
            PlaceScore whole = scorer_.judged(place, {true, 0, {}, 0});
            if (whole.score >= -rounding) return std::move(whole.placement);
        }
        return std::nullopt;
    }

    PlaceScore searched() {
        std::vector<PlaceScore> found = scanned(first_grid, {});
        if (found.empty() || found.front().score < 0) {
            found = refined(std::move(found));
            if (found.front().score < 0) {
                scorer_.fine_angles();
                found = refined(scanned(fine_grid, std::move(found)));
            }
        } else {
            found = refined(std::move(found));
        }
        PlaceScore best = best_of_all_poses(found);
        for (std::size_t i = 0; i < skipped_.size() && best.score < 0; ++i) {
            context_.check_cancelled();
            PlaceScore whole = scorer_.judged(skipped_[i], {true, std::max(best.score, -score_slack)});
            if (whole.score > best.score) best = std::move(whole);
        }
        // The middle of the table, where an operator would put the block, may be better for all poses than it is for
        // the extreme ones.
        if (inside_table(cell_, setup_.block.size, {}) >= 0) {
            PlaceScore middle = scorer_.judged({}, {true, best.score});
            if (middle.score > best.score) best = std::move(middle);
        }
        PlaceScore everywhere = scorer_.judged(best.placement, in_full);
        return everywhere.score >= best.score - rounding ? everywhere : best;
    }

    // Of all poses where the block stands.
    PlaceScore fixed(const ScoreOptions& options) {
        scorer_.given_angles(are_angles_given_);
        return scorer_.judged(setup_.placement, options);
    }

    // The last remedy that the place in the middle of the table needs, or that it is left.
    Remedy needed_remedy() {
        if (inside_table(cell_, setup_.block.size, {}) < -rounding) return Remedy::block_shift;
        scorer_.given_angles(false);
        struct Step {
            Remedy remedy;
            RemedyFreedom freedom;
        };
        constexpr std::array<Step, 4> steps{{{Remedy::none, {false, false, false}},
                                             {Remedy::redundancy_angle, {true, false, false}},
                                             {Remedy::configuration, {true, true, false}},
                                             {Remedy::table_turn, {true, true, true}}}};
        for (const Step& step : steps) {
            if (step.remedy == Remedy::table_turn && !scorer_.has_rotary()) continue;
            if (scorer_.judged({}, {true, 0, step.freedom, 0}).score >= -rounding) return step.remedy;
        }
        return Remedy::block_shift;
    }

 private:
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
            PlaceScore place = scorer_.judged(places[i], {false, bound});
            if (place.score < bound && !found.empty()) {
                if (bound > 0) skipped_.push_back(places[i]);
                continue;
            }
            best = std::max(best, place.score);
            found.push_back(std::move(place));
        }
        if (found.empty()) found.push_back(scorer_.judged({}, {}));
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
                    if (axis == 2 && scorer_.has_rotary()) continue;
                    for (const double side : {-1.0, 1.0}) {
                        BlockPlacement moved = best.placement;
                        double& value = axis == 0 ? moved.x : axis == 1 ? moved.y : moved.turn;
                        value += side * (axis == 2 ? step.turn : step.shift);
                        if (inside_table(cell_, setup_.block.size, moved) < 0) continue;
                        PlaceScore place = scorer_.judged(moved, {false, best.score});
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
            if (place.score <= best.score || held > max_compared) break;
            // Of places that hold not even the extreme poses the best one is enough, to tell what is wrong.
            if (best.score > nothing && best.score < 0 && place.score < 0) break;
            PlaceScore whole = scorer_.judged(place.placement, {true, best.score});
            if (whole.score > best.score) best = std::move(whole);
            if (best.score >= 0) ++held;
        }
        return best;
    }

    const Setup& setup_;
    const Cell& cell_;
    const Context& context_;
    PlaceScorer scorer_;
    bool are_angles_given_ = false;
    std::vector<BlockPlacement> skipped_;
};

// What is left to do where no place holds: other directions if that of the base alone is held.
Remedy nearest_remedy(const MachineReachability& reachability, bool has_other_base) {
    const bool only_further = std::all_of(reachability.regions.begin(), reachability.regions.end(),
                                          [](const RegionReachability& r) { return r.holds || r.orientation > 0; }) &&
                              std::any_of(reachability.regions.begin(), reachability.regions.end(),
                                          [](const RegionReachability& r) { return !r.holds; });
    if (only_further) return Remedy::orientations;
    return has_other_base ? Remedy::base : Remedy::cut;
}

}  // namespace

MachineReachability place_block(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                const PlacementOptions& options, const Context& context) {
    if (!cell.machine) return {};
    const std::vector<OrientationPoses> orientations = milling_poses(setup, mesh, cell, options.poses);
    return place_block(setup, orientations, cell, options, context);
}

MachineReachability place_block(const Setup& setup, const std::vector<OrientationPoses>& orientations, const Cell& cell,
                                const PlacementOptions& options, const Context& context) {
    if (!cell.machine) return {};
    assert(!orientations.empty());
    PlaceSearch search(setup, cell, orientations, context);
    const PlaceScore place = options.is_searched ? search.searched() : search.fixed(in_full);
    const std::size_t places = search.scorer().places();
    MachineReachability reachability = reachability_at(setup, cell, orientations, search.scorer(), place);
    reachability.places = places;
    reachability.remedy =
        reachability.holds() ? search.needed_remedy() : nearest_remedy(reachability, options.has_other_base);
    return reachability;
}

std::optional<BlockPlacement> first_place(const Setup& setup, const std::vector<OrientationPoses>& orientations,
                                          const Cell& cell, const BlockPlacement& first, const Context& context) {
    assert(cell.machine && !orientations.empty());
    return PlaceSearch(setup, cell, orientations, context).first_held(first);
}

bool fits_machine(const Setup& setup, const TriangleMesh& mesh, const Cell& cell) {
    if (!cell.machine) return true;
    const Context context;
    const auto holds = [&](const PoseOptions& options) {
        const std::vector<OrientationPoses> orientations = milling_poses(setup, mesh, cell, options);
        return PlaceSearch(setup, cell, orientations, context).any_holds(first_grid);
    };
    PoseOptions options;
    options.extremes_only = true;
    options.map_cell = options.step / 2;
    PoseOptions block = options;
    block.block_only = true;
    return holds(block) && holds(options);
}

}  // namespace qchopper
