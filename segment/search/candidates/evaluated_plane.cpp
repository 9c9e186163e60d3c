// The cost is that of the sweeps (sweep.h).

#include "segment/search/candidates/evaluated_plane.h"

#include <algorithm>
#include <utility>

#include "segment/objectives/sweep/sweep.h"

namespace qchopper {

std::size_t count_evaluated(std::span<const PlanesOfNormal> planes, TermStage stage) {
    std::ptrdiff_t count = 0;
    for (const PlanesOfNormal& of_normal : planes) {
        count += std::count_if(of_normal.begin(), of_normal.end(),
                               [stage](const EvaluatedPlane& plane) { return plane.stage >= stage; });
    }
    return static_cast<std::size_t>(count);
}

void evaluate(std::span<EvaluatedPlane* const> planes, TermStage to, const PreparedPiece& prepared,
              const Objectives& objectives) {
    if (planes.empty()) return;
    const Vec3 normal = planes.front()->candidate.plane.normal;
    const TermStage from = planes.front()->stage;
    std::vector<double> offsets;
    std::vector<std::optional<CutEvaluation>> evaluations;
    for (EvaluatedPlane* plane : planes) {
        offsets.push_back(plane->candidate.plane.offset);
        evaluations.push_back(std::move(plane->evaluation));
    }
    if (from < TermStage::solids) evaluations = sweep_solids(prepared, normal, offsets);
    if (from < TermStage::fragility && to >= TermStage::fragility) {
        add_fragility(prepared, normal, offsets, objectives, evaluations);
    }
    if (to == TermStage::whole) add_section_terms(prepared, normal, offsets, objectives, evaluations);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        planes[i]->evaluation = std::move(evaluations[i]);
        planes[i]->stage = to;
    }
}

}  // namespace qchopper
