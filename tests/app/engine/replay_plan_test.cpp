#include "app/engine/replay_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "segment/sample/sample.h"
#include "tests/app/engine/planned.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A scan as import gives it: about its own centre.
struct Scan {
    TriangleMesh mesh;
    Vec3 centre;
};

Scan centred(TriangleMesh mesh) {
    Scan scan{std::move(mesh), {}};
    scan.centre = bounds(scan.mesh).centre();
    for (Vec3& p : scan.mesh.points) p = p - scan.centre;
    return scan;
}

struct Replayed {
    Segmentation segmentation;
    PlanReplay replay;
    std::size_t told = 0;
};

Replayed replayed(const Plan& plan, const Scan& scan) {
    const ScanSource source = planned::source_of(scan.mesh, scan.centre);
    SearchSettings settings;
    settings.objectives.fragment_volume_mm3 = 1e-5 * source.volume_mm3;
    Replayed r{uncut(scan.mesh, settings.objectives.fragment_volume_mm3), {}, 0};
    EvaluationCache cache(settings.objectives, settings.candidates);
    r.replay = replay_plan(plan, source, r.segmentation, settings, cache, [&](const Segmentation&) { ++r.told; }, {});
    return r;
}

Plan plan_of(const Scan& scan, int cuts) {
    return make_plan(planned::project_of(scan.mesh, scan.centre, cuts), scan.mesh);
}

TEST(ReplayPlan, OnTheVeryScanThePiecesAreTheSameBitForBit) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Scan scan = centred(shapes::moved(mesh, {1000.0 / 3, -77.7, 5}));
        const Project project = planned::project_of(scan.mesh, scan.centre, 3);
        const Segmentation original = replay(project, scan.mesh);
        const Plan plan = plan_from_text(to_text(make_plan(project, scan.mesh)), "p.toml");
        EXPECT_EQ(misfit(plan, project.scan, scan.mesh), "") << name;
        const Replayed r = replayed(plan, scan);
        EXPECT_TRUE(r.replay.applies) << name << ": " << r.replay.why;
        EXPECT_TRUE(r.replay.notes.empty()) << name;
        EXPECT_EQ(r.told, project.cuts.size());
        EXPECT_EQ(r.replay.largest_volume_off, 0) << name;
        ASSERT_EQ(r.segmentation.pieces.size(), original.pieces.size()) << name;
        for (std::size_t p = 0; p < original.pieces.size(); ++p) {
            EXPECT_EQ(r.segmentation.pieces[p].name, original.pieces[p].name) << name;
            EXPECT_EQ(*r.segmentation.pieces[p].mesh, *original.pieces[p].mesh) << name;
        }
        for (std::size_t i = 0; i < project.cuts.size(); ++i) {
            EXPECT_EQ(r.segmentation.cuts[i].chosen.plane, project.cuts[i].chosen.plane) << name;
            EXPECT_NEAR(r.segmentation.cuts[i].chosen.terms.total, project.cuts[i].chosen.terms.total, 1e-9) << name;
        }
    }
}

// The same surface on other triangles: every triangle in four, triangles and points in another order.
TriangleMesh meshed_anew(const TriangleMesh& mesh) {
    TriangleMesh fine;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    fine.points.assign(mesh.points.rbegin(), mesh.points.rend());
    const auto last = static_cast<std::uint32_t>(mesh.points.size()) - 1;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [it, is_new] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(fine.points.size()));
        if (is_new) fine.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
        return it->second;
    };
    for (auto t = mesh.triangles.rbegin(); t != mesh.triangles.rend(); ++t) {
        const auto [a, b, c] = *t;
        const std::uint32_t ab = between(a, b);
        const std::uint32_t bc = between(b, c);
        const std::uint32_t ca = between(c, a);
        fine.triangles.push_back({last - a, ab, ca});
        fine.triangles.push_back({ab, last - b, bc});
        fine.triangles.push_back({ca, bc, last - c});
        fine.triangles.push_back({ab, bc, ca});
    }
    return fine;
}

