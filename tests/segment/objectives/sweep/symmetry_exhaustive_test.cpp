// The symmetry plane against all planes in steps of one degree: none of them has a better score.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "segment/import/import_scan.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/mirror_matches.h"
#include "segment/objectives/symmetry_plane.h"
#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;

struct Scored {
    Plane plane;
    double score = 0;
};

// Every n-th point of each plane; so many of the best stay.
void keep_best(std::vector<Scored>& planes, const MirrorMatches& mirror, std::size_t every, std::size_t kept) {
    parallel_for(0, planes.size(), [&](std::size_t i) { planes[i].score = mirror.score(planes[i].plane, {every, 1}); });
    std::stable_sort(planes.begin(), planes.end(), [](const Scored& a, const Scored& b) { return a.score < b.score; });
    planes.resize(std::min(kept, planes.size()));
}

// Each with `many` more on either side.
std::vector<Scored> shifted(const std::vector<Scored>& planes, int many, double step) {
    std::vector<Scored> all;
    for (const Scored& s : planes) {
        for (int k = -many; k <= many; ++k) all.push_back({{s.plane.normal, s.plane.offset + k * step}});
    }
    return all;
}

// Normals of all degrees of elevation and, at each, of azimuth.
std::vector<Scored> through(Vec3 centre) {
    std::vector<Scored> planes;
    for (int elevation = 0; elevation <= 90; ++elevation) {
        const double level = std::cos(elevation * degree);
        const int round = std::max(1, static_cast<int>(std::ceil(360 * level)));
        const int many = elevation == 0 ? round / 2 : round;  // opposite normals are those of one plane
        for (int a = 0; a < many; ++a) {
            const double azimuth = 2 * std::numbers::pi * a / round;
            const Vec3 normal{level * std::cos(azimuth), level * std::sin(azimuth), std::sin(elevation * degree)};
            planes.push_back({canonical({normal, dot(normal, centre)})});
        }
    }
    return planes;
}

void expect_no_better_plane(const TriangleMesh& scan, const std::string& name) {
    SCOPED_TRACE(name);
    std::vector<Vec3> points;
    Vec3 sum;
    for (const SurfaceSample& s :
         symmetry_samples(scan, SymmetryOptions{}.points, SymmetryOptions{}.min_solid_area).sample) {
        points.push_back(s.point);
        sum = sum + s.point;
    }
    const Vec3 centre = (1 / static_cast<double>(points.size())) * sum;
    double arm2 = 0;  // mean square of the distances from the centre
    for (const Vec3& p : points) arm2 += dot(p - centre, p - centre) / static_cast<double>(points.size());
    const double shift = degree * std::sqrt(arm2);  // what a degree's turn moves a point, about
    const MirrorMatches mirror(std::move(points));
    std::vector<Scored> planes = shifted(through(centre), 1, 5 * shift);
    keep_best(planes, mirror, 60, 1'500);
    planes = shifted(planes, 2, 1.5 * shift);
    keep_best(planes, mirror, 20, 300);
    keep_best(planes, mirror, 1, 1);
    const std::optional<SymmetryPlane> found = symmetry_plane(scan);
    ASSERT_TRUE(found);
    const double turn = std::acos(std::min(1.0, std::abs(dot(found->plane.normal, planes[0].plane.normal)))) / degree;
    constexpr double alike = 1.001;  // both end with a step
    EXPECT_LE(found->score_mm, alike * planes[0].score) << turn << " degrees away";
}

// Small shapes without symmetry, or with one part that hides it.
TEST(SymmetryExhaustive, OfSpecimensAndOfWhatLacksAPart) {
    SampleOptions options;
    options.faces = 10'000;
    const TriangleMesh skull = sample(Specimen::skull, options);
    for (const Specimen specimen : {Specimen::vertebra, Specimen::femur}) {
        expect_no_better_plane(shapes::rotated(sample(specimen, options), {1, 2, 3}, 0.9), "specimen");
    }
    expect_no_better_plane(shapes::rotated(skull, {3, -1, 2}, 2.1), "skull");
    const Vec3 size = bounds(skull).size();
    // Parts beside it that have no mirror image.
    TriangleMesh parts = skull;
    for (int i = 0; i < 8; ++i) {
        const Vec3 at{0.5 * size.x + 30.0 * i, -0.1 * size.y * i, 0.2 * size.z};
        parts = shapes::joined({parts, shapes::ball(bounds(skull).centre() + at, 12 + 3 * i, 8)});
    }
    expect_no_better_plane(shapes::rotated(parts, {1, 1, -2}, 0.6), "parts");
}

TEST(SymmetryExhaustive, OfRealScans) {
    const std::filesystem::path folder = QCHOPPER_MESHES;
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not here";
    ImportOptions options;
    options.mm_per_unit = 1;
    for (const char* name : {"skull_scan_25k.stl", "femur_3548.stl", "bunny_bun_zipper.ply", "gorilla_skull_159k.ply",
                             "igea_268k.ply", "ct_head_371k.ply", "nasty/cgal_bones.off", "nasty/cgal_cow.off"}) {
        if (!std::filesystem::exists(folder / name)) continue;
        expect_no_better_plane(import_scan(folder / name, options).mesh, name);
    }
}

}  // namespace
}  // namespace qchopper
