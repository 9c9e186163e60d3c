#include "segment/access/sampled_piece.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "segment/access/piece_access.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/oriented_box.h"
#include "segment/sample/sample.h"
#include "segment/search/segmentation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::size_t count = 8'000;

TriangleMesh bone(Specimen specimen) {
    SampleOptions options;
    options.faces = 12'000;
    return sample(specimen, options);
}

// Cuts the largest piece across the longest side of its box, so often.
void cut_largest(Segmentation& segmentation, int times) {
    for (int i = 0; i < times; ++i) {
        const Piece& largest = *std::max_element(
            segmentation.pieces.begin(), segmentation.pieces.end(),
            [](const Piece& a, const Piece& b) { return a.mesh->triangles.size() < b.mesh->triangles.size(); });
        const Vec3 normal = canonical({oriented_box(largest.mesh->points).axis[0], 0}).normal;
        const Extent range = extent(*largest.mesh, normal);
        const auto nudged = nudge(largest, normal, std::array{range.low + 0.47 * range.size()});
        ASSERT_TRUE(nudged[0]);
        Cut cut;
        cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
        cut.piece = largest.name;
        cut.chosen.plane = {normal, nudged[0]->offset};
        ASSERT_TRUE(apply(segmentation, cut, 0));
    }
}

TEST(SampledPiece, EveryCutHandsTheSamplesOn) {
    Segmentation segmentation = uncut(bone(Specimen::vertebra), 0);
    sample_uncut(segmentation.pieces, {}, count);
    cut_largest(segmentation, 4);
    std::vector<std::uint32_t> all;
    for (const Piece& piece : segmentation.pieces) {
        ASSERT_TRUE(piece.samples);
        const PieceAccessibility& table = piece.samples->accessibility;
        all.insert(all.end(), table.sample.begin(), table.sample.end());
        EXPECT_EQ(table.scan_triangle.size(), piece.mesh->triangles.size());
        EXPECT_EQ(piece.samples->caps.size(), owned_caps(piece).size());
        EXPECT_EQ(piece.samples->scan, segmentation.pieces.front().samples->scan);
    }
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> wanted(count);
    std::iota(wanted.begin(), wanted.end(), 0U);
    EXPECT_EQ(all, wanted) << "each sample lies on one piece";
}

TEST(SampledPiece, KeptSamplesAndOwnOnesSayTheSame) {
    for (const Specimen specimen : {Specimen::femur, Specimen::skull}) {
        Segmentation segmentation = uncut(bone(specimen), 0);
        sample_uncut(segmentation.pieces, {}, count);
        cut_largest(segmentation, 2);
        for (const Piece& piece : segmentation.pieces) {
            const std::size_t rows = piece.samples->accessibility.sample.size();
            if (rows < 1'000) continue;
            PieceAccessOptions options;
            options.samples = rows;
            const std::vector<PieceBase> bases = bases_of(piece);
            const PieceAccess own = piece_access(piece, bases, options);
            options.takes_kept = true;
            const PieceAccess kept = piece_access(piece, bases, options);
            EXPECT_EQ(kept.samples, piece.samples);
            EXPECT_NE(own.samples, piece.samples);
            for (std::size_t b = 0; b < bases.size(); ++b) {
                EXPECT_NEAR(kept.bases[b].area_mm2, own.bases[b].area_mm2, 0.03 * own.bases[b].area_mm2);
                EXPECT_NEAR(kept.bases[b].share(), own.bases[b].share(), 0.04) << piece.name;
            }
            options.samples = rows + 1;
            EXPECT_NE(piece_access(piece, bases, options).samples, piece.samples) << "too few: own ones are taken";
        }
    }
}

TEST(SampledPiece, WithoutSamplesNoneAreHandedOn) {
    Segmentation segmentation = uncut(bone(Specimen::femur), 0);
    cut_largest(segmentation, 1);
    for (const Piece& piece : segmentation.pieces) EXPECT_FALSE(piece.samples);
}

TEST(SampledPiece, AStoreThatHasTheDistancesIsBelieved) {
    Segmentation first = uncut(shapes::linked_tori(), 0);
    std::vector<PieceAccessibility> kept;
    DistanceStore store;
    store.keep = [&](const SampledScan&, const std::vector<PieceAccessibility>& pieces) { kept = pieces; };
    sample_uncut(first.pieces, store, 500);
    ASSERT_EQ(kept.size(), first.pieces.size());
    store.keep = [](const SampledScan&, const std::vector<PieceAccessibility>&) { ADD_FAILURE(); };
    store.find = [&](const SampledScan&) { return std::optional(kept); };
    Segmentation second = uncut(shapes::linked_tori(), 0);
    sample_uncut(second.pieces, store, 500);
    for (std::size_t i = 0; i < first.pieces.size(); ++i) {
        EXPECT_EQ(second.pieces[i].samples->accessibility.distance, first.pieces[i].samples->accessibility.distance);
    }
}

}  // namespace
}  // namespace qchopper
