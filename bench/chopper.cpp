// Measures the planes and joints of Chopper: what finding the symmetry plane costs beside the tree for rays, what
// evaluating 132 normals x 200 offsets costs beside one real cut of the same mesh, and what all joints of 20 pieces
// cost beside the last decision. CPU time of one thread; the tree is built on threads of a library, whose time is added
// up.

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "segment/cut/cut_piece.h"
#include "segment/joint/piece_joints.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/rays.h"
#include "segment/objectives/seam_cost.h"
#include "segment/objectives/symmetry_plane.h"
#include "segment/search/candidates/evaluate.h"
#include "segment/search/rank.h"
#include "segment/search/search.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_chopper [--small] [--data FOLDER] [--only GROUP]...
  --small  the sample skull with 20,000 faces instead, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply lies; without it the sample skull with 1.9 million faces is taken
  --only   symmetry, planes, joints; all if none is named
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

Segmentation one_metre(const Measured& measured) {
    TriangleMesh mesh = *measured.piece.mesh;
    const Vec3 size = bounds(mesh).size();
    const double scale = 1000 / std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh.points) p = scale * p;
    Segmentation s = uncut(mesh, scale * scale * scale * measured.fragment_volume_mm3);
    s.scan = measure_scan(s);
    find_seam_costs(s.pieces);
    return s;
}

SearchSettings chopper(const TriangleMesh& scan) {
    SearchSettings settings;
    settings.candidates.normals = CandidateNormals::sphere;
    settings.candidates.offset_step_mm = 5;
    settings.candidates.symmetry = symmetry_plane(scan);
    Objectives& o = settings.objectives;
    o.weights = {0, 1, 0, 0, 0, 1, 0.05, 1, 0.1, 0.25};
    o.fragility_form = FragilityForm::binary;
    o.scope = TermScope::cut;
    o.print_volume = Vec3{400, 400, 400};
    o.symmetry_plane = settings.candidates.symmetry->plane;
    return settings;
}

// The pieces are those of a search with the four terms of the thesis; its last decision is repeated with Chopper's.
void measure_joints(const Measured& measured, std::size_t pieces, Figures& figures) {
    Segmentation now = one_metre(measured);
    SearchSettings chosen = chopper(*now.pieces.front().mesh);
    SearchSettings settings;
    settings.stop.min_cuts = 10 * static_cast<int>(pieces);
    Segmentation before = now;
    Segmentation made = now;
    std::atomic<bool> is_enough = false;
    Context context;
    context.cancelled = &is_enough;
    EvaluationCache cache(settings.objectives, settings.candidates);
    try {
        search(
            now, settings, cache, {},
            [&](const Segmentation& s) {
                before = std::exchange(made, s);
                is_enough = s.pieces.size() >= pieces;
            },
            context);
    } catch (const Cancelled&) {  // there are enough pieces
    }
    std::size_t faces = 0;
    std::size_t parted = 0;
    while (before.pieces[parted].name != made.cuts.back().piece) ++parted;
    const double deciding = best_of(1, cpu_s, [&] {
        EvaluationCache fresh(chosen.objectives, chosen.candidates);
        return rank(before, parted, chosen, fresh, {}, 1).size();
    });
    std::vector<PieceJoint> joints;
    const double placing = best_of(runs, cpu_s, [&] {
        joints = piece_joints(made.pieces, {});
        return joints.size();
    });
    for (const Piece& piece : made.pieces) faces += piece.mesh->triangles.size();
    const auto held =
        std::count_if(joints.begin(), joints.end(), [](const PieceJoint& j) { return j.dowels.size() > 1; });
    figures.record(measured.name,
                   "last decision with Chopper's terms, 1 m, of " +
                       number_text(static_cast<double>(before.pieces[parted].mesh->triangles.size())) + " of " +
                       number_text(static_cast<double>(faces)) + " faces",
                   time_text(deciding));
    figures.record(measured.name,
                   "all " + std::to_string(joints.size()) + " joints of " + std::to_string(made.pieces.size()) +
                       " pieces, " + std::to_string(held) + " with two dowels",
                   time_text(placing));
    figures.at_most(measured.name, "joints / last decision", placing / deciding, 1);
}

void measure_specimen(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const auto head = choice.is_small ? nullptr : scan(choice.data / "ct_head_1912k.ply", 1);
    const Measured measured =
        head ? biggest("ct_head", *head) : one_shell("skull", Specimen::skull, choice.is_small ? 20'000 : 1'900'000);
    if (choice.wants("symmetry")) measure_symmetry(measured, figures);
    if (choice.wants("planes")) measure_planes(measured, figures);
    if (choice.wants("joints")) measure_joints(measured, choice.is_small ? 6 : 20, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure_specimen);
}
