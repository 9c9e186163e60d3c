// One call after the other, each timed.

#include "app/jobs/project_joints.h"

#include "base/text.h"
#include "base/timings.h"

namespace qchopper {

JointSettings joint_settings(const Cell* cell) {
    JointSettings settings;
    if (cell != nullptr) {
        settings.sizes = cell->dowels;
        settings.play = cell->dowel_play;
    }
    return settings;
}

JointFaces joint_faces(const PieceJoint& joint, const Setup& below, const Setup& above) {
    const int sawn = (below.is_unmilled(joint.cut) ? 1 : 0) + (above.is_unmilled(joint.cut) ? 1 : 0);
    return sawn == 2 ? JointFaces::sawn_sawn : sawn == 1 ? JointFaces::sawn_milled : JointFaces::milled_milled;
}

std::string describe_dowels(const PieceJoint& joint) {
    std::string words;
    for (const Dowel& dowel : joint.dowels) {
        words += (words.empty() ? "" : " + ") + significant(dowel.size.diameter, 4);
    }
    return words.empty() ? "none" : words;
}

ProjectJoints project_joints(const Segmentation& segmentation, const Cell* cell, const Context& context) {
    StageTimer stage(context, "dowels placed");
    ProjectJoints made;
    for (const Piece& piece : segmentation.pieces) made.pieces.push_back(piece.name);
    made.joints = piece_joints(segmentation.pieces, joint_settings(cell), context);
    for (const PieceJoint& joint : made.joints) {
        made.faults.push_back(describe_fault(joint, segmentation.pieces, made.joints));
    }
    made.chain = longest_chain(made.pieces.size(), made.joints);
    if (cell != nullptr) made.accuracy = cell->saw.accuracy;
    stage.next("assembly ordered");
    made.assembly = assembly_of(segmentation, made.joints, context);
    stage.next("seams measured");
    made.seam = seam_length(segmentation.pieces, 2, context);
    return made;
}

}  // namespace qchopper
