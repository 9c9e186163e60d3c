#include "segment/io/write_glb.h"

#include <gtest/gtest.h>

#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

GlbScene scene_of(const std::vector<TriangleMesh>& meshes, const std::vector<Vec3>& origins) {
    GlbScene scene{"qchopper test", "scene", {}};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        GlbNode node;
        node.name = "piece/" + std::string(1, static_cast<char>('A' + i));
        node.mesh = &meshes[i];
        node.origin = origins[i];
        node.notes = {{"id", std::string("A")}, {"fits", true}, {"share", 0.5}, {"step", 3}};
        scene.nodes.push_back(node);
    }
    return scene;
}

// A reader that applies the nodes sees metres with Y up: x stays, z becomes y, y becomes -z.
TEST(WriteGlb, ReadingItBackGivesMetresWithTheTopUp) {
    const std::vector<TriangleMesh> meshes{shapes::box({0, 0, 0}, {100, 200, 400}), shapes::ball({0, 0, 0}, 50)};
    const RawMesh back = parse_mesh(to_glb(scene_of(meshes, {{1000, 0, 0}, {0, 3000, 0}})), "a.glb");
    EXPECT_EQ(back.mesh.triangles.size(), meshes[0].triangles.size() + meshes[1].triangles.size());
    ASSERT_TRUE(back.mm_per_unit);
    const double mm = *back.mm_per_unit;
    EXPECT_NEAR(volume_mm3(back.mesh) * mm * mm * mm, volume_mm3(meshes[0]) + volume_mm3(meshes[1]), 10);
    const Vec3 size = mm * bounds(back.mesh).size();
    EXPECT_NEAR(std::max({size.x, size.y, size.z}), 3050, 0.01);
}

TEST(WriteGlb, FarFromTheOriginNothingIsLost) {
    const std::vector<TriangleMesh> meshes{shapes::ball({0, 0, 0}, 0.5)};
    const Bytes bytes = to_glb(scene_of(meshes, {{3000, 3000, 3000}}));
    const std::string text(bytes.begin(), bytes.end());
    EXPECT_NE(text.find("\"translation\":[3000"), std::string::npos);
    EXPECT_NE(text.find("piece/A"), std::string::npos);
}

TEST(WriteGlb, KeysAreAnAnimationOfTheNodesThatHaveThem) {
    const std::vector<TriangleMesh> meshes{shapes::box({0, 0, 0}, {100, 200, 400}), shapes::ball({0, 0, 0}, 50)};
    GlbScene scene = scene_of(meshes, {{1000, 0, 0}, {0, 3000, 0}});
    const auto text_of = [](const Bytes& bytes) { return std::string(bytes.begin(), bytes.end()); };
    EXPECT_EQ(text_of(to_glb(scene)).find("\"animations\""), std::string::npos);
    scene.nodes[1].keys = {{0, {0, 0, 200}}, {2, {0, 0, 0}}};
    const Bytes bytes = to_glb(scene);
    const std::string text = text_of(bytes);
    EXPECT_NE(text.find("\"animations\""), std::string::npos);
    EXPECT_NE(text.find("\"node\":2"), std::string::npos);  // after the root and the first
    EXPECT_NE(text.find("\"max\":[2"), std::string::npos);
    const RawMesh back = parse_mesh(bytes, "a.glb");  // at rest it is in its place
    const double mm = *back.mm_per_unit;
    const Vec3 size = mm * bounds(back.mesh).size();
    EXPECT_NEAR(std::max({size.x, size.y, size.z}), 3050, 0.01);
}

TEST(WriteGlb, SameSceneSameBytes) {
    const std::vector<TriangleMesh> meshes{shapes::torus({0, 0, 0}, 50, 20)};
    EXPECT_EQ(to_glb(scene_of(meshes, {{1, 2, 3}})), to_glb(scene_of(meshes, {{1, 2, 3}})));
}

}  // namespace
}  // namespace qchopper
