// The viewer's file of a job: colours by range, lines by orientation, and bounds of its size.

#include "app/pictures/carved_view.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <map>

#include "app/pictures/deviation_colours.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

tinygltf::Model load(const Bytes& bytes) {
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(),
                                                          static_cast<unsigned>(bytes.size())))
        << errors;
    return model;
}

// Triangles by the name of their colour.
std::map<std::string, std::size_t> faces_of(const tinygltf::Model& model) {
    std::map<std::string, std::size_t> faces;
    for (const tinygltf::Primitive& p : model.meshes[0].primitives) {
        faces[model.materials[static_cast<std::size_t>(p.material)].name] +=
            model.accessors[static_cast<std::size_t>(p.indices)].count / 3;
    }
    return faces;
}

TEST(CarvedView, ColoursTheSurfaceByItsDeviationAndThePathByItsOrientation) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 30, 20}, 2);
    std::vector<float> deviation(mesh.triangles.size(), 0.1F);
    deviation[0] = -0.4F;
    deviation[1] = 2;
    std::vector<bool> given_up(mesh.triangles.size(), false);
    given_up[2] = true;
    const CarvedView view =
        carved_view({"qchopper test",
                     &mesh,
                     deviation,
                     given_up,
                     {{0, {{{0, 0, 30}, {5, 0, 30}}}}, {2, {{{0, 0, 40}, {5, 5, 40}, {9, 0, 40}}}}}});
    const tinygltf::Model model = load(view.glb);
    const std::map<std::string, std::size_t> faces = faces_of(model);
    EXPECT_EQ(faces.at("gouge > 0.25"), 1U);
    EXPECT_EQ(faces.at("to 3 mm"), 1U);
    EXPECT_EQ(faces.at("given up"), 1U);
    EXPECT_EQ(faces.at("to 0.3"), mesh.triangles.size() - 3);
    ASSERT_EQ(model.nodes.size(), 4U);
    EXPECT_EQ(model.nodes[2].name, "path/orientation 1");
    EXPECT_EQ(model.nodes[3].name, "path/orientation 3");
    EXPECT_EQ(view.path_tolerance, 0);
    EXPECT_EQ(view.mesh_shift, 0);
    EXPECT_EQ(view.points, 5U);
}

// A spiral of 800,000 points about a ball of as many faces.
TEST(CarvedView, IsBoundedAndSaysByHowMuchItIsOff) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 100, 500);
    ASSERT_GT(mesh.triangles.size(), carved_view_faces);
    std::vector<float> deviation(mesh.triangles.size(), 0.1F);
    std::vector<Vec3> spiral;
    for (int i = 0; i < 800'000; ++i) {
        const double angle = i * 0.01;
        const double radius = 50 + 0.0001 * i;
        spiral.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.001 * i});
    }
    const CarvedView view = carved_view({"qchopper test", &mesh, deviation, {}, {{0, {spiral}}}});
    EXPECT_LE(view.points, carved_view_points);
    EXPECT_LE(view.faces, carved_view_faces * 6 / 5);
    EXPECT_GT(view.path_tolerance, 0);
    EXPECT_LT(view.path_tolerance, 1);
    EXPECT_GT(view.mesh_shift, 0);
    EXPECT_LT(view.glb.size(), 12'000'000U);
}

TEST(CarvedView, ThinnedLinesStayWithinTheToleranceAndKeepTheirEnds) {
    std::vector<Vec3> wave;
    for (int i = 0; i <= 1000; ++i) wave.push_back({0.1 * i, std::sin(0.05 * i), 0});
    const std::vector<Vec3> kept = thinned(wave, 0.05);
    EXPECT_LT(kept.size(), 100U);
    EXPECT_EQ(kept.front(), wave.front());
    EXPECT_EQ(kept.back(), wave.back());
    for (const Vec3& p : wave) {
        double nearest = 1e9;
        for (std::size_t i = 1; i < kept.size(); ++i) {
            const Vec3 along = kept[i] - kept[i - 1];
            const double t = std::clamp(dot(p - kept[i - 1], along) / dot(along, along), 0.0, 1.0);
            nearest = std::min(nearest, norm(p - (kept[i - 1] + t * along)));
        }
        EXPECT_LE(nearest, 0.05 + 1e-9);
    }
    EXPECT_EQ(thinned({{0, 0, 0}, {1, 0, 0}}, 1).size(), 2U);
}

}  // namespace
}  // namespace qchopper
