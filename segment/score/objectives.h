// The four objectives of a cut and what is weighed with what (Nicholson 2016, section 4.2; spec: lower is better).

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
    bool operator==(const Weights&) const = default;
};

enum class FragilityForm {
    thinness,  // scale-free, in [0, 2]: the default
    thesis     // as printed in the thesis, in mm: for comparison
};

struct Objectives {
    Weights weights;
    double face_ratio_threshold = 1.5;  // r: pieces this uneven cost nothing yet
    FragilityForm fragility_form = FragilityForm::thinness;
    double fragility_distance = 20;  // d, mm: how near to a plane surface counts
    bool undercut_by_area = true;    // false: every triangle counts 1 (thesis 5.3.1)
    double fragment_volume_mm3 = 0;  // solids below are fragments and enter no objective
    bool operator==(const Objectives&) const = default;
};

// One candidate's or one cut's four values, not yet weighted, and their weighted sum.
struct Terms {
    double face_ratio = 0;
    double fragility = 0;
    double piece_count = 0;
    double undercut = 0;
    double total = 0;
    bool operator==(const Terms&) const = default;
};

// What a piece that is not being cut brings into the objectives.
struct PieceShare {
    std::size_t faces = 0;
    double undercut = 0.5;
};

// u(phi) for one base (spec 3.4). In [0, 1/2) by area.
double undercut(const BaseShare& share, bool by_area);
// The least over the bases that the solid still owns; 1/2 if it owns none.
double undercut(const SolidEvaluation& solid, bool by_area);

PieceShare share(const SolidEvaluation& solid, const Objectives& objectives);

// The terms of a cut with this evaluation beside the other pieces of the segmentation. Nothing if it leaves fewer than
// two pieces that are more than fragments, or no cap area: then it is no candidate.
std::optional<Terms> terms(const CutEvaluation& evaluation, std::span<const PieceShare> others,
                           const Objectives& objectives);

}  // namespace qchopper
