#include "app/project/outline.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

namespace qchopper {
namespace {

// An edge that the plane crosses, named by its end above and its end below.
using CrossedEdge = std::uint64_t;

struct Crossings {
    std::vector<CrossedEdge> in_order;  // as the triangles come, so that the result is always the same
    std::unordered_map<CrossedEdge, CrossedEdge> previous;  // the surface is followed against its run: see cut.cpp
};

Crossings find_crossings(const TriangleMesh& mesh, const Plane& plane) {
    Crossings found;
    const auto is_above = [&](std::uint32_t v) { return height(plane.normal, mesh.points[v]) >= plane.offset; };
    for (const Triangle& t : mesh.triangles) {
        CrossedEdge exit = 0;   // from above to below
        CrossedEdge entry = 0;  // from below to above
        bool is_crossed = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k];
            const std::uint32_t b = t[(k + 1) % 3];
            if (is_above(a) == is_above(b)) continue;
            is_crossed = true;
            if (is_above(a))
                exit = (static_cast<CrossedEdge>(a) << 32) | b;
            else
                entry = (static_cast<CrossedEdge>(b) << 32) | a;
        }
        if (!is_crossed) continue;
        found.in_order.push_back(exit);
        found.previous[exit] = entry;
    }
    return found;
}

}  // namespace

Outline outline(const TriangleMesh& mesh, const Plane& plane) {
    Outline result;
    Crossings crossings = find_crossings(mesh, plane);
    for (const CrossedEdge start : crossings.in_order) {
        std::vector<Vec3> loop;
        CrossedEdge edge = start;
        for (auto at = crossings.previous.find(edge); at != crossings.previous.end();
             at = crossings.previous.find(edge)) {
            const Vec3 upper = mesh.points[edge >> 32];
            const Vec3 lower = mesh.points[edge & 0xFFFFFFFFU];
            const double from = height(plane.normal, upper);
            const double to = height(plane.normal, lower);
            loop.push_back(upper + ((from - plane.offset) / (from - to)) * (lower - upper));
            edge = at->second;
            crossings.previous.erase(at);
        }
        if (!loop.empty()) result.loops.push_back(std::move(loop));
    }
    bool is_first = true;
    for (const auto& loop : result.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            result.length_mm += norm(loop[(i + 1) % loop.size()] - loop[i]);
            if (is_first) result.box = {loop[i], loop[i]};
            is_first = false;
            for (int axis = 0; axis < 3; ++axis) {
                result.box.min[axis] = std::min(result.box.min[axis], loop[i][axis]);
                result.box.max[axis] = std::max(result.box.max[axis], loop[i][axis]);
            }
        }
    }
    return result;
}

}  // namespace qchopper
