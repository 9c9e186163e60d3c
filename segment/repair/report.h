// What repair() has done to a mesh: the counts, the steps and the warnings for the operator.
//
// Places are in units of the mesh; fields that end in _mm, and those of pen_grooves and alpha_wrapped, are mm.
// docs/user/repair.md explains every number.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "segment/mesh/distance.h"
#include "segment/repair/alpha_wrap.h"
#include "segment/repair/fill_holes.h"
#include "segment/repair/pen_grooves/pen_grooves.h"
#include "segment/repair/resolve.h"

namespace qchopper {

struct RepairReport {
    std::size_t faces_in = 0;
    std::size_t points_in = 0;
    std::size_t faces_out = 0;
    std::size_t points_out = 0;
    std::size_t faces_gone = 0;  // faces of the scan that are not in the result
    std::size_t faces_new = 0;   // faces of the result that are not in the scan
    std::size_t passes = 0;      // over the steps, until nothing changed

    std::size_t welded = 0;                 // points merged with an equal one
    std::size_t collapsed = 0;              // faces with two equal corners, dropped
    std::size_t unreferenced = 0;           // points of no face, dropped
    std::size_t borders_snapped = 0;        // border points merged with a near one
    double border_moved_mm = 0;             // the largest distance that one of them moved
    std::size_t repeated = 0;               // faces with the corners of another face, dropped
    std::size_t of_doubled_components = 0;  // faces of flat doubled components, dropped
    std::size_t edges_split = 0;            // edges of three faces or more
    std::size_t edges_cut = 0;              // edges cut open because their faces cannot be oriented alike
    std::size_t faces_reoriented = 0;       // to agree with their neighbours
    std::size_t stitched = 0;               // edges
    std::size_t points_copied = 0;          // where surfaces only touch
    std::size_t degenerate_removed = 0;
    std::size_t degenerate_left = 0;
    std::size_t holes_filled = 0;
    std::size_t holes_faired = 0;  // of these
    std::size_t faces_added = 0;   // to fill them
    std::size_t points_added = 0;
    double added_area_share = 0;              // of the surface, 0 to 1: the area of the hole fills
    std::size_t open_components_dropped = 0;  // small open surfaces beside a solid
    std::size_t open_component_faces = 0;     // of the scan, dropped with them
    std::size_t shells = 0;
    std::size_t cavities = 0;
    std::size_t shells_reoriented = 0;
    std::size_t overlapping = 0;      // shells inside another one that is oriented alike
    std::size_t left_inside_out = 0;  // shells inside out, but held by others that they touch
    std::size_t fragments = 0;
    std::size_t fragment_faces = 0;
    double fragment_area_share = 0;  // of the surface, 0 to 1
    bool fragments_dropped = false;
    std::optional<Resolved> resolved;               // with resolve_self_intersections
    bool resolving_undone = false;                  // it left the mesh less closed than before
    std::optional<PenGrooveReport> pen_grooves;     // with smooth_pen_grooves
    std::optional<AlphaWrapOptions> alpha_wrapped;  // with alpha_wrap_mm: the lengths that were used

    // Why the result is no solid.
    std::vector<OpenHole> left_open;
    std::size_t open_components_left = 0;  // shells that are filled for the most part (open_components.h)
    Vec3 first_open_component;             // centre of the box of the first of them
    std::size_t open_edges = 0;            // edges at which the result is not closed
    Vec3 first_open_edge;                  // a corner of a face at the first of them
    double volume = 0;                     // in units of the mesh, cubed; 0 if the result is not closed
    bool is_solid() const { return open_edges == 0 && open_components_left == 0 && volume > 0; }

    std::optional<Deviation> deviation;  // in mm; with measure_deviation
};

// Why a result is refused, and what to do.
struct Refusal {
    std::string why;  // follows the name of the scan: " has no volume", ": no face has an area"
    std::string to_do;
};
// By the first reason why the result is no solid; nothing for a solid.
std::optional<Refusal> refusal_of(const RepairReport& report);

// One step in the order of docs/user/repair.md.
struct RepairStep {
    std::string name;  // as in the options and in the document
    std::size_t count = 0;
    std::string words;  // what it did: "3 holes closed, with 24 faces"
};

// All steps in their order; those that changed nothing have the count 0.
std::vector<RepairStep> steps(const RepairReport& report);

// What the operator should check, in whole sentences.
std::vector<std::string> warnings(const RepairReport& report);

}  // namespace qchopper
