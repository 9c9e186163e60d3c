// Says what a scan is and what is wrong with it, without mending anything.
//
// Lengths and places are in the file's own unit and coordinates. Bad meshes are described, not refused
// (tests/segment/import/inspect_test.cpp). Everything but the first counts is taken after equal points are welded, so
// that STL and PLY compare.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// A border loop: where the surface is open.
struct BorderLoop {
    Vec3 centre;  // mean of its points
    std::size_t edges = 0;
    double length = 0;
};

// What a search for triangles that run through each other has found.
struct SelfIntersected {
    std::size_t pairs = 0;     // that meet elsewhere than at what they share
    bool is_complete = true;   // false: the search ended at a limit, there are more
    std::vector<Vec3> places;  // some, well apart from each other; at most 10
};

struct Inspection {
    MeshFormat format = MeshFormat::ply_ascii;
    std::optional<double> mm_per_unit;  // what the file says one unit is; nothing: it has none
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
    std::size_t cavities = 0;        // closed shells with negative volume inside another shell
    std::size_t inside_out = 0;      // closed shells with negative volume and nothing around them
    std::size_t fragments = 0;       // closed solids with less than 1/100,000 of the volume: too small to be pieces
    double fragment_area_share = 0;  // of the surface
    std::size_t sheets = 0;          // open shells with more missing than there is: they enclose nothing
    double sheet_area_share = 0;     // of the surface
    std::size_t open_edges = 0;      // edges of one triangle
    std::size_t inconsistent = 0;    // edges that both triangles run the same way
    std::size_t non_manifold = 0;    // edges of three triangles or more
    std::size_t touching = 0;        // of these, edges with as many faces one way as the other: solids that only touch
    std::size_t non_manifold_vertices = 0;            // points where surfaces only touch
    std::vector<BorderLoop> holes;                    // in order of their first edge
    double volume = 0;                                // signed, file unit cubed; means something only when closed
    double area = 0;                                  // file unit squared
    std::optional<SelfIntersected> self_intersected;  // only when asked for

    bool is_closed() const { return open_edges == 0 && inconsistent == 0 && non_manifold == 0; }
    // The longest one; nothing without a hole.
    const BorderLoop* longest_hole() const;
};

struct InspectOptions {
    bool deep = false;  // look for self-intersections too: several times the time of all the rest
};

Inspection inspect(RawMesh scan, const InspectOptions& options = {}, const Context& context = {});

enum class Verdict {
    ready,        // a solid as it stands, or once what always happens on the way in has happened
    to_repair,    // prepare and repair make a solid of it
    unrepairable  // there is no solid in it
};

// What stands between the scan and a solid, in whole sentences; when it is ready, what happens on the way in.
struct Judgement {
    Verdict verdict = Verdict::ready;
    std::vector<std::string> reasons;
};
Judgement judge(const Inspection& inspection);

// "1.82 m x 0.94 m x 0.71 m": all in the unit that suits the longest, which gets three digits.
std::string size_in_words(Vec3 size_mm);

}  // namespace qchopper
