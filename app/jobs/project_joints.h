// The joints of a project's pieces, the order of their assembly, and how much of the seams shows.
//
// mm. Values for jobs, exports and reports; nothing of it is stored (tests/app/jobs/project_joints_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "segment/joint/assembly.h"
#include "segment/joint/seam.h"

namespace qchopper {

struct ProjectJoints {
    std::vector<std::string> pieces;  // names, by the indices of joints and steps
    std::vector<PieceJoint> joints;
    std::vector<std::string> faults;  // one per joint (describe_fault); empty: none
    Assembly assembly;
    SeamLength seam;
};

// `cell` may be nullptr: then dowels have the default sizes.
JointSettings joint_settings(const Cell* cell);

// All of it. Throws Cancelled.
ProjectJoints project_joints(const Segmentation& segmentation, const Cell* cell, const Context& context);

}  // namespace qchopper
