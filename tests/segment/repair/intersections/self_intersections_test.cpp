#include "segment/repair/intersections/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>

#include "base/parallel.h"
#include "segment/io/read_mesh.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/segment/repair/nasty_meshes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using Pairs = std::vector<std::array<std::uint32_t, 2>>;

// The pairs of CGAL; nothing for a mesh that its half-edges cannot hold. A triangle without area is a pair with itself.
std::optional<Pairs> by_cgal(const TriangleMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
    Mesh surface;
    for (const Vec3& p : mesh.points) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        const auto face =
            surface.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
        if (face == Mesh::null_face()) return std::nullopt;
    }
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(found));
    Pairs pairs;
    for (const auto& [a, b] : found) {
        const auto one = static_cast<std::uint32_t>(a);
        const auto other = static_cast<std::uint32_t>(b);
        pairs.push_back({std::min(one, other), std::max(one, other)});
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

Pairs by_us(const TriangleMesh& mesh) {
    const SelfIntersections found = self_intersections(mesh);
    EXPECT_TRUE(found.is_complete);
    Pairs pairs = found.pairs;
    for (const std::uint32_t t : found.without_area) pairs.push_back({t, t});
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

void expect_as_cgal(const TriangleMesh& mesh, const std::string& name) {
    const std::optional<Pairs> expected = by_cgal(mesh);
    ASSERT_TRUE(expected) << name;
    EXPECT_EQ(by_us(mesh), *expected) << name;
}

// Every triangle at a random place: they intersect everywhere.
TriangleMesh soup(std::size_t triangles, double size, unsigned seed, bool on_grid) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 1);
    std::uniform_int_distribution<int> step(0, 6);
    TriangleMesh mesh;
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const Vec3 at{place(random), place(random), place(random)};
        for (int k = 0; k < 3; ++k) {
            const auto grid = [&] { return static_cast<double>(step(random)); };
            const Vec3 free = at + size * Vec3{place(random), place(random), place(random)};
            mesh.points.push_back(on_grid ? Vec3{grid(), grid(), grid()} : free);
        }
        mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    return mesh;
}

TEST(SelfIntersections, AreNoneInClosedShapes) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        EXPECT_TRUE(self_intersections(shape.mesh).is_free()) << shape.name;
        expect_as_cgal(shape.mesh, shape.name);
    }
}

TEST(SelfIntersections, AreThoseOfCgalInShapesThatOverlap) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5, 12);
    const TriangleMesh box = shapes::box({0, 0, 0}, {4, 4, 4}, 3);
    for (const Vec3 by : {Vec3{1, 0, 0}, Vec3{4, 0, 0}, Vec3{3, 2.5, 0.125}, Vec3{4, 4, 4}, Vec3{10, 0, 0}}) {
        // Faces that lie in one plane, edges that lie on faces, points on points.
        const TriangleMesh boxes =
            shapes::joined({box, shapes::moved(shapes::box({0, 0, 0}, {4, 4, 3}, 2), by + Vec3{0.5, 0, 0})});
        expect_as_cgal(boxes, "boxes");
        EXPECT_FALSE(by.x < 4 && self_intersections(boxes).is_free());
        expect_as_cgal(shapes::joined({ball, shapes::moved(ball, by)}), "balls");
    }
}

TEST(SelfIntersections, AreThoseOfCgalInSoups) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        expect_as_cgal(soup(400, 0.3, seed, false), "soup " + std::to_string(seed));
        const TriangleMesh small = soup(400, 1e-4, seed, false);
        expect_as_cgal(small, "fine soup " + std::to_string(seed));
    }
}

// On a grid nearly everything is degenerate: in one plane, on one line, touching in a point. Equal points of different
// numbers are shared here, not for CGAL, so points are made different from those of all other triangles first.
TEST(SelfIntersections, AreThoseOfCgalOnAGrid) {
    std::size_t pairs = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        TriangleMesh mesh = soup(60, 0, seed, true);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const bool is_shared = std::any_of(mesh.points.begin(), mesh.points.begin() + 3 * t, [&](const Vec3& p) {
                return p == mesh.points[3 * t] || p == mesh.points[3 * t + 1] || p == mesh.points[3 * t + 2];
            });
            if (!is_shared) continue;
            for (std::uint32_t k = 0; k < 3; ++k) mesh.points[3 * t + k].x += 10.0 * (t + 1);  // out of the way
        }
        expect_as_cgal(mesh, "grid " + std::to_string(seed));
        pairs += by_us(mesh).size();
    }
    EXPECT_GT(pairs, 100U);
}

TEST(SelfIntersections, AreThoseOfCgalWhenAMeshIsCrumpled) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        std::mt19937 random(seed);
        TriangleMesh mesh = shapes::ball({0, 0, 0}, 5, 24);
        std::uniform_real_distribution<double> shift(-0.6, 0.6);
        for (Vec3& p : mesh.points) p = p + Vec3{shift(random), shift(random), shift(random)};
        expect_as_cgal(mesh, "crumpled " + std::to_string(seed));
        EXPECT_FALSE(self_intersections(mesh).is_free());
        for (Vec3& p : mesh.points) p = {std::round(2 * p.x), std::round(2 * p.y), std::round(2 * p.z)};
        weld(mesh);
        if (by_cgal(mesh)) expect_as_cgal(mesh, "crumpled on a grid " + std::to_string(seed));
    }
}

