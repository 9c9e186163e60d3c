// The objectives of a cut and their weighted sum; lower is better: the four of the thesis (Nicholson 2016, section
// 4.2), the surface that no tool reaches (unreachable.h), and those of Chopper (Luo et al., "Chopper: partitioning
// models into 3D-printable parts", 2012), of which docs/developer/objectives.md has the formulas.
//
// Invariants: tests/segment/objectives/objectives_test.cpp.

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "segment/cut/cut_evaluation.h"
#include "segment/mesh/plane.h"
#include "segment/objectives/weights.h"

namespace qchopper {

// Over which pieces face ratio and undercut are taken.
enum class TermScope {
    whole,  // all of the segmentation, as in the thesis
    cut     // those that the newest cut makes: a small solid elsewhere does not drown every other term
};

enum class FragilityForm {
    thinness,  // scale-free, in [0, 2]: the default
    thesis,    // as printed in the thesis, in mm: for comparison
    binary     // of Chopper: 1 if a vertex near the plane stands over thin material, else 0
};

enum class ConnectorForm {
    spread,  // how far apart two dowels can stand in each joint, in [0, 1]: the default
    ratio    // of Chopper: area of a section's component / area of its dowels, up to 100
};

// The dowels that connector counts (segment/joint/dowel.h), and the grid of places that is asked.
struct ConnectorOptions {
    ConnectorForm form = ConnectorForm::spread;
    double diameter = 8;  // mm, of the holes
    double depth = 22;    // of a hole in each of the two pieces
    double wall = 6;      // least material beside and below a hole
    double spacing = 5;   // of the grid
    bool operator==(const ConnectorOptions&) const = default;
    double clearance() const { return diameter / 2 + wall; }
};

struct Objectives {
    Weights weights;
    double face_ratio_threshold = 1.5;  // r: up to this ratio of most to fewest faces the cost is 0
    FragilityForm fragility_form = FragilityForm::thinness;
    double fragility_distance = 20;  // d, mm: surface nearer to a plane counts
    bool undercut_by_area = true;    // false: every triangle counts 1 (thesis 5.3.1)
    TermScope scope = TermScope::whole;
    double tilt_deg = 60;                   // largest tilt of the tool, for unreachable
    double fragment_volume_mm3 = 0;         // smaller solids are fragments and enter no objective
    std::optional<Vec3> print_volume = {};  // box that every part is to fit, mm; parts and utilization need it
    TermScope utilization_scope = TermScope::cut;
    ConnectorOptions connector = {};
    std::optional<Plane> symmetry_plane = {};  // of the uncut scan; symmetry needs it
    std::vector<std::string> forbidden = {};   // keys: a cut whose value is 1 or more is taken only if no other is left
    bool operator==(const Objectives&) const = default;
    // What is evaluated beside the solids, because it has a weight.
    bool needs_sizes() const { return print_volume && (weights.parts > 0 || weights.utilization > 0 || needs_seam()); }
    bool needs_seam() const { return weights.seam > 0; }
    bool needs_connector() const { return weights.connector > 0; }
    bool needs_symmetry() const { return weights.symmetry > 0 && symmetry_plane; }
    bool needs_structure() const { return weights.structure > 0; }
};

// The values of one piece that enter the objectives.
struct PieceShare {
    std::size_t faces = 0;
    double undercut = 0.5;
    double unreachable_mm2 = 0;
    double boxes = 0;  // how many print volumes it needs, print_boxes()
    double volume_mm3 = 0;
};

// What the uncut scan and its older cuts add to the terms of a cut.
struct ScanShare {
    double diagonal_mm = 0;  // of the oriented box of the uncut scan; above 0 where seam has a weight
    double boxes = 1;        // print volumes that its solids need together; 1 without a print volume
    double seam_mm = 0;  // of the older cuts, each once and once more for each box but one of the other pieces it made
};

// The least number of print volumes that a part of this size needs; 0 without one. A length may exceed whole boxes by a
// ten-thousandth of a box, so that a nudge does not count.
double print_boxes(Vec3 size, const Objectives& objectives);

// The share of downward surface on one base, downward / all, by area or by count; 0 if there is none. In [0, 1/2) by
// area for a closed solid (tests/segment/objectives/sweep/reference_test.cpp).
double undercut(const BaseShare& share, bool by_area);
// The least over the bases that the solid still owns; 1/2 if it owns none.
double undercut(const SolidEvaluation& solid, bool by_area);

PieceShare share(const SolidEvaluation& solid, const Objectives& objectives);

// The terms of a cut with this evaluation, among the other pieces of the segmentation. Nothing if it leaves fewer than
// two pieces, fragments not counted, or no cap area: then it is no candidate.
std::optional<Terms> terms(const CutEvaluation& evaluation, std::span<const PieceShare> others,
                           const Objectives& objectives, const ScanShare& scan = {});

// Whether a forbidden objective has a value of 1 or more.
bool is_forbidden(const Terms& terms, const Objectives& objectives);

}  // namespace qchopper
