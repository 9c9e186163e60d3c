#include "segment/repair/balance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "segment/cut/cut.h"
#include "segment/cut/nudge.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "segment/repair/repair.h"
#include "segment/repair/weld.h"
#include "tests/segment/io/help.h"
#include "tests/segment/repair/soup.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr std::uint32_t soups = 1500;

using Place = std::array<double, 3>;
Place place_of(const TriangleMesh& mesh, std::uint32_t point) {
    const Vec3 p = mesh.points[point];
    return {p.x + 0.0, p.y + 0.0, p.z + 0.0};
}

// By coordinates, so that it is independent of welding: how much more often each directed edge occurs than its reverse.
bool balances(const TriangleMesh& mesh) {
    std::map<std::array<Place, 2>, int> more;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Place a = place_of(mesh, t[k]);
            const Place b = place_of(mesh, t[(k + 1) % 3]);
            if (a < b) ++more[{a, b}];
            if (b < a) --more[{b, a}];
        }
    }
    return std::all_of(more.begin(), more.end(), [](const auto& edge) { return edge.second == 0; });
}

// Every directed edge once and its reverse once, and the faces around every point are one fan.
void expect_closed_manifold(const TriangleMesh& mesh) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> third;  // of the face with this directed edge
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            ASSERT_TRUE(third.insert({{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]}).second) << "two faces one way";
        }
    }
    std::vector<std::size_t> faces(mesh.points.size());
    for (const auto& [edge, corner] : third) {
        ASSERT_TRUE(third.contains({edge[1], edge[0]})) << "open";
        ++faces[edge[0]];
    }
    std::vector<bool> is_seen(mesh.points.size());
    for (const auto& [edge, corner] : third) {
        const std::uint32_t centre = edge[0];
        if (is_seen[centre]) continue;
        is_seen[centre] = true;
        std::size_t in_fan = 0;
        std::uint32_t at = edge[1];
        do {
            at = third.at({centre, at});
            ++in_fan;
        } while (at != edge[1] && in_fan <= faces[centre]);
        ASSERT_EQ(in_fan, faces[centre]) << "two fans at a point";
    }
}

// Per three places, how many more faces turn one way than the other.
std::map<std::array<Place, 3>, int> faces_left_over(const TriangleMesh& mesh, std::size_t* count = nullptr) {
    std::map<std::array<Place, 3>, int> more;
    for (const Triangle& t : mesh.triangles) {
        std::array<Place, 3> face{place_of(mesh, t[0]), place_of(mesh, t[1]), place_of(mesh, t[2])};
        int way = 1;
        for (const auto& [i, j] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{0, 1}}) {
            if (face[i] <= face[j]) continue;
            std::swap(face[i], face[j]);
            way = -way;
        }
        if (face[0] == face[1] || face[1] == face[2]) continue;
        more[face] += way;
    }
    std::erase_if(more, [](const auto& face) { return face.second == 0; });
    if (count != nullptr) {
        *count = 0;
        for (const auto& [face, times] : more) *count += static_cast<std::size_t>(std::abs(times));
    }
    return more;
}

struct Volume {
    double signed_sum = 0;
    double of_all = 0;  // what its rounding is to be compared with
};
Volume volume_of(const TriangleMesh& mesh) {
    const Vec3 origin = bounds(mesh).centre();
    long double sum = 0;
    long double all = 0;
    for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.points[t[0]] - origin;
        const long double six = dot(a, cross(mesh.points[t[1]] - origin, mesh.points[t[2]] - origin));
        sum += six / 6;
        all += std::abs(six) / 6;
    }
    return {static_cast<double>(sum), static_cast<double>(all)};
}

void expect_same_volume(const TriangleMesh& after, const TriangleMesh& before) {
    const Volume volume = volume_of(before);
    EXPECT_NEAR(volume_of(after).signed_sum, volume.signed_sum,
                1e-9 * std::abs(volume.signed_sum) + 1e-14 * volume.of_all);
}

TEST(Balance, OfTheTestsOwnSoups) {
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        ASSERT_TRUE(balances(balanced_soup({seed % 2 == 0, seed}))) << seed;
    }
    TriangleMesh open = shapes::box({0, 0, 0}, {1, 1, 1});
    open.triangles.pop_back();
    EXPECT_FALSE(balances(open));
}

