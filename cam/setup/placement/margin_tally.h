// Keeps the tightest margin of every check over some poses.
//
// Values and a class of a few numbers; nothing is allocated (tests/cam/setup/placement/pose_judge_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "cam/cell/cell.h"
#include "cam/setup/placement/machine_reachability.h"

namespace qchopper {

// Numbers of what a margin lies between, by check: axis 1..6 and 0 or 1 for its lower or upper limit; link or BodyPart
// and number of link or obstacle.
struct MarginPair {
    std::uint16_t first = 0;
    std::uint16_t second = 0;
};

struct TightestMargin {
    double margin = 0;
    double relative = std::numeric_limits<double>::infinity();  // infinite: not checked
    MarginPair pair;
    std::size_t pose = 0;  // index in its region
};

// The tightest margin of every check over some poses.
class MarginTally {
 public:
    // With `keeps_all` the tightest of every check is exact; else only the least of all.
    explicit MarginTally(bool keeps_all = true) : keeps_all_(keeps_all) {}
    void set_pose(std::size_t pose) { pose_ = pose; }
    // Whether something measured that is at least `least` could change what is kept.
    bool wants(PoseCheck check, double least) const;
    void add(PoseCheck check, double measured, MarginPair pair = {});
    // The least relative margin of checks that a place can change, less `refused` if any other is refused; negative
    // where anything is.
    double score() const { return is_refused_ ? score_ - refused : score_; }
    static constexpr double refused = 1000;
    // The pose of the least margin that the score stands for.
    std::size_t worst_pose() const { return worst_pose_; }
    const TightestMargin& of(PoseCheck check) const { return tightest_[static_cast<std::size_t>(check)]; }

 private:
    std::array<TightestMargin, pose_checks> tightest_{};
    double score_ = std::numeric_limits<double>::infinity();
    std::size_t pose_ = 0;
    std::size_t worst_pose_ = 0;
    bool is_refused_ = false;
    bool keeps_all_;
};

// "link 3 and the block", "axis 5 and its upper limit". Precondition: the cell has a machine.
std::string describe_pair(const Cell& cell, PoseCheck check, MarginPair pair);

}  // namespace qchopper
