// A stroke is asked of the points in its box alone. O(points * strokes), and O(points of a stroke) for each that lies
// in its box.

#include "app/console/worker/strokes.h"

#include <algorithm>
#include <cstring>

#include "base/box.h"
#include "base/error.h"

namespace qchopper {

namespace {

constexpr std::size_t numbers_of_a_point = 6;

Vec3 place_of(const std::vector<double>& point) {
    return {point[0], point[1], point[2]};
}

Vec3 normal_of(const std::vector<double>& point) {
    return {point[3], point[4], point[5]};
}

Box reach_of(const Stroke& stroke) {
    const Vec3 radius{stroke.radius_mm, stroke.radius_mm, stroke.radius_mm};
    Box box{place_of(stroke.points.front()) - radius, place_of(stroke.points.front()) + radius};
    for (const std::vector<double>& point : stroke.points) {
        const Vec3 low = place_of(point) - radius;
        const Vec3 high = place_of(point) + radius;
        box.min = {std::min(box.min.x, low.x), std::min(box.min.y, low.y), std::min(box.min.z, low.z)};
        box.max = {std::max(box.max.x, high.x), std::max(box.max.y, high.y), std::max(box.max.z, high.z)};
    }
    return box;
}

bool is_in(const Box& box, Vec3 p) {
    return p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z && p.x <= box.max.x && p.y <= box.max.y &&
           p.z <= box.max.z;
}

bool comes_to(const Stroke& stroke, Vec3 place, Vec3 normal) {
    for (const std::vector<double>& point : stroke.points) {
        if (norm(place_of(point) - place) <= stroke.radius_mm && dot(normal_of(point), normal) > 0) return true;
    }
    return false;
}

// Of the areas of the triangles about each point; not of length 1.
std::vector<Vec3> normals_of_points(const TriangleMesh& mesh) {
    std::vector<Vec3> normals(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        const Vec3 area = cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]);
        for (const auto corner : t) normals[corner] = normals[corner] + area;
    }
    return normals;
}

template <class T>
void add(Bytes& bytes, T value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    std::memcpy(&bytes[at], &value, sizeof value);  // little-endian, as all machines that this is built for
}

}  // namespace

const char* are_stroke_points(const std::vector<std::vector<double>>& points) {
    for (const std::vector<double>& point : points) {
        if (point.size() != numbers_of_a_point) return "is not of six numbers each";
    }
    return points.empty() ? "is empty" : nullptr;
}

const char* is_stroke_radius(double radius) {
    return radius > 0 ? nullptr : "is not above 0";
}

std::vector<Stroke> read_strokes(const std::string& json) {
    std::vector<Stroke> strokes;
    try {
        json_values::read_document(
            json, [&](const json_values::Json& list) { json_values::take(list, "strokes", strokes); }, false);
    } catch (const std::runtime_error& e) {
        throw InputError(InputFault::use, std::string("the strokes are wrong: ") + e.what(), "paint them again");
    }
    return strokes;
}

std::string to_json(const std::vector<Stroke>& strokes) {
    return json_values::text_of_document([&](json_values::Json& json) { json_values::put(json, strokes); }, -1);
}

std::vector<StrokeSurface> painted_points(const TriangleMesh& mesh, const std::vector<Stroke>& strokes) {
    std::vector<StrokeSurface> painted(mesh.points.size(), StrokeSurface::clear);
    const std::vector<Vec3> normals = normals_of_points(mesh);
    for (const Stroke& stroke : strokes) {
        const Box reach = reach_of(stroke);
        for (std::size_t i = 0; i < painted.size(); ++i) {
            if (is_in(reach, mesh.points[i]) && comes_to(stroke, mesh.points[i], normals[i]))
                painted[i] = stroke.surface;
        }
    }
    return painted;
}

Bytes masked_ply(const TriangleMesh& mesh, const std::vector<StrokeSurface>& painted, StrokeSurface surface) {
    if (std::find(painted.begin(), painted.end(), surface) == painted.end()) return {};
    const std::string head =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar mask\n"
        "element face " +
        std::to_string(mesh.triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
    Bytes bytes(head.begin(), head.end());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Vec3 p = mesh.points[i];
        for (const double number : {p.x, p.y, p.z}) add(bytes, number);
        add(bytes, static_cast<std::uint8_t>(painted[i] == surface ? 1 : 0));
    }
    for (const Triangle& t : mesh.triangles) {
        add(bytes, std::uint8_t{3});
        for (const auto corner : t) add(bytes, static_cast<std::uint32_t>(corner));
    }
    return bytes;
}

}  // namespace qchopper