std::vector<double> volumes(const Segmentation& segmentation) {
    std::vector<double> all;
    for (const Piece& piece : segmentation.pieces) all.push_back(volume_mm3(*piece.mesh));
    std::sort(all.begin(), all.end());
    return all;
}

TEST(ReplayPlan, OnTheSameSurfaceMeshedAnewThePiecesAreTheSame) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Scan scan = centred(shapes::moved(mesh, {300, 20, -7}));
        Scan other = centred(meshed_anew(shapes::moved(mesh, {300, 20, -7})));
        const Plan plan = plan_of(scan, 3);
        const Replayed r = replayed(plan, other);
        EXPECT_TRUE(r.replay.applies) << name << ": " << r.replay.why;
        EXPECT_LT(r.replay.largest_volume_off, 1e-6) << name;
        EXPECT_EQ(r.segmentation.cuts.size(), 3U) << name;
    }
}

Scan specimen(Specimen which, std::size_t faces) {
    SampleOptions options;
    options.faces = faces;
    return centred(sample(which, options));
}

// The largest relative difference in volume of the pieces that a plan of `coarse` makes of `fine`.
double largest_difference(const Scan& coarse, const Scan& fine) {
    const Project project = planned::project_of(coarse.mesh, coarse.centre, 3);
    const Plan plan = make_plan(project, coarse.mesh);
    EXPECT_EQ(misfit(plan, planned::source_of(fine.mesh, fine.centre), fine.mesh), "");
    const Replayed r = replayed(plan, fine);
    EXPECT_TRUE(r.replay.applies) << r.replay.why;
    const std::vector<double> of_plan = volumes(replay(project, coarse.mesh));
    const std::vector<double> made = volumes(r.segmentation);
    EXPECT_EQ(made.size(), of_plan.size());
    double largest = 0;
    for (std::size_t i = 0; i < std::min(made.size(), of_plan.size()); ++i) {
        largest = std::max(largest, std::abs(made[i] / of_plan[i] - 1));
    }
    return largest;
}

TEST(ReplayPlan, WhereTheScansAgreeVolumesAgreeWithinAThousandth) {
    const Scan ball = centred(shapes::ball({40, 50, 60}, 100, 160));
    EXPECT_LT(largest_difference(ball, centred(shapes::ball({40, 50, 60}, 100, 300))), 1e-3);
    for (const Specimen which : {Specimen::femur, Specimen::vertebra}) {
        EXPECT_LT(largest_difference(specimen(which, 400'000), specimen(which, 800'000)), 1e-3);
    }
}

