// Constrained Delaunay triangulation by CGAL, one region at a time. Its result is used only if it has every point and
// every loop edge; otherwise the same is tried with contacts moved apart (contact.h), and at last the region is cut
// into ears (ear_clipping.h), which cannot fail. O(N log N) for N points on average.

#include "segment/cut/cap.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

#include "segment/cut/contact.h"
#include "segment/cut/ear_clipping.h"

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// Sets the info of every face to the number of constrained edges between it and the infinite one, modulo 2.
void mark_inside(Delaunay& cdt) {
    for (const Delaunay::Face_handle face : cdt.all_face_handles()) face->info() = -1;
    std::vector<Delaunay::Face_handle> stack{cdt.infinite_face()};
    cdt.infinite_face()->info() = 0;
    while (!stack.empty()) {
        const Delaunay::Face_handle face = stack.back();
        stack.pop_back();
        for (int i = 0; i < 3; ++i) {
            const Delaunay::Face_handle other = face->neighbor(i);
            if (other->info() != -1) continue;
            other->info() = cdt.is_constrained({face, i}) ? 1 - face->info() : face->info();
            stack.push_back(other);
        }
    }
}

// Whether this is an edge of the triangulation with the inside on its left only.
bool is_border(const Delaunay& cdt, Delaunay::Vertex_handle from, Delaunay::Vertex_handle to) {
    Delaunay::Face_handle left;
    int i = 0;
    if (!cdt.is_edge(from, to, left, i)) return false;
    Delaunay::Face_handle right = left->neighbor(i);
    if (left->vertex(Delaunay::ccw(i)) != from) std::swap(left, right);
    return left->info() == 1 && right->info() == 0;
}

// Nothing if the triangulation would merge points, split a loop edge, give another number of triangles, or orient them
// against a loop: the sign of an area near 0 depends on the rounding of the coordinates.
std::optional<Triangles> delaunay(std::span<const Point2> points, std::span<const Loop* const> loops) {
    std::vector<std::uint32_t> order;
    std::vector<std::size_t> next;  // one per entry of order: the following entry of its loop
    for (const Loop* loop : loops) {
        const std::size_t first = order.size();
        order.insert(order.end(), loop->begin(), loop->end());
        for (std::size_t i = 0; i < loop->size(); ++i) next.push_back(first + (i + 1) % loop->size());
    }
    std::vector<Kernel::Point_2> place;
    place.reserve(order.size());
    for (const std::uint32_t p : order) place.emplace_back(points[p].x, points[p].y);
    std::vector<std::size_t> sorted(order.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) sorted[i] = i;
    using Map = CGAL::Pointer_property_map<Kernel::Point_2>::type;
    CGAL::spatial_sort(sorted.begin(), sorted.end(),
                       CGAL::Spatial_sort_traits_adapter_2<Kernel, Map>(CGAL::make_property_map(place)));
    Delaunay cdt;
    std::vector<Delaunay::Vertex_handle> vertex(order.size());
    Delaunay::Face_handle hint;
    for (const std::size_t i : sorted) {
        const std::size_t before = cdt.number_of_vertices();
        vertex[i] = cdt.insert(place[i], hint);
        if (cdt.number_of_vertices() == before) return std::nullopt;  // two points in one place
        vertex[i]->info() = order[i];
        hint = vertex[i]->face();
    }
    try {
        for (std::size_t i = 0; i < next.size(); ++i) cdt.insert_constraint(vertex[i], vertex[next[i]]);
    } catch (const Delaunay::Intersection_of_constraints_exception&) {
        return std::nullopt;
    }
    mark_inside(cdt);
    for (std::size_t i = 0; i < next.size(); ++i) {
        if (!is_border(cdt, vertex[i], vertex[next[i]])) return std::nullopt;
    }
    Triangles triangles;
    for (const Delaunay::Face_handle face : cdt.finite_face_handles()) {
        if (face->info() != 1) continue;
        triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
    if (triangles.size() + 4 != order.size() + 2 * loops.size()) return std::nullopt;
    return triangles;
}

}  // namespace

CapTriangles triangulate_regions(std::span<const Point2> points, std::span<const Loop> loops,
                                 std::span<const CapRegion> regions) {
    CapTriangles result;
    for (const CapRegion& region : regions) {
        std::vector<const Loop*> region_loops{&loops[region.outer]};
        for (const std::size_t hole : region.holes) region_loops.push_back(&loops[hole]);
        std::optional<Triangles> triangles;
        if (region.is_simple) triangles = delaunay(points, region_loops);
        if (!triangles) {
            const std::optional<std::vector<Point2>> separated = without_contacts(points, region_loops);
            if (separated) triangles = delaunay(*separated, region_loops);
        }
        if (!triangles) {
            ++result.forced_regions;
            std::vector<Loop> holes;
            for (const std::size_t hole : region.holes) holes.push_back(loops[hole]);
            triangles = clip_ears(points, loops[region.outer], holes);
        }
        result.triangles.insert(result.triangles.end(), triangles->begin(), triangles->end());
    }
    return result;
}

std::vector<Loop> capped(std::vector<Loop> loops) {
    std::erase_if(loops, [](const Loop& l) { return l.size() < 3; });
    return loops;
}

}  // namespace qchopper
