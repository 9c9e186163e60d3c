#include "segment/mesh/connectivity/links.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "segment/mesh/connectivity/manifold.h"
#include "segment/repair/weld.h"
#include "tests/reference/segment/mesh/non_manifold_vertices.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

void expect_equals_reference(const TriangleMesh& mesh, const std::string& name) {
    const Edges found = edges(mesh);
    const Unpaired expected = unpaired(mesh, found);
    const Links links = qchopper::links(mesh);
    EXPECT_EQ(links.faults, found.faults) << name;
    EXPECT_EQ(links.open, expected.open) << name;
    EXPECT_EQ(links.non_manifold, expected.non_manifold) << name;
    EXPECT_EQ(links.extra_fans.size(), count_non_manifold_vertices(mesh, found)) << name;
    if (found.faults.non_manifold + found.faults.inconsistent > 0) return;
    TriangleMesh split = mesh;
    split_fans(split, links.extra_fans);
    TriangleMesh reference = mesh;
    split_non_manifold_vertices(reference, found);
    EXPECT_EQ(count_non_manifold_vertices(split, edges(split)), 0U) << name;
    EXPECT_EQ(edges(split).faults.open, found.faults.open) << name;
    // The same copies, perhaps in another order.
    ASSERT_EQ(split.points.size(), reference.points.size()) << name;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_EQ(split.points[split.triangles[t][k]], reference.points[reference.triangles[t][k]]);
            EXPECT_EQ(split.triangles[t][k] < mesh.points.size(), reference.triangles[t][k] < mesh.points.size())
                << name;
        }
    }
}

TEST(Links, EqualEdgesAndNonManifoldVertices) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        expect_equals_reference(shape.mesh, shape.name);
        for (unsigned seed = 0; seed < 12; ++seed) {
            std::mt19937 random(seed);
            TriangleMesh torn = shape.mesh;
            const auto any = [&] { return random() % torn.triangles.size(); };
            for (int i = 0; i < 8 && torn.triangles.size() > 8; ++i) {
                torn.triangles.erase(torn.triangles.begin() + static_cast<std::ptrdiff_t>(any()));
            }
            expect_equals_reference(torn, shape.name + " torn");
            for (int i = 0; i < 4; ++i) {
                Triangle& t = torn.triangles[any()];
                std::swap(t[0], t[1]);
                torn.triangles.push_back(torn.triangles[any()]);
                const std::size_t p = random() % torn.points.size();
                torn.points[p] = torn.points[random() % torn.points.size()];
            }
            weld(torn);
            expect_equals_reference(torn, shape.name + " in disorder");
        }
    }
}

TEST(Links, HandlePointsWithVeryManyTriangles) {
    TriangleMesh poles = shapes::ball({0, 0, 0}, 5, 100);
    expect_equals_reference(poles, "poles");
    poles.triangles.erase(poles.triangles.begin());
    expect_equals_reference(poles, "open pole");
    std::vector<TriangleMesh> many;
    for (int i = 0; i < 40; ++i)
        many.push_back(shapes::rotated(shapes::pyramid({-0.1, -0.1, -5}, 0.2, 5), {1, 0, 0}, 0.1 * i));
    TriangleMesh star = shapes::joined(many);
    for (Vec3& p : star.points) {
        if (norm(p) < 1e-9) p = {};
    }
    weld(star);
    expect_equals_reference(star, "star");
    EXPECT_EQ(links(star).extra_fans.size(), 39U);
}

TEST(Links, CountRepeatedTriangles) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    EXPECT_EQ(links(mesh).repeated, 0U);
    mesh.triangles.push_back(mesh.triangles[3]);
    mesh.triangles.push_back({mesh.triangles[3][1], mesh.triangles[3][0], mesh.triangles[3][2]});
    mesh.triangles.push_back(mesh.triangles[9]);
    EXPECT_EQ(links(mesh).repeated, 3U);
    TriangleMesh pillow;
    pillow.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    pillow.triangles = {{0, 1, 2}, {0, 2, 1}};
    EXPECT_EQ(links(pillow).repeated, 1U);
    EXPECT_TRUE(links(pillow).faults.is_closed());
    EXPECT_EQ(links({}).repeated, 0U);
}

}  // namespace
}  // namespace qchopper
