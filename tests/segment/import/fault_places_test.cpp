#include "segment/import/fault_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "segment/import/inspect.h"
#include "tests/segment/repair/soup.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Inspection inspected(const TriangleMesh& mesh) {
    RawMesh scan;
    scan.mesh = mesh;
    scan.faces_in_file = mesh.triangles.size();
    InspectOptions deep;
    deep.deep = true;
    return inspect(scan, deep);
}

std::vector<Vec3> places_of(const Inspection& found, const std::string& kind) {
    for (const FaultPlaces& places : found.places) {
        if (places.kind == kind) return places.points;
    }
    return {};
}

bool is_before(Vec3 a, Vec3 b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

using Points = std::vector<Vec3>;

Points sorted(Points points) {
    std::ranges::sort(points, is_before);
    return points;
}

// The count of each kind that has places.
std::map<std::string, std::size_t> counts(const Inspection& i) {
    return {{"collapsed_faces", i.collapsed},       {"open_edges", i.open_edges},
            {"non_manifold_edges", i.non_manifold}, {"touching_edges", i.touching},
            {"inconsistent_edges", i.inconsistent}, {"non_manifold_vertices", i.non_manifold_vertices},
            {"repeated_faces", i.repeated},         {"holes", i.holes.size()},
            {"faces_without_area", i.degenerate},   {"cavities", i.cavities},
            {"inside_out", i.inside_out},           {"fragments", i.fragments},
            {"open_components", i.open_components}};
}

void expect_places_of_all_kinds(const Inspection& found, const std::string& what) {
    std::size_t kinds = 0;
    for (const auto& [kind, count] : counts(found)) {
        EXPECT_EQ(places_of(found, kind).size(), std::min<std::size_t>(count, 100)) << what << ": " << kind;
        kinds += count > 0 ? 1 : 0;
    }
    const bool crosses = found.self_intersected->pairs > 0;
    EXPECT_EQ(places_of(found, "self_intersections").empty(), !crosses) << what;
    EXPECT_LE(places_of(found, "self_intersections").size(), 100U) << what;
    EXPECT_EQ(found.places.size(), kinds + (crosses ? 1 : 0)) << what;
}

TEST(FaultPlaces, AreAsManyAsFaultsOfEachKindAndAtMostAHundred) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Inspection found = inspected(shape.mesh);
        expect_places_of_all_kinds(found, shape.name);
        EXPECT_TRUE(places_of(found, "open_edges").empty()) << shape.name;
    }
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        const TriangleMesh mesh = balanced_soup({seed % 2 == 0, seed});
        expect_places_of_all_kinds(inspected(mesh), "soup " + std::to_string(seed));
    }
}

TEST(FaultPlaces, OfOpenEdgesAndHoles) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2});
    // The last triangle is half of a side: two edges of 2 and a diagonal.
    const Triangle gone = mesh.triangles.back();
    mesh.triangles.pop_back();
    const Inspection found = inspected(mesh);
    Points middles;
    for (int k = 0; k < 3; ++k) {
        middles.push_back(0.5 * (mesh.points[gone[k]] + mesh.points[gone[(k + 1) % 3]]));
    }
    EXPECT_EQ(sorted(places_of(found, "open_edges")), sorted(middles));
    EXPECT_EQ(places_of(found, "holes"), Points{found.holes.at(0).centre});
}

TEST(FaultPlaces, OfEdgesAndPointsWhereSolidsTouch) {
    const Inspection edge =
        inspected(shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 0}, {2, 2, 1})}));
    EXPECT_EQ(places_of(edge, "touching_edges"), (Points{{1, 1, 0.5}}));
    EXPECT_EQ(places_of(edge, "non_manifold_edges"), (Points{{1, 1, 0.5}}));
    const Inspection point =
        inspected(shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 1}, {2, 2, 2})}));
    EXPECT_EQ(places_of(point, "non_manifold_vertices"), (Points{{1, 1, 1}}));
}

