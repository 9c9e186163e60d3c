// A search for pieces that are within reach ends, whatever the shape, with what is really asked of a piece.

#include "app/jobs/unreachable_of.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/search/search.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TriangleMesh flattened(TriangleMesh mesh, double z) {
    for (Vec3& p : mesh.points) p.z *= z;
    return mesh;
}

std::vector<shapes::Named> awkward_shapes() {
    TriangleMesh tetrahedron;
    tetrahedron.points = {{0, 0, 0}, {400, 0, 0}, {0, 400, 0}, {0, 0, 400}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return {{"tetrahedron", tetrahedron},
            {"flat ball", flattened(shapes::ball({0, 0, 0}, 200, 8), 1e-3)},
            {"grain far away", shapes::box({5000, 5000, 5000}, {5000.01, 5000.01, 5000.01})},
            {"nested", shapes::nested(), 2},
            {"linked", shapes::linked_tori(), 2}};
}

struct Found {
    Segmentation segmentation;
    SearchEnd end;
};

Found searched(const TriangleMesh& mesh) {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = 1;
    settings.stop.max_unreachable = 0;  // never kept by a piece without a cap: trials, until none gains enough
    settings.stop.max_cuts = 4;
    Found found{uncut(mesh, 0), {}};
    EvaluationCache cache(settings.objectives, settings.candidates);
    const PieceChecks checks{{}, unreachable_of(60)};
    found.end = search(found.segmentation, settings, cache, checks, [](const Segmentation&) {}, {});
    return found;
}

TEST(UnreachableOf, IsAShareOfTheSurfaceOfAnyShape) {
    for (const double tilt : {0.0, 60.0, 90.0}) {
        const UnreachableOf unreachable = unreachable_of(tilt);
        for (const shapes::Named& shape : awkward_shapes()) {
            const UnreachableSurface found = unreachable(piece_of(shape.mesh));
            EXPECT_TRUE(found.share >= 0 && found.share <= 1) << shape.name << " " << found.share;
            EXPECT_TRUE(found.mm2 >= 0 && found.mm2 <= area_mm2(shape.mesh) * (1 + 1e-9)) << shape.name;
            const ThreadLimit one(1);
            const UnreachableSurface again = unreachable(piece_of(shape.mesh));
            EXPECT_EQ(again.share, found.share) << shape.name;
            EXPECT_EQ(again.mm2, found.mm2) << shape.name;
        }
    }
}

TEST(UnreachableOf, SearchesOfAwkwardShapesEnd) {
    for (const shapes::Named& shape : awkward_shapes()) {
        const Found found = searched(shape.mesh);
        EXPECT_TRUE(found.end.reason == EndReason::rules_hold || found.end.reason == EndReason::passed_over ||
                    found.end.reason == EndReason::max_cuts)
            << shape.name << ": " << found.end.sentence;
        EXPECT_LE(found.segmentation.cuts.size(), 4U) << shape.name;
        const ThreadLimit one(1);
        const Found again = searched(shape.mesh);
        EXPECT_EQ(again.end.sentence, found.end.sentence) << shape.name;
        EXPECT_EQ(again.segmentation.cuts, found.segmentation.cuts) << shape.name;
    }
}

}  // namespace
}  // namespace qchopper
