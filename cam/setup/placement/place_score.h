// Scores one place of the block: the smallest relative margin of all poses there, with the best arm configuration,
// redundancy angle and angle of the table for each.
//
// For the search of place_block.h. Remembers what was best at the last place and tries that first; the score does not
// depend on it, only the time. Not for several threads at once (tests/cam/setup/placement/place_block_test.cpp).

#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/placement/milling_poses.h"
#include "cam/setup/placement/pose_judge.h"
#include "cam/setup/setup.h"

namespace qchopper {

// Which remedies may be used.
struct RemedyFreedom {
    bool redundancy_angles = true;
    bool configurations = true;
    bool table_angles = true;
};

struct ScoreOptions {
    bool all = false;                                         // of all poses, else of the extreme ones
    double bound = -std::numeric_limits<double>::infinity();  // a score below it is not exact
    RemedyFreedom freedom = {};
    double enough = std::numeric_limits<double>::infinity();  // nor is one above it
    // Every region is held as well as it can be, not only the one that decides.
    bool best_everywhere = false;
};

struct PlaceScore {
    double score = -std::numeric_limits<double>::infinity();  // below 0: not held
    BlockPlacement placement;
    std::vector<std::vector<ArmPosture>> postures;  // by direction and region; not of directions that were not come to
};

constexpr int redundancy_angles = 36;  // tried about the tool axis, 10 degrees apart

// All eight.
std::vector<ArmConfiguration> all_configurations();

class PlaceScorer {
 public:
    // Preconditions: the cell has a machine, there is a direction; all arguments outlive this object.
    PlaceScorer(const Setup& setup, const Cell& cell, const std::vector<OrientationPoses>& orientations);

    // The angles of a rotary table are searched, or with given_angles(true) those of the placement.
    PlaceScore judged(BlockPlacement placement, const ScoreOptions& options);
    void given_angles(bool are_given) { are_angles_given_ = are_given; }
    // Extreme poses are tried at every 15 degrees of the table too, not at every 30.
    void fine_angles() { has_fine_angles_ = true; }

    StandingBlock standing(const BlockPlacement& placement, std::size_t orientation) const;
    PoseJudge& judge() { return judge_; }                           // with the tool of the poses
    std::vector<PoseJudge>& home_judges() { return home_judges_; }  // with each tool of the cell
    bool has_rotary() const { return cell_.machine->rotary_table.has_value(); }
    std::size_t places() const { return places_; }  // judged so far

 private:
    struct PlacedRegion {
        const StandingBlock& block;
        Vec3 tool_axis;
        const PoseRegion& region;
        std::size_t count;  // of its poses
    };
    // What was best and what was worst at the last place.
    struct RegionHint {
        std::size_t configuration = 0;  // index in configurations_
        std::size_t worst = 0;          // pose
    };

    double direction_score(std::size_t d, const ScoreOptions& options, PlaceScore& place);
    double score_at(std::size_t d, ScoreOptions options, const BlockPlacement& placement,
                    std::vector<ArmPosture>& postures);
    // The best configuration and redundancy angle of a region.
    double region_score(const PlacedRegion& placed, const ScoreOptions& options, RegionHint& hint,
                        ArmPosture& best_posture);
    // Of one configuration and turn; any number below `bound` if it is below.
    double candidate_score(const PlacedRegion& placed, double bound, RegionHint& hint, ArmPosture& posture);
    double home_score(const BlockPlacement& placement);
    // Of home while the table turns from 0 to the angle of a direction; `enough` of the options if it is no less.
    double turning_home_score(const BlockPlacement& placement, std::size_t orientation, const ScoreOptions& options);
    // No home score of a place is less, whatever the angle of the table.
    double least_home_score(const BlockPlacement& placement) const;

    const Setup& setup_;
    const Cell& cell_;
    const std::vector<OrientationPoses>& orientations_;
    PoseJudge judge_;
    std::vector<PoseJudge> home_judges_;
    std::vector<Capsule> home_bodies_;              // all that moves, with any tool, in the rotary table's frame
    std::vector<ArmConfiguration> configurations_;  // that of home first
    std::vector<std::vector<RegionHint>> hints_;    // by direction and region
    PoseRegion alone_;                              // one pose
    std::vector<double> preferred_angle_;
    std::vector<std::size_t> order_;  // of the directions
    bool are_angles_given_ = false;
    bool has_fine_angles_ = false;
    std::size_t places_ = 0;
};

}  // namespace qchopper
