#include "segment/search/candidates/no_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/search/candidates/candidates.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<Vec3> points_where(const TriangleMesh& mesh, const std::function<bool(Vec3)>& is_marked) {
    std::vector<Vec3> points;
    std::copy_if(mesh.points.begin(), mesh.points.end(), std::back_inserter(points), is_marked);
    return points;
}

// A triangle with a marked corner has corners on both sides.
bool crosses_marked(const TriangleMesh& mesh, const std::vector<Vec3>& marked, const Plane& plane) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        bool has_mark = false;
        int above = 0;
        for (const Vec3& p : corners_of(mesh, t)) {
            has_mark = has_mark || std::find(marked.begin(), marked.end(), p) != marked.end();
            above += height(plane.normal, p) > plane.offset ? 1 : 0;
        }
        if (has_mark && above > 0 && above < 3) return true;
    }
    return false;
}

TEST(NoCut, HeightsAreThoseAtWhichAMarkedTriangleIsCrossed) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        for (int round = 0; round < 3; ++round) {
            const Vec3 towards = random_normal(random);
            const Extent all = extent(mesh, towards);
            const std::vector<Vec3> marked =
                points_where(mesh, [&](Vec3 p) { return height(towards, p) > all.high - 0.3 * all.size(); });
            const std::vector<NoCutTriangle> triangles = no_cut_triangles(mesh, no_cut_at(marked));
            const Vec3 normal = random_normal(random);
            const std::vector<Extent> heights = forbidden_heights(triangles, normal);
            for (std::size_t i = 0; i + 1 < heights.size(); ++i) EXPECT_LE(heights[i].high, heights[i + 1].low) << name;
            const Extent range = extent(mesh, normal);
            for (int k = 0; k < 50; ++k) {
                const double offset = range.low + share(random) * range.size();
                EXPECT_EQ(is_forbidden(heights, offset), crosses_marked(mesh, marked, {normal, offset})) << name;
            }
        }
    }
}

TEST(NoCut, IntervalsThatOnlyTouchLeaveTheHeightBetweenThem) {
    const std::vector<NoCutTriangle> triangles{{Vec3{0, 0, 0}, Vec3{1, 0, 1}, Vec3{0, 1, 1}},
                                               {Vec3{0, 0, 1}, Vec3{1, 0, 2}, Vec3{0, 1, 2}},
                                               {Vec3{0, 0, 3}, Vec3{1, 0, 3}, Vec3{0, 1, 3}}};
    const std::vector<Extent> heights = forbidden_heights(triangles, {0, 0, 1});
    ASSERT_EQ(heights.size(), 2U) << "a triangle that lies flat is crossed by no plane";
    EXPECT_TRUE(is_forbidden(heights, 0.5));
    EXPECT_FALSE(is_forbidden(heights, 1));
    EXPECT_TRUE(is_forbidden(heights, 1.5));
    EXPECT_FALSE(is_forbidden(heights, 2.5));
    EXPECT_FALSE(is_forbidden(heights, 3));
    EXPECT_FALSE(is_forbidden({}, 0));
}

TEST(NoCut, NoCandidateCrossesMarkedSurfaceAndAllOthersStay) {
    const Piece piece = piece_of(shapes::torus({0, 0, 0}, 40, 12));
    const std::vector<Vec3> marked = points_where(*piece.mesh, [](Vec3 p) { return p.x > 20; });
    CandidateOptions options;
    options.normals = CandidateNormals::sphere;
    options.offsets_per_normal = 9;
    const std::vector<Candidate> all = candidate_planes(piece, options);
    options.no_cut = no_cut_at(marked);
    const std::vector<Candidate> left = candidate_planes(piece, options);
    std::vector<Plane> expected;
    for (const Candidate& c : all) {
        if (!crosses_marked(*piece.mesh, marked, c.plane)) expected.push_back(c.plane);
    }
    ASSERT_EQ(left.size(), expected.size());
    for (std::size_t i = 0; i < left.size(); ++i) EXPECT_EQ(left[i].plane, expected[i]);
    EXPECT_GT(left.size(), 100U);
    EXPECT_LT(left.size(), all.size() - 100);
}

TEST(NoCut, MarksAreThoseOfTheScanInEveryPiece) {
    const TriangleMesh scan = shapes::torus({0, 0, 0}, 40, 12);
    const std::vector<Vec3> marked = points_where(scan, [](Vec3 p) { return p.x > 20; });
    const std::optional<CutPieces> cut = cut_piece(piece_of(scan), {{0, 1, 0}, 0.123}, 1);
    ASSERT_TRUE(cut);
    std::size_t triangles = 0;
    for (const Piece& piece : cut->pieces) {
        const NoCut no_cut = no_cut_at(marked);
        triangles += no_cut_triangles(*piece.mesh, no_cut).size();
        for (const Candidate& c : candidates_along(piece, {1, 0, 0}, 0, 30)) {
            const bool is_crossed = crosses_marked(*piece.mesh, marked, c.plane);
            EXPECT_EQ(
                is_forbidden(forbidden_heights(no_cut_triangles(*piece.mesh, no_cut), c.plane.normal), c.plane.offset),
                is_crossed);
        }
    }
    EXPECT_GE(triangles, no_cut_triangles(scan, no_cut_at(marked)).size());
}

TEST(NoCut, IsTheSameInAnyOrderOfThePoints) {
    EXPECT_EQ(no_cut_at({{1, 2, 3}, {0, 5, 6}}), no_cut_at({{0, 5, 6}, {1, 2, 3}}));
    EXPECT_NE(no_cut_at({{1, 2, 3}}), no_cut_at({}));
    EXPECT_EQ(no_cut_at({}), NoCut{});
}

}  // namespace
}  // namespace qchopper
