// Scores one place of the block: the smallest relative margin of all poses there, with the best branch of the arm, turn
// about the tool axis and angle of the table for each.
//
// For the search of place_block.h. Remembers what was best at the last place and tries that first; the score does not
// depend on it, only the time. Not for several threads at once (tests/cam/setup/placement/place_block_test.cpp).

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/placement/carving_poses.h"
#include "cam/setup/placement/pose_judge.h"
#include "cam/setup/setup.h"

namespace qchopper {

// Which cures may be used.
struct CureFreedom {
    bool tool_turns = true;
    bool branches = true;
    bool table_angles = true;
};

struct ScoreOptions {
    bool all = false;                                         // of all poses, else of the extreme ones
    double bound = -std::numeric_limits<double>::infinity();  // a score below it is not exact
    CureFreedom freedom = {};
    double enough = std::numeric_limits<double>::infinity();  // nor is one above it
    // Every region is held as well as it can be, not only the one that decides.
    bool best_everywhere = false;
};

struct PlaceScore {
    double score = -std::numeric_limits<double>::infinity();  // below 0: not held
    BlockPlacement placement;
    std::vector<std::vector<RegionHold>> holds;  // by direction and region; not of directions that were not come to
};

constexpr int tool_turns = 36;  // tried about the tool axis, 10 degrees apart

// All eight.
std::vector<ArmBranch> all_branches();

class PlaceScorer {
 public:
    // Preconditions: the cell has a machine, there is a direction; all arguments outlive this object.
    PlaceScorer(const Setup& setup, const Cell& cell, const std::vector<DirectionPoses>& directions);

    // The angles of a rotary table are searched, or with given_angles(true) those of the placement.
    PlaceScore judged(BlockPlacement placement, const ScoreOptions& options);
    void given_angles(bool are_given) { are_angles_given_ = are_given; }
    // Extreme poses are tried at every 15 degrees of the table too, not at every 30.
    void fine_angles() { has_fine_angles_ = true; }

    StandingBlock standing(const BlockPlacement& placement, std::size_t direction) const;
    PoseJudge& judge() { return judge_; }                           // with the tool of the poses
    std::vector<PoseJudge>& home_judges() { return home_judges_; }  // with each tool of the cell
    bool has_rotary() const { return cell_.machine->rotary_table.has_value(); }
    std::size_t places() const { return places_; }  // judged so far

 private:
    struct PlacedRegion {
        const StandingBlock& block;
        Vec3 out;
        const PoseRegion& region;
        std::size_t count;  // of its poses
    };
    // What was best and what was worst at the last place.
    struct RegionHint {
        std::size_t branch = 0;  // index in branches_
        std::size_t worst = 0;   // pose
    };

    double direction_score(std::size_t d, const ScoreOptions& options, PlaceScore& place);
    double score_at(std::size_t d, ScoreOptions options, const BlockPlacement& placement,
                    std::vector<RegionHold>& holds);
    // The best branch and turn about the tool axis of a region.
    double region_score(const PlacedRegion& placed, const ScoreOptions& options, RegionHint& hint,
                        RegionHold& best_hold);
    // Of one branch and turn; any number below `bound` if it is below.
    double candidate_score(const PlacedRegion& placed, double bound, RegionHint& hint, RegionHold& hold);
    double home_score(const BlockPlacement& placement);

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<DirectionPoses>& directions_;
    PoseJudge judge_;
    std::vector<PoseJudge> home_judges_;
    std::vector<ArmBranch> branches_;             // that of home first
    std::vector<std::vector<RegionHint>> hints_;  // by direction and region
    PoseRegion alone_;                            // one pose
    std::vector<double> preferred_angle_;
    std::vector<std::size_t> order_;  // of the directions
    bool are_angles_given_ = false;
    bool has_fine_angles_ = false;
    std::size_t places_ = 0;
};

}  // namespace qchopper
