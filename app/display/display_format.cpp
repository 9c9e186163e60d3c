// Differences to the point before are small, and bytes of one meaning stand together, which is what deflate packs well.
// Indices after S. Gumhold and W. Strasser, "Real time compression of triangle mesh connectivity" (1998), in the form
// of A. Ludlow and others' high watermark codes. O(bytes).

#include "app/display/display_format.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "app/display/display_bytes.h"
#include "app/pictures/unreachable_picture.h"
#include "base/hex.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

constexpr std::array<std::uint8_t, 4> mesh_mark{'Q', 'C', 'D', '1'};
constexpr std::array<std::uint8_t, 4> states_mark{'Q', 'C', 'S', '1'};
constexpr std::size_t head_bytes = 4 + 4 * 4 + 4 * 8;
constexpr std::size_t group_bytes = 1 + 3 * 4;
constexpr std::size_t id_bytes = 16;

void put_indices(Bytes& out, const std::vector<Triangle>& triangles) {
    std::uint32_t next = 0;
    for (const Triangle& t : triangles) {
        for (const std::uint32_t corner : t) {
            const std::uint32_t code = next - corner;
            if (code == 0) ++next;
            put_code(out, code);
        }
    }
}

// With points numbered in the order of their first use.
std::vector<Triangle> indices(std::span<const std::uint8_t> bytes, std::size_t faces) {
    std::vector<Triangle> triangles(faces);
    std::size_t at = 0;
    std::uint32_t next = 0;
    for (Triangle& t : triangles) {
        for (std::uint32_t& corner : t) {
            const std::uint32_t code = read_code(bytes, at);
            demand_display(code <= next, "an index is of no point");
            corner = next - code;
            if (code == 0) ++next;
        }
    }
    demand_display(at == bytes.size(), "there are more index bytes than faces need");
    return triangles;
}

std::vector<DisplayGroup> groups(DisplayReader& in, std::size_t count) {
    std::vector<DisplayGroup> result(count);
    for (DisplayGroup& group : result) {
        const auto surface = in.number<std::uint8_t>();
        demand_display(surface <= 1, "a group is neither skin nor cap");
        group.surface = static_cast<DisplaySurface>(surface);
        group.cut = static_cast<std::int32_t>(in.number<std::uint32_t>());
        group.first = in.number<std::uint32_t>();
        group.faces = in.number<std::uint32_t>();
    }
    return result;
}

}  // namespace

Bytes encode_display_mesh(const DisplayMesh& mesh) {
    assert(is_valid(mesh));
    Bytes indices_of_faces;
    put_indices(indices_of_faces, mesh.triangles);
    assert(indices_of_faces.size() <= std::numeric_limits<std::uint32_t>::max());
    Bytes out(mesh_mark.begin(), mesh_mark.end());
    for (const std::size_t count :
         {mesh.points.size(), mesh.triangles.size(), indices_of_faces.size(), mesh.groups.size()}) {
        put(out, static_cast<std::uint32_t>(count));
    }
    const Vec3& origin = mesh.grid.origin;
    for (const double x : {origin.x, origin.y, origin.z, mesh.grid.step}) put(out, x);
    put_positions(out, mesh.points);
    out.insert(out.end(), indices_of_faces.begin(), indices_of_faces.end());
    for (const DisplayGroup& group : mesh.groups) {
        out.push_back(static_cast<std::uint8_t>(group.surface));
        for (const std::uint32_t n : {static_cast<std::uint32_t>(group.cut), group.first, group.faces}) put(out, n);
    }
    return out;
}

DisplayMesh decode_display_mesh(std::span<const std::uint8_t> bytes) {
    demand_display(has_mark(bytes, mesh_mark), "it does not begin with QCD1");
    demand_display(bytes.size() >= head_bytes, "it ends within its head");
    DisplayReader in(bytes.subspan(mesh_mark.size()));
    const auto count = [&] { return std::uint64_t{in.number<std::uint32_t>()}; };
    const std::uint64_t points = count();
    const std::uint64_t faces = count();
    const std::uint64_t index_bytes = count();
    const std::uint64_t group_count = count();
    // before anything is made of that size
    demand_display(bytes.size() == head_bytes + display_point_bytes * points + index_bytes + group_bytes * group_count,
                   "it is not as long as its head says");
    demand_display(index_bytes >= 3 * faces, "there are more faces than index bytes");
    DisplayMesh mesh;
    for (double* x : {&mesh.grid.origin.x, &mesh.grid.origin.y, &mesh.grid.origin.z, &mesh.grid.step}) *x = in.real();
    mesh.points = read_positions(in, points);
    mesh.triangles = indices(in.take(index_bytes), faces);
    mesh.groups = groups(in, group_count);
    demand_display(is_valid(mesh), "grid, faces, points and groups do not belong together");
    return mesh;
}

std::string display_id(std::span<const std::uint8_t> encoded) {
    return to_hex(sha256(encoded)).substr(0, 2 * id_bytes);
}

Bytes encode_display_states(const DisplayStates& states) {
    const auto id = from_hex<id_bytes>(states.mesh);
    assert(id && std::all_of(states.faces.begin(), states.faces.end(), [](std::uint8_t s) { return s <= base_state; }));
    Bytes out(states_mark.size() + id_bytes + states.faces.size());
    auto at = std::copy(states_mark.begin(), states_mark.end(), out.begin());
    at = std::copy(id->begin(), id->end(), at);
    std::copy(states.faces.begin(), states.faces.end(), at);
    return out;
}

DisplayStates decode_display_states(std::span<const std::uint8_t> bytes) {
    demand_display(has_mark(bytes, states_mark), "it does not begin with QCS1");
    demand_display(bytes.size() >= states_mark.size() + id_bytes, "it ends within its head");
    const auto faces = bytes.subspan(states_mark.size() + id_bytes);
    demand_display(std::all_of(faces.begin(), faces.end(), [](std::uint8_t s) { return s <= base_state; }),
                   "a face has no state that there is");
    return {to_hex(bytes.subspan(states_mark.size(), id_bytes)), {faces.begin(), faces.end()}};
}

}  // namespace qchopper
