// The pages of an assembly guide: what is there, the blocks, the steps of the assembly, the pieces.
//
// Tests: tests/app/guide/make_guide_test.cpp.

#pragma once

#include <span>
#include <string>

#include "app/guide/guide.h"
#include "app/jobs/project_joints.h"
#include "app/jobs/project_sheets.h"
#include "segment/cut/piece.h"

namespace qchopper {

// What a guide is made from. Everything must outlive the call.
struct GuideInput {
    std::string order;  // what people call it
    std::span<const Piece> pieces;
    const ProjectJoints& joints;
    const OrderContent& jobs;
};

// Whether the pieces that move in a step must be held, because no glued face holds them when they are in place.
bool must_be_held(const AssemblyStep& step);

// Pictures are drawn on several threads; progress in pictures. Throws Cancelled.
AssemblyGuide make_guide(const GuideInput& input, const Context& context);

}  // namespace qchopper
