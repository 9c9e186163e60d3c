// The two triangles at a crossed edge are paired by sorting the edges by their ends above and below, which both
// triangles share; then the loops are the cycles from triangle to triangle.

#include "segment/mesh/plane_section.h"

#include <algorithm>
#include <limits>
#include <string>

#include "base/error.h"

namespace qchopper {
namespace {

struct CrossedEdge {
    std::uint32_t above;
    std::uint32_t below;
    std::uint32_t triangle;  // index in PlaneSection::triangles
    std::uint64_t key() const { return (static_cast<std::uint64_t>(above) << 32) | below; }
    bool operator<(const CrossedEdge& b) const { return key() != b.key() ? key() < b.key() : triangle < b.triangle; }
};

[[noreturn]] void throw_open(Vec3 at) {
    const auto text = [](double x) { return std::to_string(x); };
    throw InputError(InputFault::mesh,
                     "the mesh is open where the cut passes, near " + text(at.x) + " " + text(at.y) + " " + text(at.z),
                     "repair the scan first");
}

std::vector<SectionTriangle> crossed_triangles(const TriangleMesh& mesh, std::span<const std::uint8_t> is_above) {
    std::vector<SectionTriangle> crossed;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const int above = is_above[v[0]] + is_above[v[1]] + is_above[v[2]];
        if (above == 0 || above == 3) continue;
        crossed.push_back({t, triangle_crossing(is_above[v[0]] != 0, is_above[v[1]] != 0, is_above[v[2]] != 0)});
    }
    return crossed;
}

// Pairs the two triangles at each crossed edge and computes its point once. Returns one index per crossed triangle: the
// one across its exit edge.
std::vector<std::uint32_t> link_triangles(PlaneSection& section, const TriangleMesh& mesh, const Plane& plane) {
    const std::size_t count = section.triangles.size();
    std::vector<CrossedEdge> exits(count);
    std::vector<CrossedEdge> entries(count);
    for (std::uint32_t s = 0; s < count; ++s) {
        const Triangle& v = mesh.triangles[section.triangles[s].triangle];
        const std::uint32_t exit = section.triangles[s].crossing.exit();
        const std::uint32_t entry = section.triangles[s].crossing.entry();
        exits[s] = {v[exit], v[(exit + 1) % 3], s};
        entries[s] = {v[(entry + 1) % 3], v[entry], s};
    }
    std::sort(exits.begin(), exits.end());
    std::sort(entries.begin(), entries.end());
    section.points.resize(count);
    std::vector<std::uint32_t> next(count);
    const auto end = [&](std::uint32_t v) { return EdgeEnd{mesh.points[v], height(plane.normal, mesh.points[v])}; };
    for (std::uint32_t i = 0; i < count; ++i) {
        if (exits[i].key() != entries[i].key()) throw_open(mesh.points[exits[i].above]);
        section.points[i] = edge_crossing(end(exits[i].above), end(exits[i].below), plane.offset);
        section.triangles[exits[i].triangle].exit_point = i;
        section.triangles[entries[i].triangle].entry_point = i;
        next[exits[i].triangle] = entries[i].triangle;
    }
    return next;
}

}  // namespace

Cycles cycles(std::span<const std::uint32_t> next) {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    Cycles result;
    result.cycle_of.assign(next.size(), none);
    result.order.reserve(next.size());
    for (std::uint32_t first = 0; first < next.size(); ++first) {
        if (result.cycle_of[first] != none) continue;
        const auto number = static_cast<std::uint32_t>(result.cycles.size());
        std::uint32_t size = 0;
        for (std::uint32_t i = first; result.cycle_of[i] == none; i = next[i]) {
            result.cycle_of[i] = number;
            result.order.push_back(i);
            ++size;
        }
        result.cycles.push_back({first, size});
    }
    return result;
}

std::vector<std::uint8_t> points_above(const TriangleMesh& mesh, const Plane& plane) {
    std::vector<std::uint8_t> is_above(mesh.points.size());
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        is_above[v] = height(plane.normal, mesh.points[v]) >= plane.offset ? 1 : 0;
    }
    return is_above;
}

// Through the exit edges the triangles run clockwise around material: each loop is reversed.
PlaneSection plane_section(const TriangleMesh& mesh, const Plane& plane, std::span<const std::uint8_t> is_above) {
    assert(is_above.size() == mesh.points.size());
    PlaneSection section;
    section.triangles = crossed_triangles(mesh, is_above);
    const std::vector<std::uint32_t> next = link_triangles(section, mesh, plane);
    for (const auto& [first, size] : cycles(next).cycles) {
        Loop loop(size);
        std::uint32_t at = first;
        for (std::size_t i = size; i-- > 0; at = next[at]) loop[i] = section.triangles[at].exit_point;
        section.loops.push_back(std::move(loop));
    }
    return section;
}

}  // namespace qchopper
