// The table of the methods that label a surface: names, what they seek, and how fine a copy of the scan they take.
//
// Tests: tests/segment/regions/methods_test.cpp.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/context.h"
#include "segment/regions/labelling.h"

namespace qchopper {

enum class RegionsSought {
    parts,  // limbs and bulges
    charts  // surface near a plane or another simple shape, or tiles
};

struct RegionMethod {
    std::string_view name;  // as operators write it
    RegionsSought sought = RegionsSought::parts;
    std::size_t faces = 100'000;  // of the simplified copy
    Labels (*labels)(const FaceGraph& graph, const RegionOptions& options) = nullptr;
};

// In the order of the survey (Nicholson 2016, chapter 2), then those that it does not name; names differ.
std::span<const RegionMethod> region_methods();

// Null: no method has this name.
const RegionMethod* region_method(std::string_view name);

// "superfaces, eck, zhou-huang".
std::string names_of_region_methods();

// The regions of a scan, on a copy of it with fewer triangles, without solids and shells beside the largest one.
struct ScanRegions {
    TriangleMesh copy;  // every point of it is one of the scan
    Labels labels;      // of the triangles of the copy
};

// The regions of the connected part of a scan that has the most surface, by a method, because regions of small solids
// beside it propose nothing of use; those of less than 0.2 % of the surface are joined to neighbours where parts are
// sought, and borders are straightened (straight_borders.h). Precondition: the mesh is closed and has a triangle.
// Throws Cancelled between simplification and labelling.
ScanRegions scan_regions(const TriangleMesh& scan, const RegionMethod& method, const RegionOptions& options = {},
                         const Context& context = {});

// The labels of the copy, as values per triangle of the scan: of the triangle of the copy that is nearest to its
// centroid. O(triangles log triangles of the copy).
Labels on_scan(const ScanRegions& regions, const TriangleMesh& scan);

}  // namespace qchopper
