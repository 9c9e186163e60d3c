// The evaluation of a cut: the values from which all objectives follow without cutting.
//
// A change of weights, thresholds or of the other pieces needs no new evaluation
// (tests/segment/search/evaluation_cache_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

// BaseShare::cut of the cut that is being evaluated. The largest number, so that its base comes last.
constexpr std::int32_t new_cut = std::numeric_limits<std::int32_t>::max();

// One solid on one base: sums of |n.up| over its triangles that do not belong to the base, downward ones and all, each
// weighted by area (mm2) and by 1. The sweep fills in only the kind that its objectives use.
struct BaseShare {
    std::int32_t cut = 0;  // number of the cut that made the base
    double down_mm2 = 0;
    double all_mm2 = 0;
    double down_count = 0;
    double all_count = 0;
};

struct SolidEvaluation {
    std::size_t faces = 0;
    double volume_mm3 = 0;
    bool above = false;            // it lies above the plane
    std::vector<BaseShare> bases;  // of the cuts whose cap the solid owns, ascending
    Vec3 size = {};  // along the axes of the oriented box of the piece that is cut; zero if it is not evaluated
};

// What no tool reaches of the two sides of a plane, in mm2, on samples.
struct CutAccess {
    double unreachable_mm2 = 0;
    double scan_area_mm2 = 0;  // above 0
};

struct CutEvaluation {
    std::vector<SolidEvaluation> solids;  // those above first
    double cap_area_mm2 = 0;
    double fragility = 0;  // in the form of the objectives
    std::optional<CutAccess> access;
    double seam_mm = 0;                 // length of the section's outline, each point by its cost (Piece::seam_cost)
    double connector = 0;               // connector_sweep.h, in the form of the objectives
    double symmetry_mm = 0;             // symmetry_sweep.h
    double structure = 0;               // SectionStress::value of the plane (segment/structure/section_stress.h)
    std::uint32_t coarse_sections = 0;  // of its sections those too coarse for that
};

}  // namespace qchopper