TEST(Balance, IsFoundAsByThePlainCount) {
    for (std::uint32_t seed = 0; seed < 600; ++seed) {
        TriangleMesh mesh = balanced_soup({false, seed});
        if (seed % 3 == 1) mesh.triangles.pop_back();
        if (seed % 3 == 2) std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
        const bool expected = balances(mesh);
        weld(mesh);
        EXPECT_EQ(is_balanced(mesh, edges(mesh)), expected) << seed;
    }
}

TEST(Balance, EverySoupBecomesClosedShellsOfTheSameFaces) {
    std::size_t with_splits = 0;
    for (std::uint32_t seed = 0; seed < soups; ++seed) {
        SCOPED_TRACE(seed);
        TriangleMesh mesh = balanced_soup({seed % 2 == 0, seed});
        std::size_t left = 0;
        const auto expected = faces_left_over(mesh, &left);
        weld(mesh);
        const TriangleMesh welded = mesh;
        const std::optional<ShellCounts> counts = close_balanced(mesh);
        ASSERT_EQ(counts.has_value(), left > 0);
        if (!counts) {
            EXPECT_EQ(mesh, welded);
            continue;
        }
        with_splits += counts->edges_split > 0;
        expect_closed_manifold(mesh);
        EXPECT_EQ(faces_left_over(mesh), expected);
        EXPECT_EQ(mesh.triangles.size(), left);
        EXPECT_EQ(welded.triangles.size() - left, counts->cancelled);
        weld(mesh);  // points of faces that are gone go
        close_balanced(mesh);
        TriangleMesh again = mesh;
        weld(again);
        EXPECT_EQ(close_balanced(again)->cancelled, 0U);
        ASSERT_TRUE(again == mesh) << "twice is not once";
        if (HasFatalFailure()) return;
    }
    EXPECT_GE(with_splits, soups / 2);
}

// The cutter's own condition: halves close and their volumes add up.
void expect_it_can_be_cut(TriangleMesh mesh, std::uint32_t seed, int planes) {
    const Box box = bounds(mesh);
    const double unit = 1000 / norm(box.size());
    for (Vec3& p : mesh.points) p = unit * (p - box.centre());
    Piece piece;
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    const Volume volume = volume_of(*piece.mesh);
    std::mt19937 random(seed);
    std::normal_distribution<double> direction;
    std::uniform_real_distribution<double> share(0.05, 0.95);
    for (int i = 0; i < planes; ++i) {
        Vec3 normal{direction(random), direction(random), direction(random)};
        if (i == 0) normal = {0, 0, 1};
        normal = canonical({normalized(normal), 0}).normal;
        const Extent reach = extent(*piece.mesh, normal);
        const auto nudged = nudge(piece, normal, std::array{reach.low + share(random) * reach.size()});
        if (!nudged[0].has_value()) continue;
        const std::optional<CutHalves> halves = cut(*piece.mesh, {normal, nudged[0]->offset}, 1);
        if (!halves) continue;
        const bool is_sound = halves->forced_regions == 0;  // else loops of the section cross: no cap fits in them
        EXPECT_TRUE(!is_sound || edges(halves->above.mesh).faults.is_closed()) << i;
        EXPECT_TRUE(!is_sound || edges(halves->below.mesh).faults.is_closed()) << i;
        EXPECT_NEAR(volume_of(halves->above.mesh).signed_sum + volume_of(halves->below.mesh).signed_sum,
                    volume.signed_sum, 1e-9 * volume.of_all)
            << i;
    }
}

void expect_nothing_was_filled(const RepairReport& report) {
    EXPECT_EQ(report.holes_filled + report.faces_added + report.points_added + report.open_components_dropped, 0U);
    EXPECT_EQ(report.repeated + report.faces_reoriented + report.edges_cut + report.stitched, 0U);
    EXPECT_EQ(report.open_edges, 0U);
}

TEST(Balance, RepairMakesSolidsOfThemThatCanBeCut) {
    std::size_t made = 0;
    for (std::uint32_t seed = 0; seed < soups; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = balanced_soup({true, seed});
        std::size_t left = 0;
        faces_left_over(mesh, &left);
        const Volume volume = volume_of(mesh);
        if (left == 0 || volume.signed_sum <= 1e-9 * volume.of_all) continue;
        ++made;
        const Repaired once = repair(mesh);
        expect_closed_manifold(once.mesh);
        expect_same_volume(once.mesh, mesh);
        expect_nothing_was_filled(once.report);
        EXPECT_TRUE(once.report.is_solid());
        ASSERT_TRUE(repair(once.mesh).mesh == once.mesh) << "twice is not once";
        expect_it_can_be_cut(once.mesh, seed, 3);
        if (HasFatalFailure()) return;
    }
    EXPECT_GE(made, soups / 2);
}

