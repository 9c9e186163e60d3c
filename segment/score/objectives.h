// The objectives of a cut and their weighted sum; lower is better: the four of the thesis (Nicholson 2016, section 4.2)
// and the surface that no tool reaches (unreachable.h).
//
// Invariants: tests/segment/score/objectives_test.cpp.

#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "segment/score/cut_evaluation.h"

namespace qchopper {

struct Weights {
    double face_ratio = 10;
    double fragility = 5;
    double piece_count = 50;
    double undercut = 10;
    double unreachable = 0;  // above 0 the pieces need samples (sampled_piece.h)
    bool operator==(const Weights&) const = default;
};

// Over which pieces face ratio and undercut are taken.
enum class TermScope {
    whole,  // all of the segmentation, as in the thesis
    cut     // those that the newest cut makes: a small solid elsewhere does not drown every other term
};

enum class FragilityForm {
    thinness,  // scale-free, in [0, 2]: the default
    thesis     // as printed in the thesis, in mm: for comparison
};

struct Objectives {
    Weights weights;
    double face_ratio_threshold = 1.5;  // r: up to this ratio of most to fewest faces the cost is 0
    FragilityForm fragility_form = FragilityForm::thinness;
    double fragility_distance = 20;  // d, mm: surface nearer to a plane counts
    bool undercut_by_area = true;    // false: every triangle counts 1 (thesis 5.3.1)
    TermScope scope = TermScope::whole;
    double tilt_deg = 60;            // largest tilt of the tool, for unreachable
    double fragment_volume_mm3 = 0;  // smaller solids are fragments and enter no objective
    bool operator==(const Objectives&) const = default;
};

// One candidate's or one cut's four values, not yet weighted, and their weighted sum.
struct Terms {
    double face_ratio = 0;
    double fragility = 0;
    double piece_count = 0;
    double undercut = 0;
    double unreachable = 0;  // share of the scan's area, over all pieces; 0 without samples
    double total = 0;
    bool operator==(const Terms&) const = default;
};

// The values of one piece that enter the objectives.
struct PieceShare {
    std::size_t faces = 0;
    double undercut = 0.5;
    double unreachable_mm2 = 0;
};

// The share of downward surface on one base, downward / all, by area or by count; 0 if there is none. In [0, 1/2) by
// area for a closed solid (tests/segment/score/reference_test.cpp).
double undercut(const BaseShare& share, bool by_area);
// The least over the bases that the solid still owns; 1/2 if it owns none.
double undercut(const SolidEvaluation& solid, bool by_area);

PieceShare share(const SolidEvaluation& solid, const Objectives& objectives);

// The terms of a cut with this evaluation, among the other pieces of the segmentation. Nothing if it leaves fewer than
// two pieces, fragments not counted, or no cap area: then it is no candidate.
std::optional<Terms> terms(const CutEvaluation& evaluation, std::span<const PieceShare> others,
                           const Objectives& objectives);

}  // namespace qchopper
