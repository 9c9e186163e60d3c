#include "segment/objectives/sweep/symmetry_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/sweep/sweep.h"
#include "tests/pieces.h"
#include "tests/segment/access/cut_samples.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<Vec3> points_of(const Piece& piece, const Plane& plane) {
    const PreparedPiece prepared = prepare(piece, {});
    SweptSections s;
    const std::array offsets{plane.offset};
    s.slabs = slabs(prepared, plane.normal, offsets);
    s.section = find_section(prepared, s.slabs, offsets);
    s.regions.push_back(regions(s.section, 0));
    double area = 0;
    for (const SectionLoop& loop : s.section.loops) area += loop.area_mm2;
    return points_in_section(prepared, plane, s, 0, area);
}

double asymmetry(const Piece& piece, const Plane& plane, const Plane& symmetry) {
    Objectives o;
    o.weights.symmetry = 1;
    o.symmetry_plane = symmetry;
    return sweep(prepare(piece, o), plane.normal, {&plane.offset, 1}, o)[0]->symmetry_mm;
}

TEST(Symmetry, PointsStandEvenlyInTheSection) {
    const Piece torus = piece_of(shapes::torus({0, 0, 0}, 50, 20, 60));
    const std::vector<Vec3> points = points_of(torus, {{0, 0, 1}, 1.5});
    EXPECT_NEAR(static_cast<double>(points.size()), section_points, 15);
    for (const Vec3& p : points) {
        EXPECT_NEAR(p.z, 1.5, 1e-9);
        EXPECT_NEAR(std::hypot(p.x, p.y), 50, 20.1);
    }
}

TEST(Symmetry, ItIsZeroForThePlaneItselfAndForSymmetricSectionsAcrossIt) {
    const Piece box = piece_of(shapes::box({-50, -30, -20}, {50, 30, 20}, 4));
    const Plane middle{{1, 0, 0}, 0};
    EXPECT_NEAR(asymmetry(box, {{1, 0, 0}, 1e-6}, middle), 0, 1e-5);
    const double spacing = std::sqrt(100 * 60 / section_points);
    EXPECT_LT(asymmetry(box, {{0, 0, 1}, 3.3}, middle), spacing) << "up to the grid";
    EXPECT_NEAR(asymmetry(box, {{1, 0, 0}, 25.1}, middle), 50.2, 1e-9) << "parallel: twice the distance";
    EXPECT_GT(asymmetry(box, {canonical({normalized({1, 0, 1}), 3}).normal, 3.0}, middle), 2 * spacing);
}

void expect_mean_square(const Piece& piece, const Plane& plane, const Plane& symmetry, const std::string& what) {
    const std::vector<Vec3> points = points_of(piece, plane);
    double sum = 0;
    for (const Vec3& p : points) {
        double least = 1e300;
        for (const Vec3& q : points) {
            const double off = dot(symmetry.normal, q) - symmetry.offset;
            least = std::min(least, norm(p - (q - (2 * off) * symmetry.normal)));
        }
        sum += least * least;
    }
    const double plain = std::sqrt(sum / static_cast<double>(points.size()));
    EXPECT_NEAR(asymmetry(piece, plane, symmetry), plain, 1e-9 * plain) << what;
}

TEST(Symmetry, ItIsTheMeanSquareOfTheDistancesToTheNearestReflectedPoint) {
    const Piece tori = piece_of(shapes::linked_tori());
    const Vec3 n = canonical({normalized({1, 2, 2}), 0}).normal;
    const Extent range = extent(*tori.mesh, n);
    const Plane symmetry{canonical({normalized({3, -1, 1}), 0}).normal, 4.5};
    expect_mean_square(tori, {n, range.low + 0.4 * range.size()}, symmetry, "tori");
    for (const SampleCut& of : cut_samples({Specimen::femur})) {
        const Extent extent_of = extent(*of.piece.mesh, of.normal);
        for (const double share : {0.3, 0.6}) {
            const auto at = nudge(of.piece, of.normal, std::array{extent_of.low + share * extent_of.size()});
            if (at[0]) expect_mean_square(of.piece, {of.normal, at[0]->offset}, {{1, 0, 0}, 3}, of.name);
        }
    }
}

TEST(Symmetry, WithoutAPlaneItCostsNothing) {
    const Piece box = piece_of(shapes::box({-50, -30, -20}, {50, 30, 20}, 4));
    Objectives o;
    o.weights.symmetry = 1;
    const double at = 3;
    EXPECT_EQ(sweep(prepare(box, o), {0, 0, 1}, {&at, 1}, o)[0]->symmetry_mm, 0);
}

}  // namespace
}  // namespace qchopper
