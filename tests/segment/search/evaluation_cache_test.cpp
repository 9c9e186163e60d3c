#include "segment/search/evaluation_cache.h"

#include <gtest/gtest.h>

#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings quick() {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = 7;
    return settings;
}

TEST(EvaluationCache, RankingAfterAChangeOfWeightsIsThatOfEvaluatingAnewAndEvaluatesNothing) {
    SearchSettings settings = quick();
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Segmentation segmentation = uncut(mesh, 0);
        EvaluationCache cache(settings.objectives, settings.candidates);
        rank(segmentation, 0, settings, cache, {});
        const std::size_t evaluated = cache.evaluated_count();
        for (const Weights& weights : {Weights{1, 0, 0, 0}, Weights{0, 3, 1, 90}, Weights{5, 1, 200, 1}}) {
            for (const double threshold : {1.0, 1.5, 4.0}) {
                settings.objectives.weights = weights;
                settings.objectives.face_ratio_threshold = threshold;
                EvaluationCache fresh(settings.objectives, settings.candidates);
                EXPECT_EQ(rank(segmentation, 0, settings, cache, {}), rank(segmentation, 0, settings, fresh, {}))
                    << name;
            }
        }
        EXPECT_EQ(cache.evaluated_count(), evaluated) << name;
    }
}

TEST(EvaluationCache, EvaluatesEveryPieceOnceAndOnlyThoseThatAreCut) {
    SearchSettings settings = quick();
    settings.stop.min_cuts = 6;
    const TriangleMesh mesh = shapes::linked_tori();
    Segmentation segmentation = uncut(mesh, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
    EXPECT_GE(cache.evaluated_count(), 6U);
    EXPECT_LE(cache.evaluated_count(), segmentation.names_given) << "more evaluations than pieces that ever were";
    EXPECT_LE(cache.evaluated_count(), 8U) << "pieces were evaluated that were not to be cut";
    EXPECT_EQ(cache.box_count(), cache.evaluated_count());
}

TEST(EvaluationCache, SearchesNoBoxTwiceAlsoWithARuleOnBoxes) {
    SearchSettings settings = quick();
    settings.stop.max_obb = Vec3{40, 40, 40};
    for (const std::size_t beam : {1U, 3U}) {
        settings.beam = beam;
        Segmentation segmentation = uncut(shapes::torus({0, 0, 0}, 40, 12), 0);
        EvaluationCache cache(settings.objectives, settings.candidates);
        EXPECT_TRUE(search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {}).is_finished());
        EXPECT_GT(segmentation.cuts.size(), 2U);
        if (beam == 1) {
            EXPECT_EQ(cache.box_count(), segmentation.names_given);
        }
        for (const Piece& piece : segmentation.pieces) {
            const std::size_t before = cache.box_count();
            EXPECT_TRUE(fits_in(cache.box(piece).size(), *settings.stop.max_obb));
            EXPECT_EQ(cache.box_count(), before);
        }
    }
}

TEST(EvaluationCache, SeveralPiecesAtOnceAreEachEvaluatedAsAlone) {
    const Segmentation segmentation = uncut(shapes::linked_tori(), 0);
    ASSERT_EQ(segmentation.pieces.size(), 2U);
    const SearchSettings settings = quick();
    EvaluationCache together(settings.objectives, settings.candidates);
    const std::vector<const Piece*> both{&segmentation.pieces[0], &segmentation.pieces[1]};
    std::size_t last = 0;
    std::size_t total = 0;
    Context context;
    context.on_progress = [&](const Progress& p) {
        EXPECT_GE(p.done, last) << "counts never go back";
        last = p.done;
        total = p.total;
    };
    together.evaluate(both, context);
    EXPECT_EQ(last, total);
    EXPECT_GT(total, 0U);
    for (std::size_t p = 0; p < 2; ++p) {
        EvaluationCache alone(settings.objectives, settings.candidates);
        EXPECT_EQ(rank(segmentation, p, settings, together, {}), rank(segmentation, p, settings, alone, {}));
    }
}

TEST(EvaluationCache, DropsWhatNoSegmentationHolds) {
    const SearchSettings settings = quick();
    const Segmentation segmentation = uncut(shapes::linked_tori(), 0);
    Segmentation one = segmentation;
    one.pieces.pop_back();
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<const Piece*> both{&segmentation.pieces[0], &segmentation.pieces[1]};
    cache.evaluate(both, {});
    const Segmentation* kept = &one;
    cache.keep_only(std::span(&kept, 1));
    EXPECT_TRUE(cache.is_evaluated(segmentation.pieces[0]));
    EXPECT_FALSE(cache.is_evaluated(segmentation.pieces[1]));
}

}  // namespace
}  // namespace qchopper
