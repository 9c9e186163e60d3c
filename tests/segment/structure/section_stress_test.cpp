#include "segment/structure/section_stress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <random>

#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The area in which the plane crosses the cube around the origin: its corners on the edges, sorted around their middle.
double clipped_area(Vec3 n, double distance) {
    std::vector<Vec3> corner;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const double a : {-0.5, 0.5}) {
            for (const double b : {-0.5, 0.5}) {
                if (n[axis] == 0) continue;
                Vec3 p;
                p[u] = a;
                p[v] = b;
                p[axis] = (distance - n[u] * a - n[v] * b) / n[axis];
                if (std::abs(p[axis]) <= 0.5) corner.push_back(p);
            }
        }
    }
    if (corner.size() < 3) return 0;
    Vec3 middle;
    for (const Vec3 p : corner) middle = middle + (1.0 / static_cast<double>(corner.size())) * p;
    const Vec3 u = normalized(corner[0] - middle);
    const Vec3 v = cross(n, u);
    std::sort(corner.begin(), corner.end(), [&](Vec3 a, Vec3 b) {
        return std::atan2(dot(v, a - middle), dot(u, a - middle)) < std::atan2(dot(v, b - middle), dot(u, b - middle));
    });
    Vec3 sum;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        sum = sum + 0.5 * cross(corner[i] - middle, corner[(i + 1) % corner.size()] - middle);
    }
    return dot(sum, n);
}

std::vector<Vec3> normals() {
    std::vector<Vec3> all{
        {0, 0, 1}, {1, 0, 0}, normalized({1, 1, 0}), normalized({1, 0.001, 0}), normalized({3, 2, 1})};
    std::mt19937 random(3);
    std::normal_distribution<double> value;
    for (int i = 0; i < 12; ++i) all.push_back(normalized({value(random), value(random), value(random)}));
    return all;
}

// The sections of one voxel of side 1 around the origin.
std::vector<SectionStress> cube_sections(Vec3 normal, const std::vector<double>& distances) {
    StressedModel model;
    model.grid.corner = {-0.5, -0.5, -0.5};
    model.grid.count = {1, 1, 1};
    model.strength_mpa = 1;
    model.voxels = {0};
    model.stress.resize(1);
    model.is_thick = {1};
    StressedPart part;
    part.neighbours = voxel_neighbours(model.grid, model.voxels);
    part.voxels = {0};
    part.model = std::make_shared<const StressedModel>(std::move(model));
    return section_stress(part, normal, distances);
}

TEST(SectionStress, TheSectionOfACubeIsThatOfThePolygon) {
    std::vector<double> distances;
    for (int i = -1000; i < 1000; ++i) distances.push_back((i + 0.5) * 0.001);
    for (const Vec3 n : normals()) {
        double volume = 0;
        const std::vector<SectionStress> sections = cube_sections(n, distances);
        for (std::size_t i = 0; i < distances.size(); ++i) {
            const double d = distances[i];
            const double area = sections[i].area_mm2;
            EXPECT_NEAR(area, clipped_area(n, d), 1e-9) << n.x << ' ' << n.y << ' ' << n.z << ' ' << d;
            volume += 0.001 * area;
        }
        EXPECT_NEAR(volume, 1, 1e-3);
    }
    EXPECT_EQ(cube_sections({0, 0, 1}, {0.5})[0].area_mm2, 0.5) << "a plane in a face";
    EXPECT_NEAR(cube_sections(normalized({1e-6, 1e-5, 1}), {0.2})[0].area_mm2, 1, 1e-9);
}

// One plane, one voxel and one section after the other.
SectionStress reference(const StressedModel& m, const std::vector<std::uint32_t>& voxels, Vec3 n, double offset) {
    const VoxelGrid& g = m.grid;
    const Vec3 across{dot(g.axis[0], n), dot(g.axis[1], n), dot(g.axis[2], n)};
    std::vector<std::pair<std::uint32_t, double>> crossed;  // position in the model's list, area
    for (const std::uint32_t v : voxels) {
        const double area = clipped_area(across, (offset - dot(n, g.centre(m.voxels[v]))) / g.size);
        if (area > 0) crossed.emplace_back(v, area);
    }
    SectionStress result;
    std::vector<bool> is_done(crossed.size(), false);
    for (std::size_t first = 0; first < crossed.size(); ++first) {
        if (is_done[first]) continue;
        double area = 0;
        double integral = 0;
        double thick = 0;
        std::queue<std::size_t> next({first});
        is_done[first] = true;
        for (; !next.empty(); next.pop()) {
            const auto [v, part] = crossed[next.front()];
            const Stress& s = m.stress[v];
            const Vec3 t{s.xx * n.x + s.xy * n.y + s.zx * n.z, s.xy * n.x + s.yy * n.y + s.yz * n.z,
                         s.zx * n.x + s.yz * n.y + s.zz * n.z};
            area += part;
            integral += part * (std::max(dot(n, t), 0.0) + norm(t - dot(n, t) * n)) / m.strength_mpa;
            thick += m.is_thick[v] != 0 ? part : 0;
            for (std::size_t i = 0; i < crossed.size(); ++i) {
                if (is_done[i] || std::abs(norm(g.centre(m.voxels[crossed[i].first]) - g.centre(m.voxels[v])) -
                                           g.size) > 1e-6 * g.size) {
                    continue;
                }
                is_done[i] = true;
                next.push(i);
            }
        }
        ++result.sections;
        result.value += integral / area;
        result.area_mm2 += area * g.size * g.size;
        result.too_coarse += 2 * thick < area ? 1 : 0;
    }
    return result;
}

