// Triangles are written at fixed offsets. O(triangles); the file is made in memory.

#include "segment/io/write_stl.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <string_view>

namespace qchopper {
namespace {

void put_u32(std::uint8_t* at, std::uint32_t value) {
    for (std::size_t i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(value >> (8 * i));
}

void put_vector(std::uint8_t* at, Vec3 v) {
    for (int axis = 0; axis < 3; ++axis) {
        // + 0.0F turns a negative zero into a positive one: equal meshes have equal bytes
        put_u32(at + 4 * axis, std::bit_cast<std::uint32_t>(static_cast<float>(v[axis]) + 0.0F));
    }
}

}  // namespace

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

}  // namespace qchopper
