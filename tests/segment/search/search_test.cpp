#include "segment/search/search.h"

#include <gtest/gtest.h>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/search/piece_names.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double total_volume(const Segmentation& segmentation) {
    double sum = 0;
    for (const Piece& piece : segmentation.pieces) sum += volume_mm3(*piece.mesh);
    for (const Fragment& fragment : segmentation.fragments) sum += fragment.volume_mm3;
    return sum;
}

SearchSettings quick(int cuts) {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = 7;
    settings.stop.min_cuts = cuts;
    return settings;
}

Segmentation searched(const TriangleMesh& mesh, const SearchSettings& settings) {
    Segmentation segmentation = uncut(mesh, settings.objectives.fragment_volume_mm3);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const SearchEnd end = search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
    EXPECT_TRUE(end.is_finished()) << end.sentence;
    return segmentation;
}

TEST(Search, NothingIsLostOnAnyShape) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Segmentation segmentation = searched(mesh, quick(4));
        EXPECT_EQ(segmentation.cuts.size(), 4U) << name;
        EXPECT_GE(segmentation.pieces.size(), count + 4) << name;
        EXPECT_NEAR(total_volume(segmentation) / volume_mm3(mesh), 1, 1e-9) << name;
        for (const Piece& piece : segmentation.pieces) {
            EXPECT_TRUE(edges(*piece.mesh).faults.is_closed()) << name;
        }
    }
}

TEST(Search, TheChosenPlaneIsTheBestOfAllRankedAndRunnersUpFollowInOrder) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Segmentation segmentation = searched(mesh, quick(2));
    for (const Cut& cut : segmentation.cuts) {
        double last = cut.chosen.terms.total;
        EXPECT_FALSE(cut.runners_up.empty());
        for (const Ranked& r : cut.runners_up) {
            EXPECT_GE(r.terms.total, last - 1e-9);
            last = r.terms.total;
        }
    }
}

TEST(Search, TiesGoToTheLowerNormalThenOffset) {
    const TriangleMesh cube = shapes::box({0, 0, 0}, {10, 10, 10}, 2);
    SearchSettings settings = quick(1);
    settings.objectives.weights = {0, 0, 1, 0};  // every plane gives two pieces: all tie
    const Segmentation segmentation = uncut(cube, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> ranked = rank(segmentation, 0, settings, cache, {});
    for (std::size_t i = 1; i < ranked.size(); ++i) {
        EXPECT_LT(std::pair(ranked[i - 1].normal_index, ranked[i - 1].offset_index),
                  std::pair(ranked[i].normal_index, ranked[i].offset_index));
    }
}

TEST(Search, ThePieceWithMostFacesIsCutFirst) {
    const TriangleMesh mesh = shapes::joined({shapes::ball({0, 0, 0}, 10, 8), shapes::ball({40, 0, 0}, 10, 12)});
    const Segmentation segmentation = searched(mesh, quick(1));
    EXPECT_EQ(segmentation.cuts[0].piece, "B");
    EXPECT_EQ(segmentation.cuts[0].pieces, (std::vector<std::string>{"C", "D"}));
}

TEST(Search, FragmentsAreListedAndNotCut) {
    const TriangleMesh mesh = shapes::joined({shapes::ball({0, 0, 0}, 10, 8), shapes::ball({40, 0, 0}, 0.1, 6)});
    SearchSettings settings = quick(1);
    settings.objectives.fragment_volume_mm3 = 1e-5 * volume_mm3(mesh);
    const Segmentation segmentation = searched(mesh, settings);
    ASSERT_EQ(segmentation.fragments.size(), 1U);
    EXPECT_EQ(segmentation.fragments[0].cut, 0);
    EXPECT_NEAR(segmentation.fragments[0].centre.x, 40, 0.1);
    EXPECT_NEAR(total_volume(segmentation) / volume_mm3(mesh), 1, 1e-9);
}

TEST(Search, GivesItsReasonWhenNoPlanePartsAnything) {
    SearchSettings settings = quick(1);
    settings.candidates.offsets_per_normal = 0;
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    Segmentation segmentation = uncut(mesh, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const SearchEnd end = search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
    EXPECT_FALSE(end.is_finished());
    EXPECT_EQ(end.reason, EndReason::no_plane);
    EXPECT_EQ(end.sentence, "no plane parts any of the unfinished pieces");
}

TEST(Search, WhenCancelledTheCutsMadeUntilThenRemain) {
    const TriangleMesh mesh = shapes::torus({0, 0, 0}, 40, 12);
    std::atomic<bool> stop{false};
    Context context;
    context.cancelled = &stop;
    Segmentation segmentation = uncut(mesh, 0);
    std::size_t reported = 0;
    const SearchSettings settings = quick(9);
    EvaluationCache cache(settings.objectives, settings.candidates);
    EXPECT_THROW(search(
                     segmentation, settings, cache, {},
                     [&](const Segmentation& s) {
                         reported = s.cuts.size();
                         if (reported == 2) stop = true;
                     },
                     context),
                 Cancelled);
    EXPECT_EQ(reported, 2U);
    EXPECT_EQ(segmentation.cuts.size(), 2U);
}

TEST(Search, IsTheSameTwice) {
    const TriangleMesh mesh = shapes::nested();
    EXPECT_EQ(searched(mesh, quick(3)).cuts, searched(mesh, quick(3)).cuts);
}

TEST(PieceNames, CountOnAfterZ) {
    EXPECT_EQ(piece_name(0), "A");
    EXPECT_EQ(piece_name(25), "Z");
    EXPECT_EQ(piece_name(26), "AA");
    EXPECT_EQ(piece_name(27), "AB");
    EXPECT_EQ(piece_name(26 + 26 * 26), "AAA");
}

}  // namespace
}  // namespace qchopper
