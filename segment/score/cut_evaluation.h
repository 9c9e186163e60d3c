// What a cut would make: the ingredients from which all objectives follow without cutting again.
//
// A change of weights, thresholds or of the other pieces needs no new evaluation.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace qchopper {

// How one solid looks on one base: sums over its triangles off that base of |n.up| A, downward ones and all, by area
// in mm2 and with every triangle counting 1.
struct BaseShare {
    std::int32_t cut = 0;
    double down_mm2 = 0;
    double all_mm2 = 0;
    double down_count = 0;
    double all_count = 0;
};

struct SolidEvaluation {
    std::size_t faces = 0;
    double volume_mm3 = 0;
    bool above = false;
    std::vector<BaseShare> bases;  // only cuts whose cap the solid still owns, ascending
};

struct CutEvaluation {
    std::vector<SolidEvaluation> solids;  // those above first
    double cap_area_mm2 = 0;
    double fragility = 0;  // in the form that was asked for
};

}  // namespace qchopper