TEST(FaultPlaces, OfFacesThatAreTurnedRepeatedCollapsedOrFlat) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    const Triangle first = box.triangles[0];
    const auto corner = [&](int k) { return box.points[first[k]]; };
    const Vec3 centroid = (1.0 / 3) * (corner(0) + corner(1) + corner(2));
    const Points middles{0.5 * (corner(0) + corner(1)), 0.5 * (corner(1) + corner(2)), 0.5 * (corner(2) + corner(0))};

    TriangleMesh turned = box;
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_EQ(sorted(places_of(inspected(turned), "inconsistent_edges")), sorted(middles));

    TriangleMesh twice = box;
    twice.triangles.push_back({first[1], first[0], first[2]});
    EXPECT_EQ(places_of(inspected(twice), "repeated_faces"), Points{centroid});

    TriangleMesh collapsed = box;
    collapsed.points.push_back({7, 0, 3});
    collapsed.points.push_back({7, 0, 3});  // equal, but another point of the file
    collapsed.points.push_back({10, 3, 0});
    const auto last = static_cast<std::uint32_t>(collapsed.points.size());
    collapsed.triangles.push_back({last - 3, last - 2, last - 1});
    EXPECT_EQ(places_of(inspected(collapsed), "collapsed_faces"), (Points{{8, 1, 2}}));

    TriangleMesh flat = shapes::joined({box});
    flat.points.push_back({30, 0, 0});
    flat.points.push_back({31, 0, 0});
    flat.points.push_back({35, 0, 0});
    flat.triangles.push_back({last - 3, last - 2, last - 1});
    EXPECT_EQ(places_of(inspected(flat), "faces_without_area"), (Points{{32, 0, 0}}));
}

TEST(FaultPlaces, OfShellsAreTheCentresOfTheirBoxes) {
    const TriangleMesh cavity = shapes::turned_inside_out(shapes::box({40, 40, 40}, {60, 70, 60}));
    const TriangleMesh inside_out = shapes::turned_inside_out(shapes::box({200, 0, 0}, {240, 40, 60}));
    const TriangleMesh fragment = shapes::box({300, 0, 0}, {301, 1, 2});
    TriangleMesh sheet;
    sheet.points = {{400, 0, 0}, {410, 0, 0}, {410, 10, 0}, {400, 10, 2}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    const Inspection found =
        inspected(shapes::joined({shapes::box({0, 0, 0}, {100, 100, 100}), cavity, inside_out, fragment, sheet}));
    EXPECT_EQ(places_of(found, "cavities"), (Points{{50, 55, 50}}));
    EXPECT_EQ(places_of(found, "inside_out"), (Points{{220, 20, 30}}));
    EXPECT_EQ(places_of(found, "fragments"), (Points{{300.5, 0.5, 1}}));
    EXPECT_EQ(places_of(found, "open_components"), (Points{{405, 5, 1}}));
}

TEST(FaultPlaces, OfSelfIntersectionsLieWhereSurfacesMeet) {
    const Inspection found = inspected(
        shapes::joined({shapes::box({0, 0, 0}, {40, 40, 40}, 8), shapes::box({30, 10, 10}, {60, 30, 30}, 8)}));
    const Points places = places_of(found, "self_intersections");
    EXPECT_GT(places.size(), 10U);
    EXPECT_EQ(found.self_intersected->places, Points(places.begin(), places.begin() + 10));
    for (const Vec3 at : places) {  // the small box comes through the side x = 40
        EXPECT_NEAR(at.x, 40, 1e-9);
        EXPECT_NEAR(std::max(std::abs(at.y - 20), std::abs(at.z - 20)), 10, 5.0 / 8 + 1e-9);
    }
}

TEST(FaultPlaces, OfManyFaultsAreSpreadOverAllOfThem) {
    TriangleMesh comb;
    for (int i = 0; i < 1000; ++i) {
        const auto first = static_cast<std::uint32_t>(comb.points.size());
        const double x = i;
        comb.points.insert(comb.points.end(), {{x, 0, 0}, {x, 0, 0}, {x, 3, 0}});
        comb.triangles.push_back({first, first + 1, first + 2});
    }
    const Points places =
        places_of(inspected(shapes::joined({shapes::box({0, 0, 5}, {9, 9, 9}), comb})), "collapsed_faces");
    ASSERT_EQ(places.size(), 100U);
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i], (Vec3{10.0 * static_cast<double>(i), 1, 0}));
}

}  // namespace
}  // namespace qchopper
