// PLY: values are appended in the order of the header. STL: triangles are written at fixed offsets. O(points +
// triangles); the file is made in memory.

#include "segment/io/write_mesh.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string>
#include <string_view>

namespace qchopper {
namespace {

template <class Unsigned>
void put(Bytes& bytes, Unsigned value) {
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

std::string header(const TriangleMesh& mesh, const PlyFaces* faces) {
    std::string text = "ply\nformat binary_little_endian 1.0\ncomment millimetres\n";
    text += "element vertex " + std::to_string(mesh.points.size()) + "\n";
    text += "property double x\nproperty double y\nproperty double z\n";
    text += "element face " + std::to_string(mesh.triangles.size()) + "\n";
    text += "property list uchar uint vertex_indices\n";
    if (!mesh.cap_of.empty()) text += "property int cap\n";
    if (faces != nullptr) {
        text += "property uint region\n";
        text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }
    return text + "end_header\n";
}

void put_u32(std::uint8_t* at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

void put_vector(std::uint8_t* at, Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) {
        // + 0.0F turns a negative zero into a positive one: equal meshes have equal bytes
        put_u32(at + 4 * axis, std::bit_cast<std::uint32_t>(static_cast<float>(v[axis]) + 0.0F));
    }
}

// `faces` may be null.
Bytes ply(const TriangleMesh& mesh, const PlyFaces* faces) {
    assert(is_consistent(mesh));
    const std::string text = header(mesh, faces);
    const std::size_t per_face = 13U + (mesh.cap_of.empty() ? 0 : 4) + (faces == nullptr ? 0 : 7);
    Bytes bytes;
    bytes.reserve(text.size() + 24 * mesh.points.size() + per_face * mesh.triangles.size());
    bytes.assign(text.begin(), text.end());
    for (const Vec3& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) put(bytes, std::bit_cast<std::uint64_t>(p[axis]));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        put(bytes, std::uint8_t{3});
        for (const std::uint32_t corner : mesh.triangles[t]) put(bytes, corner);
        if (!mesh.cap_of.empty()) put(bytes, std::bit_cast<std::uint32_t>(mesh.cap_of[t]));
        if (faces == nullptr) continue;
        put(bytes, faces->region[t]);
        for (const std::uint8_t channel : faces->colour[t]) put(bytes, channel);
    }
    return bytes;
}

}  // namespace

Bytes to_ply(const TriangleMesh& mesh) {
    return ply(mesh, nullptr);
}

Bytes to_ply(const TriangleMesh& mesh, const PlyFaces& faces) {
    assert(faces.region.size() == mesh.triangles.size() && faces.colour.size() == mesh.triangles.size());
    return ply(mesh, &faces);
}

Bytes to_stl(const TriangleMesh& mesh) {
    constexpr std::string_view header = "qchopper, binary STL, millimetres";
    assert(is_consistent(mesh));
    Bytes bytes(84 + 50 * mesh.triangles.size());
    std::copy(header.begin(), header.end(), bytes.begin());
    put_u32(&bytes[80], static_cast<std::uint32_t>(mesh.triangles.size()));
    std::uint8_t* at = bytes.data() + 84;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t, at += 50) {
        put_vector(at, normalized(area_vector(mesh, t)));
        for (std::size_t corner = 0; corner < 3; ++corner) {
            put_vector(at + 12 + 12 * corner, mesh.points[mesh.triangles[t][corner]]);
        }
    }
    assert(at == bytes.data() + bytes.size());
    return bytes;
}

void check_mesh_name(const std::filesystem::path& file) {
    if (file.extension() == ".stl" || file.extension() == ".ply") return;
    throw InputError(InputFault::use, file.string() + " ends neither in .ply nor in .stl", "name a .ply file");
}

void write_mesh(const std::filesystem::path& file, const TriangleMesh& mesh) {
    check_mesh_name(file);
    write_file(file, file.extension() == ".stl" ? to_stl(mesh) : to_ply(mesh));
}

}  // namespace qchopper
