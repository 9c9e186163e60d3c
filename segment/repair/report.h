// What repair() has done to a mesh, in numbers and in words.
//
// Counts are of the mesh as it came in and went out; lengths are mm. docs/repair.md explains every number.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segment/mesh/distance.h"
#include "segment/repair/fill_holes.h"
#include "segment/repair/marks.h"
#include "segment/repair/resolve.h"
#include "segment/repair/wrap.h"

namespace qchopper {

struct RepairReport {
    std::size_t faces_in = 0;
    std::size_t points_in = 0;
    std::size_t faces_out = 0;
    std::size_t points_out = 0;
    std::size_t faces_gone = 0;  // of the scan: not in the result
    std::size_t faces_new = 0;   // of the result: not in the scan
    std::size_t passes = 0;      // over the steps, until nothing changed

    std::size_t welded = 0;            // points that became one with an equal one
    std::size_t collapsed = 0;         // faces with two corners in one point
    std::size_t unreferenced = 0;      // points in no face
    std::size_t borders_snapped = 0;   // border points moved onto a near one
    double border_moved_mm = 0;        // the farthest of them
    std::size_t repeated = 0;          // faces that say what another one says
    std::size_t of_double_sheets = 0;  // faces of flat double sheets
    std::size_t edges_split = 0;       // edges of three faces or more
    std::size_t edges_cut = 0;         // between faces that cannot be made to agree
    std::size_t faces_turned = 0;      // so that neighbours agree
    std::size_t stitched = 0;          // edges
    std::size_t points_copied = 0;     // where surfaces only touch
    std::size_t degenerate_removed = 0;
    std::size_t degenerate_left = 0;
    std::size_t holes_filled = 0;
    std::size_t holes_faired = 0;  // of these
    std::size_t faces_added = 0;   // to fill them
    std::size_t points_added = 0;
    double added_area_share = 0;           // of the surface that the holes took
    std::size_t open_components = 0;       // small open surfaces taken away
    std::size_t open_component_faces = 0;  // of the scan
    std::size_t shells = 0;
    std::size_t cavities = 0;
    std::size_t shells_turned = 0;
    std::size_t overlapping = 0;      // shells inside another one that faces the same way
    std::size_t left_inside_out = 0;  // shells that hang on others which are not
    std::size_t fragments = 0;
    std::size_t fragment_faces = 0;
    double fragment_area_share = 0;
    bool fragments_dropped = false;
    std::optional<Resolved> resolved;
    bool resolving_undone = false;  // it left the mesh less closed than before
    std::optional<MarkReport> marks;
    std::optional<WrapOptions> wrapped;

    // What stands between the result and a solid.
    std::vector<OpenHole> left_open;
    std::size_t sheets = 0;      // shells of which more is filled than was scanned
    Vec3 first_sheet;            // the middle of the first of them
    std::size_t open_edges = 0;  // edges at which the result is not closed, and the first
    Vec3 first_open_edge;
    double volume = 0;  // in units of the mesh, cubed
    bool is_solid() const { return open_edges == 0 && sheets == 0 && volume > 0; }

    std::optional<Deviation> deviation;  // in mm; where asked for
};

// One step of the order in docs/repair.md, with what it did: "3 holes closed with 24 faces".
struct RepairStep {
    std::string name;  // as in the options and in the document
    std::size_t count = 0;
    std::string words;
};

// The steps in their order; those that changed nothing too, with count 0.
std::vector<RepairStep> steps(const RepairReport& report);

// Whole sentences for the operator: what he should look at.
std::vector<std::string> warnings(const RepairReport& report);

}  // namespace qchopper
