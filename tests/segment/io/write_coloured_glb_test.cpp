// Coloured meshes and lines as tinygltf reads them back, and as Khronos' validator judges them.

#include "segment/io/write_coloured_glb.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "base/files/file.h"
#include "segment/io/read_mesh.h"
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
    EXPECT_EQ(warnings, "");
    return model;
}

struct Scene {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 30, 20});
    std::vector<std::uint8_t> colour_of = std::vector<std::uint8_t>(mesh.triangles.size(), 2);
    ColouredGlb glb() const {
        return {"qchopper test",
                "piece",
                &mesh,
                colour_of,
                {{"first", {1, 0, 0}}, {"second", {0, 1, 0}}, {"third", {0, 0, 1}}},
                {{"path/1",
                  {"orientation 1", {1, 1, 0}},
                  {{{0, 0, 50}, {10, 0, 50}, {10, 5, 50}}, {{0, 0, 60}, {0, 9, 60}}}},
                 {"path/2", {"orientation 2", {0, 1, 1}}, {}}}};
    }
};

TEST(WriteColouredGlb, APrimitivePerColourThatIsUsedAndPerGroupOfLines) {
    Scene scene;
    scene.colour_of[3] = 0;
    scene.colour_of[5] = 0;
    const tinygltf::Model model = load(to_glb(scene.glb()));
    ASSERT_EQ(model.meshes.size(), 2U) << "the group without a line is left out";
    ASSERT_EQ(model.meshes[0].primitives.size(), 2U);
    const auto count = [&](const tinygltf::Primitive& p) {
        return model.accessors[static_cast<std::size_t>(p.indices)].count;
    };
    EXPECT_EQ(count(model.meshes[0].primitives[0]), 6U);
    EXPECT_EQ(count(model.meshes[0].primitives[1]), 3 * (scene.mesh.triangles.size() - 2));
    const auto material = [&](const tinygltf::Primitive& p) {
        return model.materials[static_cast<std::size_t>(p.material)].name;
    };
    EXPECT_EQ(material(model.meshes[0].primitives[0]), "first");
    EXPECT_EQ(material(model.meshes[0].primitives[1]), "third");
    const tinygltf::Primitive& lines = model.meshes[1].primitives[0];
    EXPECT_EQ(lines.mode, TINYGLTF_MODE_LINE);
    EXPECT_EQ(count(lines), 6U) << "two and one segments";
    EXPECT_EQ(material(lines), "orientation 1");
    EXPECT_EQ(model.nodes.size(), 3U);
    EXPECT_EQ(to_glb(scene.glb()), to_glb(scene.glb()));
}

TEST(WriteColouredGlb, MetresWithTheTopUp) {
    const Scene scene;
    const RawMesh back = parse_mesh(to_glb(scene.glb()), "a.glb");
    EXPECT_EQ(back.mesh.triangles.size(), scene.mesh.triangles.size());
    double top = 0;
    for (const Vec3& p : back.mesh.points) top = std::max(top, p.z);  // the reader has Z up again
    EXPECT_NEAR(top, 0.020, 1e-7);
}

// Skipped without the validator: scripts/validate_glb FILE.glb fetches it.
TEST(WriteColouredGlb, KhronosValidatorFindsNoError) {
    const auto judged = [](const Bytes& bytes) {
        const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / "coloured.glb";
        write_file(file, bytes);
        std::ostringstream command;
        command << QCHOPPER_SOURCE_DIR "/scripts/validate_glb --no-fetch '" << file.string() << "' >/dev/null 2>&1";
        const int status = std::system(command.str().c_str());
        std::filesystem::remove(file);
        return WEXITSTATUS(status);
    };
    Bytes bytes = to_glb(Scene().glb());
    const int code = judged(bytes);
    if (code == 77) GTEST_SKIP() << "Khronos' validator is not there: scripts/validate_glb FILE.glb fetches it";
    EXPECT_EQ(code, 0);
    const std::string mode = "\"mode\":1";
    const auto at = std::search(bytes.begin(), bytes.end(), mode.begin(), mode.end());
    ASSERT_NE(at, bytes.end());
    *(at + 7) = '9';
    EXPECT_EQ(judged(bytes), 1) << "a primitive of mode 9";
}

}  // namespace
}  // namespace qchopper
