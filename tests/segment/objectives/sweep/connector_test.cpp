#include "segment/objectives/sweep/connector_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "segment/cut/cut.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/half_solids.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/dowel_columns.h"
#include "segment/objectives/old_joints.h"
#include "segment/objectives/sweep/sweep.h"
#include "segment/search/candidates/candidates.h"
#include "tests/pieces.h"
#include "tests/segment/access/cut_samples.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Objectives with_connector(ConnectorForm form) {
    Objectives o;
    o.weights.connector = 1;
    o.connector = {form, 4, 3, 1, 1.7};
    o.fragility_form = FragilityForm::thesis;
    return o;
}

TEST(Connector, ColumnsOfABallAreItsChords) {
    constexpr double radius = 50;
    const TriangleMesh ball = shapes::ball({3, 4, 5}, radius, 80);
    const Vec3 n = canonical({normalized({1, 2, 3}), 0}).normal;
    const SolidColumns columns = solid_columns(ball, n, {3, 4, 5}, 5);
    double volume = 0;
    for (std::int32_t j = 0; j < static_cast<std::int32_t>(columns.map.rows); ++j) {
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(columns.map.columns); ++i) {
            const auto found = columns.map.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
            const double square = 25.0 * (std::pow(i + columns.first_i, 2) + std::pow(j + columns.first_j, 2));
            ASSERT_LE(found.size(), 1U);
            if (square > 45 * 45) continue;
            ASSERT_EQ(found.size(), 1U);
            const SolidSpan r = found.front();
            EXPECT_NEAR(r.high - r.low, 2 * std::sqrt(radius * radius - square), 0.5);
            volume += 25 * (r.high - r.low);
        }
    }
    EXPECT_GT(volume, 0.9 * volume_mm3(ball));
}

TEST(Connector, ColumnsAlongEdgesAndFacesEnterAsOftenAsTheyLeave) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        for (const Vec3 n : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, canonical({normalized({1, 1, 0}), 0}).normal}) {
            const SolidColumns columns = solid_columns(mesh, n, mesh.points.front(), 0.37);
            double volume = 0;
            for (const SolidSpan& r : columns.map.spans) volume += 0.37 * 0.37 * (r.high - r.low);
            const double size = norm(bounds(mesh).size());
            EXPECT_NEAR(volume, volume_mm3(mesh), 0.02 * volume_mm3(mesh) + 0.01 * size * size * 0.37) << name;
        }
    }
}

TEST(Connector, ASiteIsWhereTheDiscOfLinesIsSolidOnBothSides) {
    const TriangleMesh mesh = shapes::linked_tori();
    const ConnectorOptions dowel{ConnectorForm::spread, 4, 3, 1, 1.7};
    const Vec3 n = canonical({normalized({3, -1, 2}), 0}).normal;
    const SolidColumns columns = solid_columns(mesh, n, mesh.points.front(), dowel.spacing);
    const auto count_i = static_cast<std::int32_t>(columns.map.columns);
    const auto count_j = static_cast<std::int32_t>(columns.map.rows);
    const auto is_solid = [&](std::int32_t i, std::int32_t j, double low, double high) {
        if (i < 0 || j < 0 || i >= count_i || j >= count_j) return false;
        const auto solid = columns.map.at(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
        return std::any_of(solid.begin(), solid.end(),
                           [&](const SolidSpan& d) { return d.low <= low && d.high >= high; });
    };
    std::map<std::pair<std::int32_t, std::int32_t>, std::vector<SolidSpan>> sites;
    for (const DowelSite& site : dowel_sites(columns, dowel)) sites[{site.i, site.j}].push_back(site.offsets);
    const Extent range = extent(mesh, n);
    std::size_t found = 0;
    for (int k = 1; k < 25; ++k) {
        const double o = range.low + range.size() * k / 25;
        for (std::int32_t j = 0; j < count_j; ++j) {
            for (std::int32_t i = 0; i < count_i; ++i) {
                bool fits = true;
                for (std::int32_t dj = -2; dj <= 2; ++dj) {
                    for (std::int32_t di = -2; di <= 2; ++di) {
                        if (std::hypot(di, dj) * dowel.spacing > dowel.clearance()) continue;
                        fits = fits && is_solid(i + di, j + dj, o - 4, o + 4);
                    }
                }
                bool is_site = false;
                for (const SolidSpan& r : sites[{i + columns.first_i, j + columns.first_j}])
                    is_site = is_site || (r.low <= o && o <= r.high);
                ASSERT_EQ(is_site, fits) << i << " " << j << " " << o;
                found += fits ? 1 : 0;
            }
        }
    }
    EXPECT_GT(found, 100U);
}

// A cap of a half: its triangles in plane coordinates, each with its component and solid.
struct PlainCap {
    std::vector<std::array<Point2, 3>> triangle;
    std::vector<std::uint32_t> component;
    std::vector<std::uint32_t> solid;

    PlainCap(const Half& half, const HalfSolids& grouped, const PlaneFrame& frame, Vec3 origin) {
        const std::vector<std::uint32_t> solid_of = solid_of_triangle(grouped.shells, grouped.solids);
        const Edges pairs = edges(half.mesh);
        DisjointSets sets(half.mesh.triangles.size());
        for (std::uint32_t t = 0; t < half.mesh.triangles.size(); ++t) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t other = pairs.twin[3 * t + k] / 3;
                if (cap_of(half.mesh, t) == new_cut && cap_of(half.mesh, other) == new_cut) sets.unite(t, other);
            }
        }
        for (std::uint32_t t = 0; t < half.mesh.triangles.size(); ++t) {
            if (cap_of(half.mesh, t) != new_cut) continue;
            std::array<Point2, 3> corners;
            for (std::size_t k = 0; k < 3; ++k)
                corners[k] = flattened(frame, origin, half.mesh.points[half.mesh.triangles[t][k]]);
            triangle.push_back(corners);
            component.push_back(sets.root(t));
            solid.push_back(solid_of[t]);
        }
    }
    // The triangle that holds the point, or their number.
    std::size_t at(Point2 p) const {
        for (std::size_t t = 0; t < triangle.size(); ++t) {
            const double a = orientation(triangle[t][0], triangle[t][1], p);
            const double b = orientation(triangle[t][1], triangle[t][2], p);
            const double c = orientation(triangle[t][2], triangle[t][0], p);
            if ((a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0)) return t;
        }
        return triangle.size();
    }
    double area(std::size_t t) const {
        return std::abs(orientation(triangle[t][0], triangle[t][1], triangle[t][2])) / 2;
    }
};

