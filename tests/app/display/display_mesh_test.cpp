#include "app/display/display_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "tests/app/display/cut_shapes.h"

namespace qchopper {
namespace {

using Face = std::array<DisplayPoint, 3>;

Face from_least(Face face) {
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    return face;
}

// The faces of each cap and of the skin, with their sense and as often as they are there.
std::map<std::int32_t, std::multiset<Face>> faces_by_cut(const DisplayMesh& mesh) {
    std::map<std::int32_t, std::multiset<Face>> faces;
    for (const DisplayGroup& group : mesh.groups) {
        for (std::uint32_t t = group.first; t < group.first + group.faces; ++t) {
            const Triangle& corner = mesh.triangles[t];
            faces[group.cut].insert(
                from_least({mesh.points[corner[0]], mesh.points[corner[1]], mesh.points[corner[2]]}));
        }
    }
    return faces;
}

// The same of the exact mesh, point by point.
std::map<std::int32_t, std::multiset<Face>> rounded_faces(const TriangleMesh& mesh, const DisplayGrid& grid) {
    std::map<std::int32_t, std::multiset<Face>> faces;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Face face;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = corners_of(mesh, t)[k];
            for (int axis = 0; axis < 3; ++axis) {
                face[k][static_cast<std::size_t>(axis)] =
                    static_cast<std::uint16_t>(std::lround((p[axis] - grid.origin[axis]) / grid.step));
            }
        }
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        faces[cap_of(mesh, t)].insert(from_least(face));
    }
    return faces;
}

std::multiset<Face> turned_over(const std::multiset<Face>& faces) {
    std::multiset<Face> result;
    for (const Face& face : faces) result.insert(from_least({face[0], face[2], face[1]}));
    return result;
}

TEST(DisplayMesh, HasTheFacesOfEveryShapeAndOfItsPartsOnTheGrid) {
    for (const shapes::Named& shape : awkward_shapes()) {
        const DisplayGrid grid = display_grid(bounds(shape.mesh));
        std::vector<TriangleMesh> meshes = parts_of(shape.mesh);
        meshes.push_back(shape.mesh);
        for (const TriangleMesh& mesh : meshes) {
            const DisplayMesh shown = display_mesh(mesh, grid);
            EXPECT_TRUE(is_valid(shown)) << shape.name;
            EXPECT_EQ(faces_by_cut(shown), rounded_faces(mesh, grid)) << shape.name;
            EXPECT_EQ(std::set<DisplayPoint>(shown.points.begin(), shown.points.end()).size(), shown.points.size());
        }
    }
}

TEST(DisplayMesh, TheGridMovesNoPointFartherThanItSays) {
    const TriangleMesh torus = bumpy_torus(45);
    const DisplayGrid grid = display_grid(bounds(torus));
    double farthest = 0;
    for (const Vec3& p : torus.points) farthest = std::max(farthest, norm(place(grid, nearest_point(grid, p)) - p));
    EXPECT_LE(farthest, 0.87 * grid.step);
    EXPECT_GT(farthest, 0.5 * grid.step);
    const Vec3 size = bounds(torus).size();
    EXPECT_NEAR(grid.step, std::max({size.x, size.y, size.z}) / 16383, 1e-12);
}

TEST(DisplayMesh, CapsOfNeighboursMeet) {
    for (const shapes::Named& shape : awkward_shapes()) {
        const DisplayGrid grid = display_grid(bounds(shape.mesh));
        const std::vector<TriangleMesh> halves = halves_of(shape.mesh, 1, {0.61, 0.31, 0.83});
        ASSERT_EQ(halves.size(), 2U) << shape.name;
        const auto above = faces_by_cut(display_mesh(halves[0], grid));
        const auto below = faces_by_cut(display_mesh(halves[1], grid));
        ASSERT_FALSE(above.at(1).empty()) << shape.name;
        EXPECT_EQ(above.at(1), turned_over(below.at(1))) << shape.name;
    }
}

TEST(DisplayMesh, FacesThatCollapseAreLeftOut) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1});
    const DisplayGrid coarse{{0, 0, 0}, 10};
    EXPECT_EQ(display_mesh(mesh, coarse), (DisplayMesh{coarse, {}, {}, {}}));
    mesh = shapes::joined({mesh, shapes::box({100, 0, 0}, {200, 100, 100})});
    EXPECT_EQ(display_mesh(mesh, coarse).triangles.size(), 12U);
    EXPECT_EQ(display_mesh({}, coarse).groups.size(), 0U);
}

TEST(DisplayMesh, PointsOutsideOfTheGridAreMovedToItsBorder) {
    const DisplayGrid grid{{0, 0, 0}, 1};
    EXPECT_EQ(nearest_point(grid, {-5, 3.4, 1e9}), (DisplayPoint{0, 3, max_display_coordinate}));
    EXPECT_TRUE(is_valid(display_mesh(shapes::ball({0, 0, 16383}, 40), grid)));
}

TEST(DisplayMesh, AGridIsFoundForEveryFiniteBox) {
    EXPECT_EQ(display_grid({{1, 2, 3}, {1, 2, 3}}), (DisplayGrid{{1, 2, 3}, 1}));
    EXPECT_GT(display_grid({{0, 0, 0}, {5e-324, 0, 0}}).step, 0);
    EXPECT_THROW(display_grid({{-1e308, 0, 0}, {1e308, 0, 0}}), InputError);
}

// A neighbour follows where there is one: that is what packs well.
TEST(DisplayMesh, MostFacesShareAnEdgeWithTheOneBefore) {
    const DisplayMesh shown = display_mesh(bumpy_torus(45), display_grid(bounds(bumpy_torus(45))));
    std::size_t neighbours = 0;
    for (std::size_t t = 1; t < shown.triangles.size(); ++t) {
        std::size_t common = 0;
        for (const std::uint32_t corner : shown.triangles[t]) {
            const Triangle& before = shown.triangles[t - 1];
            common += static_cast<std::size_t>(std::count(before.begin(), before.end(), corner));
        }
        neighbours += common >= 2 ? 1 : 0;
    }
    EXPECT_GT(neighbours, shown.triangles.size() * 9 / 10);
}

TEST(DisplayMesh, WhatIsNotValidIsSeen) {
    const TriangleMesh box = parts_of(shapes::box({0, 0, 0}, {8, 8, 8}))[0];
    const DisplayMesh good = display_mesh(box, display_grid(bounds(box)));
    ASSERT_TRUE(is_valid(good));
    ASSERT_GE(good.groups.size(), 2U);
    const auto with = [&](const auto& change) {
        DisplayMesh mesh = good;
        change(mesh);
        return is_valid(mesh);
    };
    EXPECT_FALSE(with([](DisplayMesh& m) { m.grid.step = 0; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.grid.step = NAN; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.grid.origin.y = INFINITY; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.grid.step = 1e305; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.points[0][2] = 1U << 14; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.points.push_back({1, 2, 3}); })) << "a point of no face";
    EXPECT_FALSE(with([](DisplayMesh& m) { m.triangles[0] = {1, 0, 2}; })) << "not in the order of use";
    EXPECT_FALSE(with([](DisplayMesh& m) { m.triangles.back()[1] = m.triangles.back()[0]; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.groups.pop_back(); }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.groups[0].cut = 4; })) << "the skin is of no cut";
    EXPECT_FALSE(with([](DisplayMesh& m) { m.groups[1].cut = -2; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { std::swap(m.groups[0], m.groups[1]); }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.groups[1].first += 1; }));
    EXPECT_FALSE(with([](DisplayMesh& m) { m.groups.back().faces += 1; }));
}

}  // namespace
}  // namespace qchopper
