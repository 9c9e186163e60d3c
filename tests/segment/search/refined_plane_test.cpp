#include "segment/search/refined_plane.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "segment/access/access_sweep.h"
#include "segment/access/dense_access.h"
#include "segment/access/piece_access.h"
#include "segment/access/tool_directions.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/oriented_box.h"
#include "segment/sample/sample.h"
#include "segment/search/segmentation.h"

namespace qchopper {
namespace {

// Few enough that every sample is asked.
constexpr std::size_t sample_count = 900;

Segmentation bone(Specimen specimen) {
    SampleOptions options;
    options.faces = 6'000;
    Segmentation segmentation = uncut(sample(specimen, options), 0);
    sample_uncut(segmentation.pieces, {}, sample_count);
    return segmentation;
}

Plane plane_at(const Piece& piece, Vec3 normal, double share) {
    const Vec3 n = canonical({normal, 0}).normal;
    const Extent range = extent(*piece.mesh, n);
    return {n, nudge(piece, n, std::array{range.low + share * range.size()})[0]->offset};
}

// The pieces are really cut; each lies on the base that is best by the directions of the scan, and samples that none
// of these opens are asked along the dense ones. Nothing where the plane makes more than two solids.
std::optional<double> reference_mm2(Segmentation segmentation, const Plane& plane, double tilt_deg) {
    Cut cut;
    cut.number = 1;
    cut.piece = segmentation.pieces[0].name;
    cut.chosen.plane = plane;
    EXPECT_TRUE(apply(segmentation, cut, 0));
    if (segmentation.pieces.size() != 2) return std::nullopt;
    double sum = 0;
    for (const Piece& piece : segmentation.pieces) {
        const TiltBase best = area_on_best_base(piece, tilt_deg).base.base;
        sum += unreachable_area(piece.samples->judged(), best, tilt_deg, dense_directions()).total_mm2(tilt_deg);
    }
    return sum;
}

TEST(DenseAccess, IsWhatDenseDirectionsLeaveOfThePiecesThatAreReallyCut) {
    const Segmentation segmentation = bone(Specimen::femur);
    const Piece& piece = segmentation.pieces[0];
    const double sample_mm2 = scan_area_mm2(piece) / sample_count;
    int compared = 0;
    const std::array<Vec3, 3> axis = oriented_box(piece.mesh->points).axis;
    for (const double tilt : {10.0, 45.0, 60.0}) {
        DenseAccess access(piece, tilt);
        for (const Vec3& normal : {axis[0], axis[2], Vec3{0.6, 0.48, 0.64}}) {
            for (const double share : {0.4, 0.6}) {
                const Plane plane = plane_at(piece, normal, share);
                const std::optional<double> really = reference_mm2(segmentation, plane, tilt);
                if (!really) continue;
                ++compared;
                EXPECT_NEAR(access.unreachable_mm2(plane), *really, 3 * sample_mm2) << tilt << ' ' << share;
            }
        }
    }
    EXPECT_GE(compared, 12);
}

TEST(DenseAccess, NeverLeavesMoreThanTheDirectionsOfTheScan) {
    const Segmentation segmentation = bone(Specimen::skull);
    const Piece& piece = segmentation.pieces[0];
    DenseAccess access(piece, 60);
    for (const double share : {0.2, 0.5, 0.8}) {
        const Plane plane = plane_at(piece, {0.36, 0.48, 0.8}, share);
        const double dense = access.unreachable_mm2(plane);
        EXPECT_LE(dense, cut_access(piece, plane, 60).unreachable_mm2);
        EXPECT_GE(dense, 0);
    }
}

TEST(RefinedPlane, LeavesNoMoreAndReportsWhatItLeaves) {
    const Segmentation segmentation = bone(Specimen::skull);
    const Piece& piece = segmentation.pieces[0];
    bool is_better = false;
    for (const double share : {0.3, 0.5, 0.7}) {
        const Plane from = plane_at(piece, {0, 0, 1}, share);
        DenseAccess access(piece, 60);
        const double before = access.unreachable_mm2(from);
        const RefinedPlane found = refined_plane(access, piece, from, 1, {});
        EXPECT_LE(found.unreachable_mm2, before);
        EXPECT_NEAR(norm(found.plane.normal), 1, 1e-12);
        DenseAccess fresh(piece, 60);
        EXPECT_EQ(fresh.unreachable_mm2(found.plane), found.unreachable_mm2);
        is_better |= found.unreachable_mm2 < before;
    }
    EXPECT_TRUE(is_better);
}

// A plane along the caps of a piece stays so, or its block would no longer end in its cap.
TEST(RefinedPlane, ThatMayNotTurnKeepsItsNormalToTheBit) {
    const Segmentation segmentation = bone(Specimen::skull);
    const Piece& piece = segmentation.pieces[0];
    bool is_moved = false;
    bool turns_otherwise = false;
    for (const double share : {0.3, 0.5, 0.7}) {
        const Plane from = plane_at(piece, {0, 0, 1}, share);
        DenseAccess access(piece, 60);
        const RefinedPlane kept = refined_plane(access, piece, from, 1, {}, {}, false);
        EXPECT_EQ(kept.plane.normal, from.normal);
        EXPECT_LE(kept.unreachable_mm2, access.unreachable_mm2(from));
        is_moved |= kept.plane.offset != from.offset;
        turns_otherwise |= refined_plane(access, piece, from, 1, {}).plane.normal != from.normal;
    }
    EXPECT_TRUE(is_moved);
    EXPECT_TRUE(turns_otherwise) << "nothing was kept from turning";
}

TEST(RefinedPlane, IsTheSameForAnyNumberOfThreads) {
    const Segmentation segmentation = bone(Specimen::vertebra);
    const Piece& piece = segmentation.pieces[0];
    const Plane from = plane_at(piece, {0, 0, 1}, 0.5);
    const auto refine = [&] {
        DenseAccess access(piece, 60);
        return refined_plane(access, piece, from, 1, {}).plane;
    };
    const Plane several = refine();
    const ThreadLimit one(1);
    EXPECT_EQ(refine(), several);
}

}  // namespace
}  // namespace qchopper