// The objective of a really made cut, from all sites and all pairs of them.
double by_cutting(const Piece& piece, const Plane& plane, const std::vector<DowelSite>& sites, const Objectives& o) {
    const auto halves = cut(*piece.mesh, plane, new_cut);
    const SolidsOfHalves solids = solids_of_halves(*piece.mesh, plane, *halves);
    const PlaneFrame frame = frame_across(plane.normal);
    const PlainCap below(halves->below, solids.below, frame, piece.mesh->points.front());
    const PlainCap above(halves->above, solids.above, frame, piece.mesh->points.front());
    std::map<std::uint32_t, double> area_of;  // per component of the cap below
    std::map<std::uint32_t, std::pair<double, std::size_t>> largest;
    for (std::size_t t = 0; t < below.triangle.size(); ++t) {
        area_of[below.component[t]] += below.area(t);
        auto& [area, which] = largest[below.component[t]];
        if (below.area(t) > area) largest[below.component[t]] = {below.area(t), t};
    }
    struct Joint {
        double area = 0;
        std::vector<Point2> places;
        Extent16 extent;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, Joint> joints;
    const auto joint_of = [&](std::uint32_t component) {
        const auto& corners = below.triangle[largest[component].second];
        const Point2 middle{(corners[0].x + corners[1].x + corners[2].x) / 3,
                            (corners[0].y + corners[1].y + corners[2].y) / 3};
        const std::size_t over = above.at(middle);
        EXPECT_LT(over, above.triangle.size());
        if (o.connector.form == ConnectorForm::ratio) return std::pair(component, 0U);
        return std::pair(above.solid[over], below.solid[largest[component].second]);
    };
    for (std::size_t t = 0; t < below.triangle.size(); ++t) {
        if (area_of[below.component[t]] < min_joint_mm2) continue;
        Joint& joint = joints[joint_of(below.component[t])];
        joint.area += below.area(t);
        for (const Point2 p : below.triangle[t]) joint.extent.include(p);
    }
    for (const DowelSite& site : sites) {
        if (plane.offset < site.offsets.low || plane.offset > site.offsets.high) continue;
        const Point2 p{site.i * o.connector.spacing, site.j * o.connector.spacing};
        const std::size_t t = below.at(p);
        EXPECT_LT(t, below.triangle.size()) << "a site outside the section";
        if (t >= below.triangle.size() || area_of[below.component[t]] < min_joint_mm2) continue;
        joints[joint_of(below.component[t])].places.push_back(p);
    }
    double sum = 0;
    double areas = 0;
    double worst = 0;
    // Joints of older cuts: held to cutting by old_joints_test.cpp.
    for (const OldJoint& old : old_joints(piece, o.connector)) {
        const auto sides = parted(old, plane.normal, std::array{plane.offset}, o.connector);
        for (const JointMeasure& side : sides[0]) {
            if (side.area_mm2 < min_joint_mm2) continue;
            sum += side.area_mm2 * connector_of({&side, 1}, o.connector);
            areas += side.area_mm2;
        }
    }
    for (const auto& [key, joint] : joints) {
        double s = 0;
        for (const Point2 a : joint.places) {
            for (const Point2 b : joint.places) s = std::max(s, std::hypot(a.x - b.x, a.y - b.y));
        }
        sum += joint.area * (s < 3 * o.connector.diameter ? 1 : std::max(0.0, 1 - 2 * s / joint.extent.largest()));
        areas += joint.area;
        const JointMeasure alone{joint.area, joint.extent.largest(), joint.places};
        worst = std::max(worst, connector_of({&alone, 1}, o.connector));
    }
    if (o.connector.form == ConnectorForm::ratio) return worst;
    return areas > 0 ? sum / areas : 0;
}

// Compares `count` planes along a normal. Returns of how many the objective is neither 0 nor 1.
std::size_t expect_as_by_cutting(const Piece& piece, Vec3 n, const Objectives& o, int count, const std::string& what) {
    const Extent range = extent(*piece.mesh, n);
    std::vector<double> wanted;
    for (int k = 1; k <= count; ++k) wanted.push_back(range.low + range.size() * k / (count + 1));
    std::vector<double> offsets;
    for (const auto& nudged : nudge(piece, n, wanted)) {
        if (nudged) offsets.push_back(nudged->offset);
    }
    const PreparedPiece prepared = prepare(piece, o);
    const auto evaluations = sweep(prepared, n, offsets, o);
    const std::vector<DowelSite> sites =
        dowel_sites(solid_columns(*piece.mesh, n, prepared.origin, o.connector.spacing), o.connector);
    std::size_t held = 0;
    for (std::size_t k = 0; k < offsets.size(); ++k) {
        if (!evaluations[k]) continue;
        const double plain = by_cutting(piece, {n, offsets[k]}, sites, o);
        EXPECT_NEAR(evaluations[k]->connector, plain, 1e-9 * (1 + plain)) << what << " " << k;
        if (plain > 0 && plain < 1) ++held;
    }
    return held;
}

TEST(Connector, EqualsCuttingOnEveryShape) {
    std::mt19937 random(41);
    std::size_t held = 0;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        for (int round = 0; round < 6; ++round) {
            const Objectives o = with_connector(round % 2 == 0 ? ConnectorForm::spread : ConnectorForm::ratio);
            held += expect_as_by_cutting(piece_of(mesh), random_normal(random), o, 23, name);
        }
    }
    EXPECT_GT(held, 20U);
}

