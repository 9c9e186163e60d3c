#include "segment/import/inspect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <random>

#include "segment/import/import_scan.h"
#include "segment/io/write_mesh.h"
#include "segment/repair/repair.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/segment/repair/soup.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

RawMesh raw(const TriangleMesh& mesh) {
    RawMesh scan;
    scan.mesh = mesh;
    scan.faces_in_file = mesh.triangles.size();
    return scan;
}

TEST(Inspect, FindsNothingWrongWithClosedShapes) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (const RawMesh& scan : {raw(shape.mesh), parse_mesh(to_stl(shape.mesh), shape.name)}) {
            const Inspection found = inspect(scan);
            EXPECT_TRUE(found.is_closed()) << shape.name;
            EXPECT_EQ(found.triangles, shape.mesh.triangles.size()) << shape.name;
            EXPECT_EQ(found.vertices, shape.mesh.points.size()) << shape.name;
            EXPECT_EQ(found.inside_out, 0U) << shape.name;
            EXPECT_EQ(found.holes.size(), 0U) << shape.name;
            EXPECT_NEAR(found.volume / volume_mm3(shape.mesh), 1, 1e-3) << shape.name;
            EXPECT_NEAR(found.area / area_mm2(shape.mesh), 1, 1e-3) << shape.name;
        }
    }
}

TEST(Inspect, CountsEveryFault) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    mesh.triangles.pop_back();
    EXPECT_EQ(inspect(raw(mesh)).open_edges, 3U);
    ASSERT_EQ(inspect(raw(mesh)).holes.size(), 1U);
    EXPECT_EQ(inspect(raw(mesh)).holes[0].edges, 3U);

    mesh.points.push_back({50, 50, 50});
    mesh.triangles.push_back({0, 0, 1});
    const Inspection found = inspect(raw(mesh));
    EXPECT_EQ(found.unreferenced, 1U);
    EXPECT_EQ(found.collapsed, 1U);
    EXPECT_EQ(found.box, (Box{{0, 0, 0}, {2, 2, 2}}));
    EXPECT_EQ(found.triangles_in_file, 48U);
    EXPECT_EQ(found.triangles, 47U);

    TriangleMesh turned = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    std::swap(turned.triangles[0][0], turned.triangles[0][1]);
    EXPECT_EQ(inspect(raw(turned)).inconsistent, 3U);
    EXPECT_EQ(inspect(raw(turned)).shells, 1U);

    TriangleMesh twice = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    twice.triangles.push_back(twice.triangles[0]);
    EXPECT_EQ(inspect(raw(twice)).non_manifold, 3U);

    EXPECT_EQ(inspect(raw(shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 1}, {2, 2, 2})})))
                  .non_manifold_vertices,
              1U);

    TriangleMesh flat;
    flat.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    flat.triangles = {{0, 1, 2}};
    EXPECT_EQ(inspect(raw(flat)).degenerate, 1U);
}

TEST(Inspect, CallsSolidsThatOnlyTouchReady) {
    const TriangleMesh at_an_edge =
        shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 0}, {2, 2, 1})});
    const Inspection found = inspect(raw(at_an_edge));
    EXPECT_EQ(found.non_manifold, 1U);
    EXPECT_EQ(found.touching, 1U);
    EXPECT_EQ(judge(found).verdict, Verdict::ready);
    EXPECT_EQ(judge(found).reasons.size(), 1U);  // that the edge is split

    TriangleMesh with_fin = shapes::box({0, 0, 0}, {1, 1, 1});
    const Triangle first = with_fin.triangles[0];
    const Vec3 middle = 0.5 * (with_fin.points[first[0]] + with_fin.points[first[1]]);
    with_fin.points.push_back(middle + Vec3{-0.03, -0.02, -0.04});
    with_fin.triangles.push_back({first[0], first[1], static_cast<std::uint32_t>(with_fin.points.size() - 1)});
    EXPECT_EQ(inspect(raw(with_fin)).touching, 0U);
    EXPECT_EQ(judge(inspect(raw(with_fin))).verdict, Verdict::to_repair);
    with_fin.points.back() = {2, 2, 0.5};
    EXPECT_EQ(judge(inspect(raw(with_fin))).verdict, Verdict::unrepairable) << "too large to be dropped";
}

