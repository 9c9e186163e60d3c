// Small things that the tests of this folder share.

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/files/file.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

inline Bytes bytes_of(std::string_view text) {
    return {text.begin(), text.end()};
}

inline std::filesystem::path real_mesh(const std::string& name) {
    return std::filesystem::path(QCHOPPER_MESHES) / name;
}

// Leaves the test as skipped where the real meshes are not installed.
#define NEEDS_MESH(name) \
    if (!std::filesystem::exists(real_mesh(name))) GTEST_SKIP() << real_mesh(name) << " is not here"

// The text of the InputError (mesh) that the action throws; a failed test if it throws none.
template <class Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::mesh) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "nothing was refused";
    return {};
}

// The mesh as a text PLY, one corner per word.
inline std::string ascii_ply(const TriangleMesh& mesh) {
    std::string text = "ply\nformat ascii 1.0\ncomment made by a test\nelement vertex " +
                       std::to_string(mesh.points.size()) +
                       "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                       std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& p : mesh.points) {
        text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    }
    for (const Triangle& t : mesh.triangles) {
        text += "3 " + std::to_string(t[0]) + " " + std::to_string(t[1]) + " " + std::to_string(t[2]) + "\n";
    }
    return text;
}

inline std::string ascii_stl(const TriangleMesh& mesh) {
    std::string text = "solid test\n";
    for (const Triangle& t : mesh.triangles) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (const std::uint32_t corner : t) {
            const Vec3 p = mesh.points[corner];
            text += "  vertex " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
        }
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid test\n";
}

}  // namespace qchopper