TEST(Connector, EqualsCuttingOnSamplesAndOnTheirPieces) {
    std::size_t held = 0;
    std::size_t with_caps = 0;
    for (const SampleCut& of : cut_samples({Specimen::vertebra, Specimen::femur})) {
        Objectives o = with_connector(ConnectorForm::spread);
        o.connector = {ConnectorForm::spread, 8, 22, 6, of.piece_size / 60};
        held += expect_as_by_cutting(of.piece, of.normal, o, 6, of.name);
        with_caps += of.piece.half_spaces.empty() ? 0 : 1;
        if (!of.piece.half_spaces.empty()) continue;
        o.connector.form = ConnectorForm::ratio;
        held += expect_as_by_cutting(of.piece, of.normal, o, 6, of.name);
    }
    EXPECT_GT(held, 20U);
    EXPECT_GE(with_caps, 6U);
}

TEST(Connector, ABeamIsHeldByDowelsAtItsEndsAndAThinPlateByNone) {
    Objectives o;
    o.weights.connector = 1;
    const auto value = [&](Vec3 size, ConnectorForm form) {
        o.connector.form = form;
        const Piece piece = piece_of(shapes::box({0, 0, 0}, size));
        const double at = size.z / 2 + 0.1;
        return sweep(prepare(piece, o), {0, 0, 1}, {&at, 1}, o)[0]->connector;
    };
    EXPECT_LT(value({200, 60, 100}, ConnectorForm::spread), 0.2);
    EXPECT_EQ(value({200, 15, 100}, ConnectorForm::spread), 1) << "no wall beside an 8 mm hole";
    EXPECT_EQ(value({200, 60, 50}, ConnectorForm::spread), 1) << "too short for the depth";
    EXPECT_EQ(value({40, 40, 100}, ConnectorForm::spread), 1) << "less than three diameters apart";
    EXPECT_EQ(value({200, 60, 100}, ConnectorForm::ratio), 0);
    EXPECT_EQ(value({200, 15, 100}, ConnectorForm::ratio), 100);
    EXPECT_EQ(value({20, 15, 100}, ConnectorForm::ratio), 0) << "less than 4 cm2";
}

