// Joint moves through the air: from home to where an operation begins, and from its end home.
//
// mm, radians. All axes move linearly together; every pose at most half a degree of an axis farther than the one before
// is judged with the margins of machine_reachability.h: limits, arm, tool, holder and spindle against the whole block,
// table, floor, obstacles and the arm itself. Not for several threads at once.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/program/program.h"
#include "cam/setup/placement/pose_judge.h"
#include "cam/setup/setup.h"

namespace qchopper {

// Where an operation begins or ends.
struct OperationEnd {
    Vec3 tip;  // in setup coordinates
    Joints joints{};
    const ProgramOperation* operation = nullptr;
};

class PtpPlanner {
 public:
    // With one tool of the cell. Precondition: the cell has a robot; everything outlives this object.
    PtpPlanner(const Setup& setup, const Cell& cell, std::size_t tool);
    PtpPlanner(const PtpPlanner&) = delete;
    PtpPlanner& operator=(const PtpPlanner&) = delete;

    // Between home and an end: the retract, and the targets on the way from home, the retracted pose last and home left
    // out. Where the block is higher than the tool at home, and no way is clear else, the first target is above home.
    // Nothing if none is clear.
    std::optional<PtpPath> from_home(const OperationEnd& end);

    // Whether the joint move from home to an end is clear, with poses every 2 degrees.
    bool starts_clear(const OperationEnd& end);

    // Whether home is clear while the table turns from one angle to another.
    bool turns_clear(double from_angle, double to_angle);

    // What was too near on the way that was refused last.
    const std::string& refusal() const { return refusal_; }

 private:
    StandingBlock standing_at(double table_angle) const;
    bool is_clear(const StandingBlock& block, const Joints& from, const Joints& to, double step);
    bool is_clear(const StandingBlock& block, const Joints& joints);
    // Of joint moves from home to one target after the other.
    bool is_clear(const StandingBlock& block, const std::vector<Joints>& targets);
    // Straight above home, the tool over the whole block; nothing if it is that at home, or the arm does not come
    // there.
    std::optional<Joints> over_home(const StandingBlock& block) const;
    // The joints at the retracted pose, come to on a straight line, and the speed of that.
    std::optional<Joints> retracted(const OperationEnd& end, double retract, double& speed);

    const Setup& setup_;
    const Cell& cell_;
    CuttingTool slow_tool_;
    PoseJudge judge_;
    Joints home_;
    std::string refusal_;
};

}  // namespace qchopper
