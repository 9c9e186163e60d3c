// Fixed-size records are copied as they lie. O(bytes): one pass, bound by memory.

#include "segment/io/formats/read_plain_ply.h"

#include <array>
#include <bit>
#include <cstring>

#include "base/huge_pages.h"
#include "segment/io/formats/add_face.h"

namespace qchopper {
namespace {

struct VertexLayout {
    std::size_t size = 0;
    std::array<std::size_t, 3> at{};  // bytes from the start of a vertex to x, y and z
    PlyType type = PlyType::f32;      // of all three
};

std::optional<VertexLayout> layout_of(const PlyElement& element) {
    VertexLayout layout;
    std::array<int, 3> times{};
    std::array<PlyType, 3> types{};
    for (const PlyProperty& property : element.properties) {
        if (property.is_list) return std::nullopt;
        if (property.name.size() == 1 && property.name >= "x" && property.name <= "z") {
            const auto axis = static_cast<std::size_t>(property.name[0] - 'x');
            ++times[axis];
            types[axis] = property.type;
            layout.at[axis] = layout.size;
        }
        layout.size += size_of(property.type);
    }
    layout.type = types[0];
    const bool is_one_type = types[1] == types[0] && types[2] == types[0] && !is_integer(types[0]);
    if (times != std::array<int, 3>{1, 1, 1} || !is_one_type) return std::nullopt;
    return layout;
}

bool is_plain_triangle(const PlyElement& element) {
    if (element.properties.size() != 1) return false;
    const PlyProperty& list = element.properties[0];
    const bool has_name = list.name == "vertex_indices" || list.name == "vertex_index";
    const bool is_small_count = list.count_type == PlyType::u8 || list.count_type == PlyType::i8;
    return has_name && list.is_list && is_small_count && (list.type == PlyType::i32 || list.type == PlyType::u32);
}

template <class Value>
Value value_at(const char* at) {
    Value value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// False if a coordinate, or the sum of the three, is not finite: then 0 times it is NaN.
template <class Real>
bool read_points(const VertexLayout& layout, const char* from, std::size_t count, std::vector<Vec3>& points) {
    reserve_huge(points, count);
    double zero = 0;
    for (std::size_t v = 0; v < count; ++v, from += layout.size) {
        const Vec3 p{value_at<Real>(from + layout.at[0]), value_at<Real>(from + layout.at[1]),
                     value_at<Real>(from + layout.at[2])};
        zero += 0 * (p.x + p.y + p.z);
        points.push_back(p);
    }
    return zero == 0;
}

constexpr std::size_t triangle_size = 13;  // bytes: a count and three indices

// False if a face is no triangle or a corner is no index of a point.
bool read_triangles(const char* from, std::size_t count, std::size_t points, std::vector<Triangle>& triangles) {
    reserve_huge(triangles, count);
    bool is_right = true;
    for (std::size_t t = 0; t < count && is_right; ++t, from += triangle_size) {
        const auto triangle = value_at<Triangle>(from + 1);
        is_right = *from == 3 && triangle[0] < points && triangle[1] < points && triangle[2] < points;
        triangles.push_back(triangle);
    }
    return is_right;
}

}  // namespace

std::optional<RawMesh> read_plain_ply(const PlyHeader& header, std::string_view file) {
    if constexpr (std::endian::native != std::endian::little) return std::nullopt;
    const std::vector<PlyElement>& elements = header.elements;
    if (header.format != MeshFormat::ply_little_endian || elements.size() != 2) return std::nullopt;
    if (elements[0].name != "vertex" || elements[1].name != "face") return std::nullopt;
    const std::optional<VertexLayout> layout = layout_of(elements[0]);
    if (!layout || !is_plain_triangle(elements[1])) return std::nullopt;
    const std::uint64_t points = elements[0].count;
    const std::uint64_t triangles = elements[1].count;
    const std::size_t left = file.size() - header.size;
    // false counts must not overflow the products
    if (points > left || triangles > left || points > max_points || triangles > max_triangles) return std::nullopt;
    if (left != points * layout->size + triangles * triangle_size) return std::nullopt;
    const char* const body = file.data() + header.size;
    RawMesh scan;
    scan.format = header.format;
    scan.faces_in_file = triangles;
    const bool is_finite = layout->type == PlyType::f32 ? read_points<float>(*layout, body, points, scan.mesh.points)
                                                        : read_points<double>(*layout, body, points, scan.mesh.points);
    if (!is_finite) return std::nullopt;
    if (!read_triangles(body + points * layout->size, triangles, points, scan.mesh.triangles)) return std::nullopt;
    return scan;
}

}  // namespace qchopper
