// The joints of a project's pieces, the order of their assembly, and how much of the seams shows.
//
// mm. Values for jobs, exports and reports; nothing of it is stored (tests/app/jobs/project_joints_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "base/context.h"
#include "base/enum_names.h"
#include "cam/cell/cell.h"
#include "cam/setup/setup.h"
#include "segment/joint/assembly.h"
#include "segment/joint/joint_chain.h"
#include "segment/joint/seam.h"

namespace qchopper {

// How the two faces of a joint are made: by the saw (a base that is parted, a face of the block) or by the machine.
enum class JointFaces { sawn_sawn, sawn_milled, milled_milled };

constexpr auto names_of(JointFaces) {
    return EnumNames<JointFaces, 3>{{{JointFaces::sawn_sawn, "sawn-sawn"},
                                     {JointFaces::sawn_milled, "sawn-milled"},
                                     {JointFaces::milled_milled, "milled-milled"}}};
}

// `below` and `above` are the setups of its pieces.
JointFaces joint_faces(const PieceJoint& joint, const Setup& below, const Setup& above);

struct ProjectJoints {
    std::vector<std::string> pieces;  // names, by the indices of joints and steps
    std::vector<PieceJoint> joints;
    std::vector<std::string> faults;  // one per joint (describe_fault); empty: none
    Assembly assembly;
    SeamLength seam;
    std::vector<JointFaces> faces;  // one per joint; empty: the setups are not known
    JointChain chain;
    double accuracy = Saw{}.accuracy;  // mm, by which each joint may be off
};

// "8 + 6", or "none": the diameters of the holes of its dowels.
std::string describe_dowels(const PieceJoint& joint);

// `cell` may be nullptr: then dowels have the default sizes.
JointSettings joint_settings(const Cell* cell);

// All of it but the faces. Throws Cancelled.
ProjectJoints project_joints(const Segmentation& segmentation, const Cell* cell, const Context& context);

}  // namespace qchopper