TEST(Inspect, DistinguishesCavitiesFromShellsThatAreInsideOut) {
    const TriangleMesh ball = shapes::turned_inside_out(shapes::ball({5, 5, 5}, 2));
    EXPECT_EQ(inspect(raw(ball)).inside_out, 1U);
    const Inspection hollow = inspect(raw(shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}), ball})));
    EXPECT_EQ(hollow.inside_out, 0U);
    EXPECT_EQ(hollow.cavities, 1U);
    EXPECT_EQ(hollow.shells, 2U);
}

TEST(Inspect, FindsTheLongestHoleAndItsCentre) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {8, 8, 8}, 8);
    EXPECT_EQ(inspect(raw(mesh)).longest_hole(), nullptr);
    const auto lies_in = [&](const Triangle& t, double low, double high) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
            const Vec3 p = mesh.points[v];
            return p.z == 8 && p.x >= low && p.x <= high && p.y >= low && p.y <= high;
        });
    };
    std::erase_if(mesh.triangles, [&](const Triangle& t) { return lies_in(t, 1, 2) || lies_in(t, 4, 6); });
    const Inspection found = inspect(raw(mesh));
    EXPECT_EQ(found.holes.size(), 2U);
    ASSERT_NE(found.longest_hole(), nullptr);
    EXPECT_EQ(found.longest_hole()->edges, 8U);
    EXPECT_DOUBLE_EQ(found.longest_hole()->length, 8);
    EXPECT_EQ(found.longest_hole()->centre, (Vec3{5, 5, 8}));
    EXPECT_EQ(found.open_components, 0U);
}

TEST(Inspect, CountsFragmentsWithTheirCavities) {
    const TriangleMesh large = shapes::box({0, 0, 0}, {100, 100, 100});
    const TriangleMesh fragment = shapes::box({200, 0, 0}, {202, 2, 2});
    const TriangleMesh piece = shapes::box({300, 0, 0}, {303, 3, 3});
    const TriangleMesh thin = shapes::joined(  // 27 mm3 in all, but only 7 of them are solid
        {shapes::box({400, 0, 0}, {403, 3, 3}),
         shapes::turned_inside_out(shapes::box({400.15, 0.15, 0.15}, {402.85, 2.85, 2.85}))});
    const Inspection found = inspect(raw(shapes::joined({large, fragment, piece, thin})));
    EXPECT_EQ(found.fragments, 2U);
    const double area = 24 + 54 + 6 * 2.7 * 2.7;
    EXPECT_NEAR(found.fragment_area_share, (area - 0) / (60'000 + 24 + 54 + 54 + 6 * 2.7 * 2.7), 1e-12);
    EXPECT_EQ(judge(found).verdict, Verdict::ready);
    ASSERT_EQ(found.solids.size(), 4U);
    EXPECT_EQ(found.solid_count, 4U);
    EXPECT_NEAR(found.solids[0].volume, 1e6, 1e-6);
    EXPECT_NEAR(found.solids[1].volume, 27, 1e-9);
    EXPECT_NEAR(found.solids[2].volume, 8, 1e-9);
    EXPECT_NEAR(found.solids[3].volume, 27 - 2.7 * 2.7 * 2.7, 1e-9) << "without its cavity";
    EXPECT_EQ(found.solids[0].centre, (Vec3{50, 50, 50}));
    EXPECT_EQ(found.solids[0].faces, 12U);
}

TEST(Inspect, ListsTheLargestHundredSolidsAndCountsAll) {
    std::vector<TriangleMesh> boxes;
    for (int i = 0; i < 103; ++i) {
        const double side = 1 + 0.1 * ((i * 37) % 103);
        boxes.push_back(shapes::box({20.0 * i, 0, 0}, {20.0 * i + side, side, side}));
    }
    const Inspection found = inspect(raw(shapes::joined(boxes)));
    EXPECT_EQ(found.solid_count, 103U);
    ASSERT_EQ(found.solids.size(), 100U);
    for (std::size_t i = 0; i < 100; ++i) {
        const double side = 1 + 0.1 * static_cast<double>(102 - i);
        EXPECT_NEAR(found.solids[i].volume, side * side * side, 1e-6);
    }
    EXPECT_EQ(inspect(raw(shapes::joined({}))).solid_count, 0U);
}

TEST(Inspect, DeepFindsSelfIntersections) {
    const TriangleMesh crossed = shapes::joined({shapes::box({0, 0, 0}, {4, 4, 4}), shapes::box({3, 1, 1}, {6, 3, 3})});
    EXPECT_FALSE(inspect(raw(crossed)).self_intersected);
    InspectOptions deep;
    deep.deep = true;
    const Inspection found = inspect(raw(crossed), deep);
    ASSERT_TRUE(found.self_intersected);
    EXPECT_GT(found.self_intersected->pairs, 0U);
    EXPECT_FALSE(found.self_intersected->places.empty());
    EXPECT_LE(found.self_intersected->places.size(), 10U);
    EXPECT_EQ(judge(found).verdict, Verdict::to_repair);
    // Surfaces that touch in a point are no fault of that kind.
    const TriangleMesh touching =
        shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({1, 1, 1}, {2, 2, 2})});
    EXPECT_EQ(inspect(raw(touching), deep).self_intersected->pairs, 0U);
}

