#include "cam/setup/setup.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

TEST(SetupFrame, SpoilLayerAndWhatIsMilledAreTheBlock) {
    for (const double spoil : {0.0, 12.5}) {
        qchopper::Setup setup;
        setup.block.size = {301, 187, 93};
        setup.spoil = spoil;
        const Box block = setup.block_box();
        const Box milled = setup.milled_box();
        EXPECT_EQ(block.size(), setup.block.size);
        EXPECT_EQ(block.min.x + block.max.x, 0);
        EXPECT_EQ(block.min.y + block.max.y, 0);
        EXPECT_EQ(milled.min.z, 0) << "the base of the piece; below it the tool has nothing to do";
        EXPECT_NEAR(milled.size().z + spoil, setup.block.size.z, 1e-12);
        EXPECT_EQ(milled.max, block.max);
    }
}

}  // namespace
}  // namespace qchopper
