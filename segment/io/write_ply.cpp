// Values are appended in the order of the header. O(points + triangles); the file is made in memory.

#include "segment/io/write_ply.h"

#include <bit>
#include <cassert>
#include <string>

namespace qchopper {
namespace {

template <class Unsigned>
void put(Bytes& bytes, Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::string header(const TriangleMesh& mesh) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment millimetres\n";
    text += "element vertex " + std::to_string(mesh.points.size()) + "\n";
    text += "property double x\nproperty double y\nproperty double z\n";
    text += "element face " + std::to_string(mesh.triangles.size()) + "\n";
    text += "property list uchar uint vertex_indices\n";
    if (!mesh.cap_of.empty()) text += "property int cap\n";
    return text + "end_header\n";
}

}  // namespace

Bytes to_ply(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    const std::string text = header(mesh);
    Bytes bytes;
    bytes.reserve(text.size() + 24 * mesh.points.size() + (mesh.cap_of.empty() ? 13 : 17) * mesh.triangles.size());
    bytes.assign(text.begin(), text.end());
    for (const Vec3& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) put(bytes, std::bit_cast<std::uint64_t>(p[axis]));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        put(bytes, std::uint8_t{3});
        for (const std::uint32_t corner : mesh.triangles[t]) put(bytes, corner);
        if (!mesh.cap_of.empty()) put(bytes, std::bit_cast<std::uint32_t>(mesh.cap_of[t]));
    }
    return bytes;
}

}  // namespace qchopper