TEST(Inspect, JudgesByTheCounts) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const Judgement judged = judge(inspect(raw(shape.mesh)));
        EXPECT_EQ(judged.verdict, Verdict::ready) << shape.name;
        EXPECT_TRUE(judged.reasons.empty()) << shape.name;
    }
    TriangleMesh mesh = shapes::box({0, 0, 0}, {2, 2, 2}, 2);
    mesh.triangles.pop_back();
    EXPECT_EQ(judge(inspect(raw(mesh))).verdict, Verdict::to_repair);
    EXPECT_EQ(judge(inspect(raw(mesh))).reasons, (std::vector<std::string>{"1 hole is closed."}));
    EXPECT_EQ(judge(inspect(raw(shapes::turned_inside_out(shapes::box({0, 0, 0}, {1, 1, 1}))))).verdict,
              Verdict::to_repair);
    mesh.triangles.resize(1);
    EXPECT_EQ(judge(inspect(raw(mesh))).verdict, Verdict::unrepairable);
    TriangleMesh line;
    line.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    line.triangles = {{0, 1, 2}};
    EXPECT_EQ(judge(inspect(raw(line))).verdict, Verdict::unrepairable);
    line.triangles = {{0, 0, 1}};
    const Inspection nothing = inspect(raw(line));
    EXPECT_EQ(nothing.triangles, 0U);
    EXPECT_EQ(judge(nothing).verdict, Verdict::unrepairable);
}

// Counts of verdicts, each held against what the import makes of the mesh, with and without resolving.
struct Verdicts {
    std::array<std::size_t, 3> count{};
    void expect_that_of_repair(const TriangleMesh& mesh, const std::string& what) {
        const Verdict verdict = judge(inspect(raw(mesh))).verdict;
        ++count.at(static_cast<std::size_t>(verdict));
        RepairOptions resolving;
        resolving.resolve_self_intersections = true;
        EXPECT_EQ(verdict != Verdict::unrepairable, repair(mesh).report.is_solid()) << what;
        EXPECT_EQ(verdict != Verdict::unrepairable, repair(mesh, resolving).report.is_solid()) << what;
    }
};

TEST(Inspect, TheVerdictIsThatOfRepair) {
    Verdicts verdicts;
    std::mt19937 random(7);
    for (const shapes::Named& shape : shapes::all_closed()) {
        verdicts.expect_that_of_repair(shape.mesh, shape.name);
        for (const std::uint32_t of_ten : {1U, 5U, 8U, 9U}) {
            TriangleMesh damaged = shape.mesh;
            std::erase_if(damaged.triangles, [&](const Triangle&) { return random() % 10 < of_ten; });
            for (Triangle& t : damaged.triangles) {
                if (random() % 10 == 0) std::swap(t[0], t[1]);
            }
            verdicts.expect_that_of_repair(damaged, shape.name + " without " + std::to_string(of_ten) + " of ten");
        }
    }
    // Caps of a ball: a fill that continues their curvature is larger than a flat one.
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 24);
    for (int z = -45; z <= 45; z += 3) {
        TriangleMesh cap = ball;
        std::erase_if(cap.triangles, [&](const Triangle& t) {
            return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return ball.points[v].z > z; });
        });
        verdicts.expect_that_of_repair(cap, "cap up to " + std::to_string(z));
    }
    // Halves with borders of their own, which coincide.
    TriangleMesh halves = ball;
    for (std::size_t t = 0; t < halves.triangles.size(); ++t) {
        const auto first = static_cast<std::uint32_t>(halves.points.size());
        const std::array corners = corners_of(ball, t);
        if (corners[0].z + corners[1].z + corners[2].z < 0) continue;
        halves.points.insert(halves.points.end(), corners.begin(), corners.end());
        halves.triangles[t] = {first, first + 1, first + 2};
    }
    verdicts.expect_that_of_repair(halves, "halves");
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        verdicts.expect_that_of_repair(balanced_soup({seed % 2 == 0, seed}), "soup " + std::to_string(seed));
    }
    for (const std::size_t count : verdicts.count) EXPECT_GT(count, 10U);
}

