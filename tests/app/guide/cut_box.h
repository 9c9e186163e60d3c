// A box of three pieces that are joined by two cuts, for tests of the assembly guide.

#pragma once

#include "app/jobs/project_joints.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {

struct CutBox {
    Segmentation segmentation = uncut(shapes::box({0, 0, 0}, {200, 100, 80}, 3), 0);
    ProjectJoints joints;

    CutBox() {
        EXPECT_TRUE(cut_at(segmentation, "A", {{1, 0, 0}, 110}));
        EXPECT_TRUE(cut_at(segmentation, segmentation.pieces[0].name, {{0, 1, 0}, 40}));
        joints = project_joints(segmentation, nullptr, {});
    }
    const std::vector<Piece>& pieces() const { return segmentation.pieces; }
};

}  // namespace qchopper