TEST(Connector, TheStagesGiveWhatOneSweepGives) {
    const Objectives o = [] {
        Objectives all = with_connector(ConnectorForm::spread);
        all.weights.symmetry = 1;
        all.weights.seam = 1;
        all.symmetry_plane = Plane{{1, 0, 0}, 3};
        return all;
    }();
    const Piece piece = piece_of(shapes::linked_tori());
    const Vec3 n = canonical({normalized({1, 2, -3}), 0}).normal;
    const Extent range = extent(*piece.mesh, n);
    std::vector<double> offsets;
    for (int k = 1; k < 15; ++k) offsets.push_back(range.low + range.size() * k / 15 + 1e-4);
    const PreparedPiece prepared = prepare(piece, o);
    const auto whole = sweep(prepared, n, offsets, o);
    auto staged = sweep_solids(prepared, n, offsets);
    add_fragility(prepared, n, offsets, o, staged);
    add_section_terms(prepared, n, offsets, o, staged);
    for (std::size_t k = 0; k < offsets.size(); ++k) {
        ASSERT_EQ(whole[k].has_value(), staged[k].has_value());
        if (!whole[k]) continue;
        EXPECT_EQ(whole[k]->connector, staged[k]->connector);
        EXPECT_EQ(whole[k]->symmetry_mm, staged[k]->symmetry_mm);
        EXPECT_EQ(whole[k]->fragility, staged[k]->fragility);
        EXPECT_EQ(whole[k]->seam_mm, staged[k]->seam_mm);
        EXPECT_GT(staged[k]->seam_mm, 0);
    }
}

TEST(Connector, TheValuesOfAPlaneDoNotDependOnTheOthersThatAreAsked) {
    Objectives o = with_connector(ConnectorForm::spread);
    o.weights.symmetry = 1;
    o.weights.seam = 1;
    o.symmetry_plane = Plane{{1, 0, 0}, 3};
    std::mt19937 random(52);
    std::size_t valued = 0;
    for (const FragilityForm form : {FragilityForm::thinness, FragilityForm::thesis, FragilityForm::binary}) {
        o.fragility_form = form;
        for (const auto& [name, mesh, count] : shapes::all_closed()) {
            const Vec3 first = random_normal(random);
            const Extent range = extent(mesh, first);
            const auto at = nudge(piece_of(mesh), first, std::array{range.low + 0.45 * range.size()});
            if (!at[0]) continue;
            const auto made = cut_piece(piece_of(mesh), {first, at[0]->offset}, 1);
            for (const Piece& piece : made ? made->pieces : std::vector<Piece>{}) {
                const Vec3 n = random_normal(random);
                const std::vector<Candidate> planes = candidates_along(piece, n, 0, 17);
                std::vector<double> offsets;
                for (const Candidate& c : planes) offsets.push_back(c.plane.offset);
                const PreparedPiece prepared = prepare(piece, o);
                const auto whole = sweep(prepared, n, offsets, o);
                const auto quick = sweep_solids(prepared, n, offsets);
                std::vector<double> some;
                std::vector<std::size_t> of;
                std::vector<std::optional<CutEvaluation>> asked;
                for (std::size_t k = random() % 3; k < offsets.size(); k += 1 + random() % 6) {
                    of.push_back(k);
                    some.push_back(offsets[k]);
                    asked.push_back(quick[k]);
                }
                add_fragility(prepared, n, some, o, asked);
                add_section_terms(prepared, n, some, o, asked);
                for (std::size_t i = 0; i < of.size(); ++i) {
                    ASSERT_EQ(whole[of[i]].has_value(), asked[i].has_value()) << name;
                    if (!asked[i]) continue;
                    EXPECT_EQ(whole[of[i]]->fragility, asked[i]->fragility) << name;
                    EXPECT_EQ(whole[of[i]]->seam_mm, asked[i]->seam_mm) << name;
                    EXPECT_EQ(whole[of[i]]->connector, asked[i]->connector) << name;
                    EXPECT_EQ(whole[of[i]]->symmetry_mm, asked[i]->symmetry_mm) << name;
                    valued += asked[i]->connector > 0 && asked[i]->connector < 1 ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(valued, 20U);
}

}  // namespace
}  // namespace qchopper
