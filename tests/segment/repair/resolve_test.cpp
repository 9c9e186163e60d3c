#include "segment/repair/resolve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/measure.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/segment/repair/nasty_meshes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::size_t pairs_in(const TriangleMesh& mesh) {
    const SelfIntersections found = self_intersections(mesh);
    return found.pairs.size() + found.without_area.size();
}

std::array<Vec3, 3> places(const TriangleMesh& mesh, const Triangle& t) {
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

// Holds for every mesh.
Resolved expect_invariants(TriangleMesh& mesh, const std::string& name) {
    const TriangleMesh before = mesh;
    const Resolved result = resolve_self_intersections(mesh);
    EXPECT_EQ(result.pairs, pairs_in(before)) << name;
    EXPECT_EQ(result.left, pairs_in(mesh)) << name;
    EXPECT_LE(result.left, result.pairs) << name;
    EXPECT_EQ(mesh.triangles.size() + result.removed, before.triangles.size() + result.added) << name;
    EXPECT_EQ(mesh.points.size() + result.dropped, before.points.size()) << name;
    EXPECT_TRUE(result.places > 0 || mesh == before) << name;
    EXPECT_TRUE(edges(mesh).faults.is_closed() || !edges(before).faults.is_closed()) << name;
    EXPECT_EQ(result.where_left.empty(), result.left == 0) << name;
    // Points and triangles that stay are in their old order, bit by bit; new triangles come last.
    std::size_t at = 0;
    for (const Vec3& p : mesh.points) {
        while (at < before.points.size() && before.points[at] != p) ++at;
        EXPECT_LT(at++, before.points.size()) << name;
    }
    at = 0;
    std::size_t kept = 0;
    for (const Triangle& t : mesh.triangles) {
        std::size_t to = at;
        while (to < before.triangles.size() && places(before, before.triangles[to]) != places(mesh, t)) ++to;
        if (to == before.triangles.size()) break;
        at = to + 1;
        ++kept;
    }
    EXPECT_GE(kept + result.added, mesh.triangles.size()) << name;
    return result;
}

// One point pushed through the far wall of a thin plate.
TriangleMesh pierced() {
    TriangleMesh plate = shapes::box({0, 0, 0}, {40, 40, 1}, 40);
    for (Vec3& p : plate.points) {
        if (p == Vec3{20, 20, 1}) p.z = -2;
    }
    return plate;
}

TEST(Resolve, LeavesSoundMeshesAsTheyAre) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        EXPECT_EQ(expect_invariants(mesh, shape.name).pairs, 0U);
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Resolve, RepairsAPlaceThatIsPiercedAndNothingElse) {
    TriangleMesh mesh = pierced();
    const TriangleMesh before = mesh;
    const Resolved result = expect_invariants(mesh, "pierced plate");
    EXPECT_GT(result.pairs, 0U);
    EXPECT_EQ(result.left, 0U);
    EXPECT_GE(result.places, 1U);
    EXPECT_LT(result.removed, 200U);
    EXPECT_NEAR(volume_mm3(mesh), 1600, 5);
    TriangleMesh again = mesh;
    EXPECT_EQ(resolve_self_intersections(again).places, 0U);
    EXPECT_EQ(again, mesh);
}

TEST(Resolve, RepairsCrumpledSurfacesOrLeavesThemAsTheyWere) {
    std::size_t before = 0;
    std::size_t after = 0;
    for (unsigned seed = 0; seed < 10; ++seed) {
        std::mt19937 random(seed);
        TriangleMesh mesh = shapes::ball({0, 0, 0}, 5, 32);
        std::uniform_real_distribution<double> shift(-0.6, 0.6);
        for (int i = 0; i < 12; ++i) {
            Vec3& p = mesh.points[random() % mesh.points.size()];
            p = p + Vec3{shift(random), shift(random), shift(random)};
        }
        const Resolved result = expect_invariants(mesh, "crumpled " + std::to_string(seed));
        before += result.pairs;
        after += result.left;
    }
    EXPECT_GT(before, 30U);
    EXPECT_LT(after, before / 10);
}

TEST(Resolve, LeavesWhatIsNoSmallPlace) {
    TriangleMesh crossed =
        shapes::joined({shapes::box({0, 0, 0}, {10, 4, 4}, 4), shapes::box({3, -3, 1}, {7, 7, 3}, 4)});
    const TriangleMesh before = crossed;
    const Resolved result = expect_invariants(crossed, "crossed bars");
    EXPECT_GT(result.left, 0U);
    EXPECT_EQ(crossed, before);
}

TEST(Resolve, StaysAwayFromOpenBorders) {
    TriangleMesh mesh = pierced();
    mesh.triangles.erase(mesh.triangles.begin());
    const std::size_t open = edges(mesh).faults.open;
    EXPECT_EQ(expect_invariants(mesh, "open plate").left, 0U);
    EXPECT_EQ(edges(mesh).faults.open, open);
}

TEST(Resolve, RepairsTheDragon) {
    NEEDS_MESH("dragon_vrip_871k.ply");
    TriangleMesh mesh = read_mesh(real_mesh("dragon_vrip_871k.ply")).mesh;
    weld(mesh);
    split_non_manifold_vertices(mesh, edges(mesh));
    const TriangleMesh before = mesh;
    const Resolved result = resolve_self_intersections(mesh);
    EXPECT_GT(result.pairs, 100U);
    EXPECT_EQ(result.left, 0U);
    EXPECT_EQ(pairs_in(mesh), 0U);
    EXPECT_LT(result.removed, 3000U);
    EXPECT_EQ(edges(mesh).faults.is_closed(), edges(before).faults.is_closed());
}

TEST(Resolve, KeepsItsInvariantsOnWhatOthersFoundNasty) {
    NEEDS_MESH("nasty");
    std::size_t resolved = 0;
    for_each_nasty_mesh(20'000, [&](TriangleMesh mesh, const std::string& name) {
        const Edges found = edges(mesh);
        if (found.faults.non_manifold + found.faults.inconsistent == 0) split_non_manifold_vertices(mesh, found);
        expect_invariants(mesh, name);
        ++resolved;
    });
    EXPECT_GT(resolved, 10U);
}

}  // namespace
}  // namespace qchopper
