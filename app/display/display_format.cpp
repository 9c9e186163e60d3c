// Differences to the point before are small, and bytes of one meaning stand together, which is what deflate packs well.
// Indices after S. Gumhold and W. Strasser, "Real time compression of triangle mesh connectivity" (1998), in the form
// of A. Ludlow and others' high watermark codes. O(bytes).

#include "app/display/display_format.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <limits>

#include "app/pictures/unreachable_picture.h"
#include "base/error.h"
#include "base/hex.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

constexpr std::array<std::uint8_t, 4> mesh_mark{'Q', 'C', 'D', '1'};
constexpr std::array<std::uint8_t, 4> states_mark{'Q', 'C', 'S', '1'};
constexpr std::size_t head_bytes = 4 + 4 * 4 + 4 * 8;
constexpr std::size_t point_bytes = 6;
constexpr std::size_t group_bytes = 1 + 3 * 4;
constexpr std::size_t id_bytes = 16;

// Little-endian, whatever the machine is.
template <class Unsigned>
void put(Bytes& out, Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

void put(Bytes& out, double value) {
    put(out, std::bit_cast<std::uint64_t>(value));
}

// 0, 1, 2, 3, 4 for 0, -1, 1, -2, 2.
std::uint16_t zigzag(int difference) {
    return static_cast<std::uint16_t>(difference >= 0 ? 2 * difference : -2 * difference - 1);
}

int from_zigzag(unsigned code) {
    const int half = static_cast<int>(code >> 1);
    return code % 2 == 0 ? half : -half - 1;
}

void put_positions(Bytes& out, const std::vector<DisplayPoint>& points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t low = out.size();
        const std::size_t high = low + points.size();
        out.resize(high + points.size());
        int before = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint16_t code = zigzag(points[i][axis] - before);
            before = points[i][axis];
            out[low + i] = static_cast<std::uint8_t>(code);
            out[high + i] = static_cast<std::uint8_t>(code >> 8);
        }
    }
}

void put_indices(Bytes& out, const std::vector<Triangle>& triangles) {
    std::uint32_t next = 0;
    for (const Triangle& t : triangles) {
        for (const std::uint32_t corner : t) {
            std::uint32_t code = next - corner;
            if (code == 0) ++next;
            for (; code >= 128; code /= 128) out.push_back(static_cast<std::uint8_t>(code % 128 + 128));
            out.push_back(static_cast<std::uint8_t>(code));
        }
    }
}

[[noreturn]] void refuse(const std::string& what) {
    throw InputError(InputFault::mesh, "the display mesh is damaged: " + what, "make it again");
}

void demand(bool holds, const char* what) {
    if (!holds) refuse(what);
}

// Of the bytes that are left, which the caller has counted.
class ByteReader {
 public:
    explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::span<const std::uint8_t> take(std::size_t count) {
        assert(count <= bytes_.size());
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    template <class Unsigned>
    Unsigned number() {
        Unsigned value = 0;
        std::size_t i = 0;
        for (const std::uint8_t byte : take(sizeof value)) value |= static_cast<Unsigned>(Unsigned{byte} << 8 * i++);
        return value;
    }
    double real() { return std::bit_cast<double>(number<std::uint64_t>()); }

 private:
    std::span<const std::uint8_t> bytes_;
};

std::vector<DisplayPoint> positions(ByteReader& in, std::size_t count) {
    std::vector<DisplayPoint> points(count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto low = in.take(count);
        const auto high = in.take(count);
        int here = 0;
        for (std::size_t i = 0; i < count; ++i) {
            here += from_zigzag(low[i] + 256U * high[i]);
            demand(here >= 0 && here <= max_display_coordinate, "a point is outside of the grid");
            points[i][axis] = static_cast<std::uint16_t>(here);
        }
    }
    return points;
}

std::uint32_t index_code(std::span<const std::uint8_t> bytes, std::size_t& at) {
    std::uint64_t code = 0;
    for (unsigned shift = 0;; shift += 7) {
        demand(at < bytes.size() && shift < 35, "an index has no end");
        const std::uint8_t byte = bytes[at++];
        code |= std::uint64_t{byte % 128U} << shift;
        if (byte >= 128) continue;
        demand(byte > 0 || shift == 0, "an index is longer than it needs to be");
        demand(code <= std::numeric_limits<std::uint32_t>::max(), "an index is too large");
        return static_cast<std::uint32_t>(code);
    }
}

// With points numbered in the order of their first use.
std::vector<Triangle> indices(std::span<const std::uint8_t> bytes, std::size_t faces) {
    std::vector<Triangle> triangles(faces);
    std::size_t at = 0;
    std::uint32_t next = 0;
    for (Triangle& t : triangles) {
        for (std::uint32_t& corner : t) {
            const std::uint32_t code = index_code(bytes, at);
            demand(code <= next, "an index is of no point");
            corner = next - code;
            if (code == 0) ++next;
        }
    }
    demand(at == bytes.size(), "there are more index bytes than faces need");
    return triangles;
}

std::vector<DisplayGroup> groups(ByteReader& in, std::size_t count) {
    std::vector<DisplayGroup> result(count);
    for (DisplayGroup& group : result) {
        const auto surface = in.number<std::uint8_t>();
        demand(surface <= 1, "a group is neither skin nor cap");
        group.surface = static_cast<DisplaySurface>(surface);
        group.cut = static_cast<std::int32_t>(in.number<std::uint32_t>());
        group.first = in.number<std::uint32_t>();
        group.faces = in.number<std::uint32_t>();
    }
    return result;
}

bool begins_with(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, 4>& mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
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
    demand(begins_with(bytes, mesh_mark), "it does not begin with QCD1");
    demand(bytes.size() >= head_bytes, "it ends within its head");
    ByteReader in(bytes.subspan(mesh_mark.size()));
    const auto count = [&] { return std::uint64_t{in.number<std::uint32_t>()}; };
    const std::uint64_t points = count();
    const std::uint64_t faces = count();
    const std::uint64_t index_bytes = count();
    const std::uint64_t group_count = count();
    // before anything is made of that size
    demand(bytes.size() == head_bytes + point_bytes * points + index_bytes + group_bytes * group_count,
           "it is not as long as its head says");
    demand(index_bytes >= 3 * faces, "there are more faces than index bytes");
    DisplayMesh mesh;
    for (double* x : {&mesh.grid.origin.x, &mesh.grid.origin.y, &mesh.grid.origin.z, &mesh.grid.step}) *x = in.real();
    mesh.points = positions(in, points);
    mesh.triangles = indices(in.take(index_bytes), faces);
    mesh.groups = groups(in, group_count);
    demand(is_valid(mesh), "grid, faces, points and groups do not belong together");
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
    demand(begins_with(bytes, states_mark), "it does not begin with QCS1");
    demand(bytes.size() >= states_mark.size() + id_bytes, "it ends within its head");
    const auto faces = bytes.subspan(states_mark.size() + id_bytes);
    demand(std::all_of(faces.begin(), faces.end(), [](std::uint8_t s) { return s <= base_state; }),
           "a face has no state that there is");
    return {to_hex(bytes.subspan(states_mark.size(), id_bytes)), {faces.begin(), faces.end()}};
}

}  // namespace qchopper