std::shared_ptr<const StressedModel> stressed(const TriangleMesh& mesh, double voxel_mm) {
    StructureOptions o;
    o.up = {0.1, 0.2, 1};
    o.density_kg_per_m3 = 100;
    o.strength_mpa = 0.5;
    o.voxel_mm = voxel_mm;
    return std::make_shared<const StressedModel>(stress_of(mesh, o, {}));
}

TEST(SectionStress, OfAllPlanesOfANormalIsThatOfThePlainReference) {
    const TriangleMesh shape = shapes::joined({shapes::torus({0, 0, 0}, 30, 9), shapes::ball({60, 0, 0}, 11)});
    const auto model = stressed(shape, 3.7);
    const StressedPart part = stressed_part(model, shape);
    ASSERT_EQ(part.voxels.size(), model->voxels.size());
    std::uint32_t max_sections = 0;
    for (const Vec3 n : normals()) {
        std::vector<double> offsets;
        for (int i = -20; i <= 40; ++i) offsets.push_back(i * 1.8713);
        const std::vector<SectionStress> got = section_stress(part, n, offsets);
        ASSERT_EQ(got.size(), offsets.size());
        for (std::size_t i = 0; i < offsets.size(); ++i) {
            const SectionStress wanted = reference(*model, part.voxels, n, offsets[i]);
            EXPECT_NEAR(got[i].value, wanted.value, 1e-9 * wanted.value);
            EXPECT_NEAR(got[i].area_mm2, wanted.area_mm2, 1e-9 * wanted.area_mm2);
            EXPECT_EQ(got[i].sections, wanted.sections);
            EXPECT_EQ(got[i].too_coarse, wanted.too_coarse);
            max_sections = std::max(max_sections, got[i].sections);
        }
    }
    EXPECT_GE(max_sections, 3U);
}

TEST(SectionStress, AHangingBarHasItsWeightBelowAsTension) {
    // A gate: two posts and a lintel, and a bar that hangs from its middle.
    const TriangleMesh gate =
        shapes::joined({shapes::box({0, 0, 0}, {20, 20, 100}), shapes::box({180, 0, 0}, {200, 20, 100}),
                        shapes::box({0, 0, 100}, {200, 20, 120}), shapes::box({90, 0, 30}, {110, 20, 100})});
    StructureOptions o;
    o.up = {0, 0, 1};
    o.density_kg_per_m3 = 500;
    o.strength_mpa = 2;
    o.voxel_mm = 5;
    const auto model = std::make_shared<const StressedModel>(stress_of(gate, o, {}));
    const TriangleMesh bar = shapes::box({90, 0, 30}, {110, 20, 100});
    const StressedPart part = stressed_part(model, bar);
    const SectionStress s = section_stress(part, {0, 0, 1}, std::vector<double>{62.4})[0];
    EXPECT_EQ(s.sections, 1U);
    EXPECT_NEAR(s.area_mm2, 400, 1e-9);
    EXPECT_EQ(s.too_coarse, 0U);
    EXPECT_NEAR(s.value, 32.5 * 500 * 9.80665e-9 / 2, 0.02 * s.value) << "half of its voxel's weight is below";
    const SectionStress post = section_stress(stressed_part(model, shapes::box({0, 0, 0}, {20, 20, 100})), {0, 0, 1},
                                              std::vector<double>{52.0})[0];
    EXPECT_GT(s.value, 0);
    EXPECT_GT(post.value, 0) << "it is bent";
}

TEST(SectionStress, TheVoxelsOfPartsAreThoseOfTheWhole) {
    const TriangleMesh a = shapes::box({0, 0, 0}, {20, 20, 50});
    const TriangleMesh b = shapes::box({0, 0, 50}, {20, 20, 90});
    const auto model = stressed(shapes::box({0, 0, 0}, {20, 20, 90}), 3);
    const std::size_t above = stressed_part(model, b).voxels.size();
    EXPECT_EQ(stressed_part(model, a).voxels.size() + above, model->voxels.size());
    EXPECT_GT(above, 100U);
}

TEST(SectionStress, APlaneBesideHasNoSection) {
    const auto model = stressed(shapes::box({0, 0, 0}, {20, 20, 50}), 5);
    const StressedPart part = stressed_part(model, shapes::box({0, 0, 0}, {20, 20, 50}));
    for (const SectionStress& s : section_stress(part, {1, 0, 0}, std::vector<double>{-30, 70})) {
        EXPECT_EQ(s, SectionStress{});
    }
    EXPECT_TRUE(section_stress(part, {1, 0, 0}, {}).empty());
}

}  // namespace
}  // namespace qchopper