TEST(Balance, InsideOutShellsDoNotKeepThemFromClosing) {
    for (std::uint32_t seed = 0; seed < soups; ++seed) {
        SCOPED_TRACE(seed);
        const TriangleMesh mesh = balanced_soup({false, seed});
        std::size_t left = 0;
        faces_left_over(mesh, &left);
        if (left == 0) continue;
        RepairOptions options;
        options.orient_outward = false;
        const Repaired as_it_is = repair(mesh, options);
        expect_closed_manifold(as_it_is.mesh);
        expect_same_volume(as_it_is.mesh, mesh);
        expect_nothing_was_filled(as_it_is.report);
        const Repaired turned = repair(mesh);
        expect_closed_manifold(turned.mesh);
        expect_nothing_was_filled(turned.report);
        ASSERT_TRUE(repair(turned.mesh).mesh == turned.mesh) << "twice is not once";
        if (HasFatalFailure()) return;
    }
}

TEST(Balance, AShellThatIsThereTwiceStaysTwoShells) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh twice = shapes::joined({shape.mesh, shape.mesh});
        const Repaired result = repair(twice);
        expect_closed_manifold(result.mesh);
        EXPECT_EQ(shells(result.mesh).count(), 2 * shells(shape.mesh).count()) << shape.name;
        EXPECT_NEAR(result.report.volume / volume_mm3(shape.mesh), 2, 1e-9) << shape.name;
    }
}

TEST(Balance, ManyWedgesAroundOneEdgeStayApart) {
    for (const std::uint32_t wedges : {2U, 3U, 10U, 1000U}) {
        TriangleMesh mesh;
        mesh.points = {{0, 0, 0}, {0, 0, 1}};
        for (std::uint32_t k = 0; k < 2 * wedges; ++k) {
            const double angle = 3 * static_cast<double>(k) / wedges;
            mesh.points.push_back({std::cos(angle), std::sin(angle), 0.5});
        }
        for (std::uint32_t k = 2; k < 2 * wedges + 2; k += 2) {
            for (const Triangle& t : {Triangle{0, 1, k + 1}, {0, k, 1}, {0, k + 1, k}, {1, k, k + 1}}) {
                mesh.triangles.push_back(t);
            }
        }
        const Repaired result = repair(mesh);
        expect_closed_manifold(result.mesh);
        EXPECT_EQ(shells(result.mesh).count(), wedges);
        for (const double volume : shells(result.mesh).volume) EXPECT_GT(volume, 0);
    }
}

// Twelve cubes without two in the middle layer that touch in an edge. Split by its wedges of material, the surface
// would go around both ends of that edge twice: the edge would have four faces.
TEST(Balance, AnEdgeBetweenTwoHollowsIsSplitTheOtherWay) {
    TriangleMesh block;
    for (const double z : {0.0, 1.0, 2.0}) {
        for (const Vec3 low : {Vec3{0, 0, z}, {1, 0, z}, {0, 1, z}, {1, 1, z}}) {
            if (z == 1.0 && low.x == low.y) continue;
            block = shapes::joined({block, shapes::box(low, low + Vec3{1, 1, 1})});
        }
    }
    const Repaired result = repair(block);
    expect_closed_manifold(result.mesh);
    EXPECT_EQ(result.report.edges_split, 1U);
    EXPECT_EQ(result.report.points_copied, 2U);
    EXPECT_EQ(shells(result.mesh).count(), 1U);
    EXPECT_NEAR(result.report.volume, 10, 1e-12);
    expect_nothing_was_filled(result.report);
}

TEST(Balance, AFamousScanOfClusteredPointsCloses) {
    NEEDS_MESH("dragon_vrip_871k.ply");
    const TriangleMesh dragon = repair(read_mesh(real_mesh("dragon_vrip_871k.ply")).mesh).mesh;
    const double size = norm(bounds(dragon).size());
    for (const double cells : {40.0, 100.0, 250.0, 600.0}) {
        SCOPED_TRACE(cells);
        const TriangleMesh mesh = clustered(dragon, size / cells);
        const Repaired result = repair(mesh);
        expect_closed_manifold(result.mesh);
        expect_same_volume(result.mesh, mesh);
        expect_nothing_was_filled(result.report);
        EXPECT_TRUE(result.report.is_solid());
        EXPECT_TRUE(repair(result.mesh).mesh == result.mesh) << "twice is not once";
        expect_it_can_be_cut(result.mesh, 1, 10);
    }
}

}  // namespace
}  // namespace qchopper