TEST(Inspect, TheVerdictOfRealScansIsThatOfRepair) {
    NEEDS_MESH("nasty");
    ImportOptions options;
    options.may_lack_unit = true;
    for (const auto& entry : std::filesystem::directory_iterator(real_mesh("nasty"))) {
        const auto is_refused = [&](const auto& action) {
            try {
                action();
            } catch (const InputError&) {
                return true;
            }
            return false;
        };
        std::optional<Verdict> verdict;
        const bool is_unread = is_refused([&] { verdict = judge(inspect(read_mesh(entry.path()))).verdict; });
        const bool is_no_solid = is_refused([&] { repair_scan(entry.path(), options); });
        EXPECT_EQ(is_unread || *verdict == Verdict::unrepairable, is_no_solid) << entry.path();
    }
}

// Reading and welding in one gives what reading, then welding gives.
TEST(Inspect, GivesTheSameForAnStlFileThatIsWeldedWhileItIsRead) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        for (std::size_t v = 0; v < mesh.points.size(); v += 3) mesh.points[v].x *= -0.0;
        const Bytes bytes = to_stl(mesh);
        RawMesh apart = parse_mesh(bytes, shape.name);
        RawMesh together = parse_mesh(bytes, shape.name, {}, {.weld = true});
        EXPECT_EQ(together.mesh.points.size() + together.welded, apart.mesh.points.size()) << shape.name;
        const Inspection a = inspect(apart);
        const Inspection b = inspect(together);
        EXPECT_EQ(a.points_in_file, b.points_in_file) << shape.name;
        EXPECT_EQ(a.welded, b.welded) << shape.name;
        EXPECT_EQ(a.collapsed, b.collapsed) << shape.name;
        weld(apart.mesh);
        weld(together.mesh);
        EXPECT_EQ(apart.mesh, together.mesh) << shape.name;
    }
}

TEST(Inspect, CountsTheRealScans) {
    NEEDS_MESH("nasty");
    const Inspection bunny = inspect(read_mesh(real_mesh("bunny_bun_zipper.ply")));
    EXPECT_EQ(bunny.holes.size(), 5U);
    EXPECT_EQ(bunny.open_edges, 223U);
    EXPECT_EQ(bunny.unreferenced, 1113U);
    const Inspection head = inspect(read_mesh(real_mesh("ct_head_371k.ply")));
    EXPECT_EQ(head.shells, 222U);
    EXPECT_EQ(head.cavities, 39U);
    EXPECT_EQ(head.collapsed, 6U);
    const Inspection router = inspect(read_mesh(real_mesh("nasty/ocl_stl_mount_rush.stl")));
    EXPECT_EQ(router.non_manifold, 1645U);
    EXPECT_EQ(router.inconsistent, 686U);
    EXPECT_EQ(router.open_edges, 862U);
    EXPECT_EQ(inspect(read_mesh(real_mesh("nasty/made_inside_out.stl"))).open_edges, 223U);
}

TEST(Inspect, DescribesSizes) {
    EXPECT_EQ(describe_size({1820, 940, 710}), "1.82 m x 0.94 m x 0.71 m");
    EXPECT_EQ(describe_size({999.4, 15, 345}), "99.9 cm x 1.5 cm x 34.5 cm");
    EXPECT_EQ(describe_size({12, 3.456, 99.9}), "12.0 mm x 3.5 mm x 99.9 mm");
    EXPECT_EQ(describe_size({999.6, 1, 1}), "1.00 m x 0.00 m x 0.00 m");
    EXPECT_EQ(describe_size({25000, 18000, 3000}), "25.0 m x 18.0 m x 3.0 m");
    EXPECT_EQ(describe_size({0, 0, 0}), "0.00 mm x 0.00 mm x 0.00 mm");
    EXPECT_FALSE(describe_size({1e308, 1e308, 1e308}).empty());
}

}  // namespace
}  // namespace qchopper
