#include "cam/job/glue_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/sawn_jobs.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using PieceSetup = qchopper::Setup;  // gtest has a Setup of its own

PieceSetup with_caps(const std::vector<FlushCap>& caps) {
    PieceSetup setup;
    setup.block.size = {100, 80, 60};
    setup.flush_caps = caps;
    return setup;
}

TEST(GlueFaces, NameEveryJointOfAFlushCapAndNoOther) {
    const SawnJobs& all = sawn_jobs();
    std::size_t joints = 0;
    for (std::size_t p = 0; p < all.inputs.size(); ++p) {
        const PieceSetup& setup = all.inputs[p].setup;
        std::multiset<std::string> named;
        double area = 0;
        for (const GlueFace& face : glue_faces(setup, job_caps(all.inputs[p]))) {
            named.insert(face.neighbours.begin(), face.neighbours.end());
            area += face.area_mm2;
            EXPECT_TRUE(setup.flush_faces()[static_cast<std::size_t>(face.face)]);
        }
        std::multiset<std::string> wanted;
        double flush = 0;
        for (const FlushCap& cap : setup.flush_caps) {
            flush += cap.area_mm2;
            for (const PieceJoint& joint : all.joints) {
                if (joint.cut != cap.cut || (joint.below != p && joint.above != p)) continue;
                wanted.insert(all.segmentation.pieces[joint.below == p ? joint.above : joint.below].name);
                ++joints;
            }
        }
        EXPECT_EQ(named, wanted) << all.segmentation.pieces[p].name;
        EXPECT_NEAR(area, flush, 1e-9);
    }
    EXPECT_GE(joints, 6U);
}

TEST(GlueFaces, TheLargestAtTheSideAndTheLargestAcrossItAreTouched) {
    const auto touched = [](const std::vector<FlushCap>& caps) {
        const TouchFaces faces = touch_faces(with_caps(caps));
        return std::pair(faces.first, faces.second);
    };
    using Faces = std::pair<std::optional<BlockFace>, std::optional<BlockFace>>;
    EXPECT_EQ(touched({}), Faces());
    EXPECT_EQ(touched({{1, BlockFace::top, 9000}}), Faces()) << "the top gives no frame";
    EXPECT_EQ(touched({{1, BlockFace::plus_x, 900}}), Faces(BlockFace::plus_x, std::nullopt));
    EXPECT_EQ(touched({{1, BlockFace::minus_x, 900}, {2, BlockFace::plus_x, 901}}),
              Faces(BlockFace::plus_x, std::nullopt))
        << "of opposite faces one is touched";
    EXPECT_EQ(touched({{1, BlockFace::minus_x, 900}, {2, BlockFace::minus_y, 500}, {3, BlockFace::plus_y, 950}}),
              Faces(BlockFace::plus_y, BlockFace::minus_x));
    EXPECT_EQ(touched({{1, BlockFace::minus_x, 600}, {2, BlockFace::minus_x, 500}, {3, BlockFace::plus_y, 950}}),
              Faces(BlockFace::minus_x, BlockFace::plus_y))
        << "two caps lie in one face";
}

TEST(GlueFaces, OnlyThePieceInTheMiddleIsMadeByTheSawAlone) {
    const SawnJobs& all = sawn_jobs();
    for (std::size_t p = 0; p < all.inputs.size(); ++p) {
        const JobInput& input = all.inputs[p];
        EXPECT_EQ(is_only_sawn(input.setup, *input.piece.mesh), p == all.middle) << input.piece.name;
    }
    const JobInput& middle = all.inputs[all.middle];
    PieceSetup setup = middle.setup;
    EXPECT_EQ(setup.milled_caps_mm2, 0);
    setup.flush_caps.pop_back();
    EXPECT_FALSE(is_only_sawn(setup, *middle.piece.mesh)) << "a cap is left to mill";
    setup = middle.setup;
    setup.block.holds = false;
    EXPECT_FALSE(is_only_sawn(setup, *middle.piece.mesh)) << "no block holds it";
    EXPECT_FALSE(is_only_sawn(some_job().setup, *some_job().piece.mesh));
}

}  // namespace
}  // namespace qchopper