// A specimen of 100,000 faces has itself 0.1 % less volume than a finer one, its thin pieces up to 0.3 %: the chords
// of a coarse mesh lie inside the bone. The plan finds the same pieces all the same, and so it does on a coarser one.
TEST(ReplayPlan, WhereTheScansDifferThePiecesAreTheSameAndTheDifferenceIsTold) {
    for (const Specimen which : {Specimen::femur, Specimen::vertebra, Specimen::skull}) {
        const Scan coarse = specimen(which, 100'000);
        const Scan fine = specimen(which, 300'000);
        EXPECT_LT(largest_difference(coarse, fine), 5e-3);
        EXPECT_LT(largest_difference(fine, coarse), 5e-3);
        const Replayed r = replayed(plan_of(coarse, 3), fine);
        EXPECT_GT(r.replay.largest_volume_off, 1e-4);
        EXPECT_LT(r.replay.largest_volume_off, 5e-3);
    }
}

TEST(ReplayPlan, AnOffsetOnAVertexOfTheOtherScanIsNudgedOnceAndSaid) {
    const Scan scan = centred(shapes::ball({0, 0, 0}, 50, 16));
    Plan plan = plan_of(scan, 1);
    Scan other = scan;
    // The vertex that is nearest to the plane is put right on it.
    const Plane plane{plan.cuts[0].plane.normal, plan.cuts[0].from_centre};
    std::size_t nearest = 0;
    const auto off = [&](std::size_t v) { return height(plane.normal, other.mesh.points[v]) - plane.offset; };
    for (std::size_t v = 0; v < other.mesh.points.size(); ++v) {
        if (std::abs(off(v)) < std::abs(off(nearest))) nearest = v;
    }
    other.mesh.points[nearest] = other.mesh.points[nearest] - off(nearest) * plane.normal;
    const Replayed r = replayed(plan, other);
    EXPECT_TRUE(r.replay.applies) << r.replay.why;
    ASSERT_EQ(r.replay.notes.size(), 1U);
    EXPECT_NE(r.replay.notes[0].find("nudged"), std::string::npos);
    EXPECT_NE(r.segmentation.cuts[0].chosen.plane.offset, plane.offset);
    EXPECT_NEAR(r.segmentation.cuts[0].chosen.plane.offset, plane.offset, 1e-3);
}

TEST(ReplayPlan, SaysWhichCutDoesNotApplyWhyAndKeepsThoseBefore) {
    const Scan scan = centred(shapes::joined({shapes::ball({0, 0, 0}, 10, 12), shapes::ball({40, 0, 0}, 12, 12)}));
    const Plan plan = plan_of(scan, 3);
    Plan lost = plan;
    lost.cuts[2].inside = Vec3{500, 0, 0};
    Replayed r = replayed(lost, scan);
    EXPECT_FALSE(r.replay.applies);
    EXPECT_NE(r.replay.why.find("cut 3 on piece " + lost.cuts[2].piece), std::string::npos) << r.replay.why;
    EXPECT_NE(r.replay.why.find("no piece is there"), std::string::npos) << r.replay.why;
    EXPECT_EQ(r.segmentation.cuts.size(), 2U);

    Plan other_volume = plan;
    other_volume.cuts[1].volume_mm3 *= 1.2;
    r = replayed(other_volume, scan);
    EXPECT_NE(r.replay.why.find("its volume differs"), std::string::npos) << r.replay.why;
    EXPECT_EQ(r.segmentation.cuts.size(), 1U);

    Plan misses = plan;
    misses.cuts[0].from_centre = 1000;
    r = replayed(misses, scan);
    EXPECT_NE(r.replay.why.find("misses"), std::string::npos) << r.replay.why;
    EXPECT_TRUE(r.segmentation.cuts.empty());

    Plan other_count = plan;
    other_count.cuts[0].makes_mm3.push_back(5);
    r = replayed(other_count, scan);
    EXPECT_NE(r.replay.why.find("it makes 2 pieces here"), std::string::npos) << r.replay.why;
    EXPECT_TRUE(r.segmentation.cuts.empty()) << "a cut that does not apply is not made";
}

TEST(ReplayPlan, AnotherSpecimenUnitOrFrameIsSeenBeforeAnythingIsCut) {
    const Scan scan = centred(shapes::torus({0, 0, 0}, 40, 12));
    const Plan plan = plan_of(scan, 1);
    const auto words = [&](const Scan& other, double scale = 1) {
        ScanSource source = planned::source_of(other.mesh, other.centre);
        source.scale = scale;
        return misfit(plan, source, other.mesh);
    };
    EXPECT_EQ(words(scan), "");
    EXPECT_NE(words(centred(shapes::torus({30, 0, 0}, 40, 12))).find("another frame"), std::string::npos);
    EXPECT_NE(words(centred(shapes::torus({0, 0, 0}, 400, 120))).find("boxes"), std::string::npos);
    EXPECT_NE(words(centred(shapes::box({-52, -52, -12}, {52, 52, 12}))).find("volumes"), std::string::npos);
    EXPECT_NE(words(scan, 2).find("scale"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
