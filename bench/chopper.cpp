// Measures the planes of Chopper: what finding the symmetry plane costs beside the tree for rays, and what evaluating
// 132 normals x 200 offsets costs beside one real cut of the same mesh. CPU time of one thread; the tree is built on
// threads of a library, whose time is added up.

#include <optional>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/rays.h"
#include "segment/score/evaluate.h"
#include "segment/score/symmetry_plane.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_chopper [--small] [--data FOLDER] [--only GROUP]...
  --small  the sample skull with 20,000 faces instead, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply lies; without it the sample skull with 1.9 million faces is taken
  --only   symmetry, planes; all if none is named
)";

constexpr int runs = 3;

void measure_symmetry(const Measured& measured, Figures& figures) {
    const TriangleMesh& mesh = *measured.piece.mesh;
    const double tree = best_of(runs, process_cpu_s, [&] { return RayTree(mesh); });
    std::optional<SymmetryPlane> found;
    const double time = best_of(runs, process_cpu_s, [&] {
        found = symmetry_plane(mesh);
        return found->score_mm;
    });
    figures.record(measured.name, "tree for rays", time_text(tree));
    figures.record(measured.name, "symmetry plane, refined", time_text(time));
    figures.at_most(measured.name, "symmetry plane / tree for rays", time / tree, 2);
    figures.record(measured.name, "its score / spacing of the samples", number_text(found->ratio()));
}

void measure_planes(const Measured& measured, Figures& figures) {
    CandidateOptions options;
    options.normals = CandidateNormals::sphere;
    options.offset_step_mm = 1e-3;  // a two-hundredth of every extent
    std::vector<Candidate> candidates;
    const double proposing = best_of(1, cpu_s, [&] {
        candidates = candidate_planes(measured.piece, options);
        return candidates.size();
    });
    const std::string count = number_text(static_cast<double>(candidates.size()));
    figures.record(measured.name, "proposing " + count + " planes, box and nudge included", time_text(proposing));
    Objectives objectives;
    objectives.fragility_form = FragilityForm::thesis;
    const double evaluating =
        best_of(1, cpu_s, [&] { return evaluate_all(measured.piece, candidates, objectives, Context{}); });
    figures.record(measured.name, "evaluating them, fragility of the thesis", time_text(evaluating));
    const Plane middle = candidates[candidates.size() / 2].plane;
    const double cutting = best_of(runs, cpu_s, [&] { return cut_piece(measured.piece, middle, 1); });
    figures.record(measured.name, "one real cut", time_text(cutting));
    figures.record(measured.name, "evaluating one plane / one real cut",
                   number_text(evaluating / static_cast<double>(candidates.size()) / cutting));
}

void measure_specimen(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const auto head = choice.is_small ? nullptr : scan(choice.data / "ct_head_1912k.ply", 1);
    const Measured measured =
        head ? biggest("ct_head", *head) : one_shell("skull", Specimen::skull, choice.is_small ? 20'000 : 1'900'000);
    if (choice.wants("symmetry")) measure_symmetry(measured, figures);
    if (choice.wants("planes")) measure_planes(measured, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure_specimen);
}
