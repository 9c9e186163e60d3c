// Counts what a scan consists of and what is wrong with it, and asks whether repair() makes a solid of it.
//
// Lengths and places are in the unit and the coordinates of the file. Bad meshes are described, not refused
// (tests/segment/import/inspect_test.cpp). All values but the first counts are those after equal points are welded, so
// that STL and PLY give the same.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/import/fault_places.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/repair/report.h"

namespace qchopper {

// A border loop: where the surface is open.
struct BorderLoop {
    Vec3 centre;  // mean of its points
    std::size_t edges = 0;
    double length = 0;
};

// A closed solid, without the cavities in it.
struct InspectedSolid {
    double volume = 0;
    std::size_t faces = 0;  // of its outer shell
    Vec3 centre;            // of its box
};

// The result of a search for self-intersections (self_intersections.h).
struct SelfIntersected {
    std::size_t pairs = 0;     // of triangles
    bool is_complete = true;   // false: the search ended at a limit, there may be more
    std::vector<Vec3> places;  // at most 10, at least 1 % of the box's diagonal apart
};

struct Inspection {
    MeshFormat format = MeshFormat::ply_ascii;
    std::optional<double> mm_per_unit;  // unit of the file; nothing: it has none
    std::vector<std::string> warnings;  // of the reader
    std::size_t faces_in_file = 0;      // polygons count once
    std::size_t points_in_file = 0;
    std::size_t faces_without_area = 0;  // fewer than three corners
    std::size_t triangles_in_file = 0;   // after polygons are split

    std::size_t triangles = 0;     // without the collapsed ones
    std::size_t vertices = 0;      // without the unreferenced ones
    std::size_t welded = 0;        // points equal to an earlier one
    std::size_t collapsed = 0;     // triangles with two corners in one point
    std::size_t unreferenced = 0;  // points in no triangle
    std::size_t degenerate = 0;    // triangles with three different corners on one line
    std::size_t repeated = 0;      // triangles with the corners of an earlier one
    Box box;                       // of the points in use
    std::size_t shells = 0;
    std::size_t cavities = 0;    // closed shells with negative volume inside another shell
    std::size_t inside_out = 0;  // closed shells with negative volume and nothing around them
    std::size_t solid_count = 0;
    std::vector<InspectedSolid> solids;  // at most 100, the largest first
    std::size_t fragments = 0;           // closed solids with less than 1/100,000 of the volume: too small to be pieces
    double fragment_area_share = 0;      // of the surface
    std::size_t open_components = 0;     // open shells with holes larger than 80 % of their area: they enclose nothing
    double open_component_area_share = 0;  // of the surface
    std::size_t open_edges = 0;            // edges of one triangle
    std::size_t inconsistent = 0;          // edges along which both triangles run the same way
    std::size_t non_manifold = 0;          // edges of three triangles or more
    std::size_t touching = 0;  // of these, edges with as many faces one way as the other: solids that only touch
    std::size_t non_manifold_vertices = 0;            // points where surfaces only touch
    std::vector<BorderLoop> holes;                    // in order of their first edge
    double volume = 0;                                // signed, file unit cubed; meaningful only when closed
    double area = 0;                                  // file unit squared
    std::optional<SelfIntersected> self_intersected;  // with InspectOptions::deep
    std::vector<FaultPlaces> places;                  // a few of each kind of fault that there is
    std::optional<Refusal> refused;  // by repair(), as its result is no solid; nothing: it makes a solid of the scan

    bool is_closed() const { return open_edges == 0 && inconsistent == 0 && non_manifold == 0; }
    // The first of the longest holes; nullptr without a hole.
    const BorderLoop* longest_hole() const;
};

struct InspectOptions {
    bool deep = false;  // find self-intersections too: takes several times as long as all the rest
};

// The scan may be any mesh of the readers. Throws Cancelled.
Inspection inspect(RawMesh scan, const InspectOptions& options = {}, const Context& context = {});

enum class Verdict {
    ready,        // a solid as it is, or after what every import does
    to_repair,    // prepare and repair make a solid of it
    unrepairable  // they refuse it
};

// The verdict, and what stands between the scan and a solid, in whole sentences; if it is ready, what every import does
// to it; of a refused one why, and what to do.
struct Judgement {
    Verdict verdict = Verdict::ready;
    std::vector<std::string> reasons;
};
Judgement judge(const Inspection& inspection);

// "1.82 m x 0.94 m x 0.71 m": all in the unit, mm, cm or m, in which the longest has three digits.
std::string describe_size(Vec3 size_mm);

}  // namespace qchopper