TEST(SelfIntersections, DoNotCountWhatOnlyTouches) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1});
    EXPECT_TRUE(self_intersections(shapes::joined({box, shapes::moved(box, {1, 1, 1})})).is_free());   // in a point
    EXPECT_TRUE(self_intersections(shapes::joined({box, shapes::moved(box, {1, 1, 0})})).is_free());   // along an edge
    EXPECT_FALSE(self_intersections(shapes::joined({box, shapes::moved(box, {1, 0, 0})})).is_free());  // in a face
}

TEST(SelfIntersections, CountFoldsDoublesAndLines) {
    TriangleMesh fold;
    fold.points = {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 1, 0}, {2, -1, 0}, {2, 1, 1}};
    fold.triangles = {{0, 1, 2}, {1, 0, 3}};
    EXPECT_EQ(self_intersections(fold).pairs, (Pairs{{0, 1}}));
    fold.triangles = {{0, 1, 2}, {1, 0, 4}};
    EXPECT_TRUE(self_intersections(fold).is_free());
    fold.triangles = {{0, 1, 2}, {1, 0, 5}};
    EXPECT_TRUE(self_intersections(fold).is_free());
    fold.triangles = {{0, 1, 2}, {2, 0, 1}, {0, 2, 1}};
    EXPECT_EQ(self_intersections(fold).pairs, (Pairs{{0, 1}, {0, 2}, {1, 2}}));
    fold.points.push_back({1, 0, 0});
    fold.triangles = {{0, 1, 6}, {0, 1, 2}};
    EXPECT_EQ(self_intersections(fold).without_area, (std::vector<std::uint32_t>{0}));
    EXPECT_TRUE(self_intersections(fold).pairs.empty());
}

TEST(SelfIntersections, AreTheSameOnAnyNumberOfThreadsAlsoAtALimit) {
    const TriangleMesh mesh = soup(3000, 0.3, 7, false);
    SelfIntersectionOptions few;
    few.max_pairs = 500;
    SelfIntersections all[2];
    SelfIntersections some[2];
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        all[threads - 1] = self_intersections(mesh);
        some[threads - 1] = self_intersections(mesh, few);
    }
    EXPECT_EQ(all[0].pairs, all[1].pairs);
    EXPECT_EQ(some[0].pairs, some[1].pairs);
    EXPECT_FALSE(some[0].is_complete);
    EXPECT_GE(some[0].pairs.size(), 500U / 16);  // one subtree may take its share
    EXPECT_LT(some[0].pairs.size(), all[0].pairs.size());
}

TEST(SelfIntersections, EndInTimeWhereAllMeetAll) {
    TriangleMesh heap;
    heap.points = {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}};
    heap.triangles.assign(200'000, {0, 1, 2});
    EXPECT_FALSE(self_intersections(heap).is_complete);
}

TEST(SelfIntersections, DoNotDependOnWhereTheMeshLies) {
    TriangleMesh mesh = shapes::joined({shapes::box({0, 0, 0}, {4, 4, 4}, 4), shapes::box({1, 1, 1}, {6, 3, 3}, 3)});
    const Pairs here = by_us(mesh);
    EXPECT_FALSE(here.empty());
    EXPECT_EQ(by_us(shapes::moved(mesh, {5e6, -5e6, 5e6})), here);
    for (Vec3& p : mesh.points) p = std::ldexp(1.0, -60) * p;
    EXPECT_EQ(by_us(mesh), here);
}

TEST(SelfIntersections, AreFoundWhereTheyAre) {
    const TriangleMesh mesh = shapes::joined({shapes::box({0, 0, 0}, {4, 4, 4}), shapes::box({3, 1, 1}, {6, 3, 3})});
    for (const auto& pair : self_intersections(mesh).pairs) {
        const Vec3 at = meeting_place(mesh, pair);
        EXPECT_TRUE(at.x >= 3 && at.x <= 4 && at.y >= 0 && at.y <= 4) << at.x << " " << at.y;
    }
}

TEST(SelfIntersections, AreThoseOfCgalInTheDragon) {
    NEEDS_MESH("dragon_vrip_871k.ply");
    TriangleMesh mesh = read_mesh(real_mesh("dragon_vrip_871k.ply")).mesh;
    weld(mesh);
    const std::optional<Pairs> expected = by_cgal(mesh);
    ASSERT_TRUE(expected);
    EXPECT_GT(expected->size(), 100U);
    EXPECT_EQ(by_us(mesh), *expected);
}

TEST(SelfIntersections, AreThoseOfCgalInWhatOthersFoundNasty) {
    NEEDS_MESH("nasty");
    std::size_t compared = 0;
    for_each_nasty_mesh(30'000, [&](const TriangleMesh& mesh, const std::string& name) {
        if (!by_cgal(mesh)) return;
        expect_as_cgal(mesh, name);
        ++compared;
    });
    EXPECT_GT(compared, 10U);
}

}  // namespace
}  // namespace qchopper
