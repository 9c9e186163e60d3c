#include "cam/job/sheet/preview.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>

#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/some_job.h"

namespace qchopper {
namespace {

using namespace test_pieces;

tinygltf::Model load(const Bytes& bytes) {
    tinygltf::Model model;
    std::string errors;
    std::string warnings;
    EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromMemory(&model, &errors, &warnings, bytes.data(),
                                                          static_cast<unsigned>(bytes.size())))
        << errors;
    EXPECT_EQ(errors + warnings, "");
    return model;
}

// v + 2 w (q x v) + 2 q x (q x v), after scaling: what a viewer does with the root node.
Vec3 seen(const tinygltf::Node& node, Vec3 p) {
    const Vec3 q{node.rotation[0], node.rotation[1], node.rotation[2]};
    const Vec3 v{node.scale[0] * p.x, node.scale[1] * p.y, node.scale[2] * p.z};
    return v + 2 * node.rotation[3] * cross(q, v) + 2 * cross(q, cross(q, v));
}

TEST(Preview, AViewerSeesMetresWithTheTopUp) {
    const JobInput input = some_job();
    const tinygltf::Model model = load(parse_job(job_file(input), "AB.qjob").files.at("preview.glb"));
    ASSERT_EQ(model.nodes.size(), 2U);
    const Vec3 top = seen(model.nodes[0], {0, 0, input.setup.box.max.z});
    EXPECT_NEAR(top.y, input.setup.box.max.z / 1000, 1e-12);
    EXPECT_NEAR(top.x, 0, 1e-12);
    EXPECT_NEAR(top.z, 0, 1e-12);
    const Vec3 front = seen(model.nodes[0], {0, -1, 0});
    EXPECT_NEAR(front.z, 0.001, 1e-12) << "the front of the piece faces the viewer";
}

TEST(Preview, TheNodeIsNamedAndCarriesNotes) {
    const JobInput input = some_job();
    const PreviewNotes notes{"AB", "0.1.0", 2, 5, 4, false};
    const tinygltf::Model model = load(preview_glb(*input.piece.mesh, notes));
    EXPECT_EQ(model.nodes[1].name, "piece/AB");
    const tinygltf::Value inner = model.nodes[1].extras.Get("qchopper");
    EXPECT_EQ(inner.Get("piece").Get<std::string>(), "AB");
    EXPECT_EQ(inner.Get("piece_no").GetNumberAsInt(), 2);
    EXPECT_EQ(inner.Get("base").GetNumberAsInt(), 4);
    EXPECT_FALSE(inner.Get("fits").Get<bool>());
}

TEST(Preview, HoldsEveryTriangleOnceCapsApart) {
    const JobInput input = some_job();
    const TriangleMesh& mesh = *input.piece.mesh;
    const tinygltf::Model model = load(preview_glb(mesh, {"AB", "0.1.0", 2, 5, 4, true}));
    ASSERT_EQ(model.meshes[0].primitives.size(), 2U);
    std::size_t caps = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) caps += cap_of(mesh, t) != no_cap ? 1 : 0;
    const auto corners = [&](int k) { return model.accessors[model.meshes[0].primitives[k].indices].count; };
    EXPECT_EQ(corners(0), 3 * (mesh.triangles.size() - caps));
    EXPECT_EQ(corners(1), 3 * caps);
    const tinygltf::Accessor& positions = model.accessors[model.meshes[0].primitives[0].attributes.at("POSITION")];
    EXPECT_EQ(positions.count, mesh.points.size());
    const Box box = bounds(mesh);
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(positions.minValues[axis], static_cast<double>(static_cast<float>(box.min[axis])));
        EXPECT_EQ(positions.maxValues[axis], static_cast<double>(static_cast<float>(box.max[axis])));
    }
}

}  // namespace
}  // namespace qchopper
