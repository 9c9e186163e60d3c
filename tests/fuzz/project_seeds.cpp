// Two projects, a plan, a file of kept evaluations, a display mesh and its states.

#include <filesystem>
#include <memory>

#include "app/display/display_format.h"
#include "app/store/caches/evaluation_store.h"
#include "app/store/plan.h"
#include "app/store/project_json.h"
#include "base/sha256.h"
#include "tests/fuzz/memory_folder.h"
#include "tests/fuzz/seeds.h"

namespace qchopper {
namespace {

Ranked some_rank(int number) {
    return {{{0, 0.6, 0.8}, 1.25 * number}, 1.5, 3, number, {0.1, 0.2, 0.3, 0.4, 1.0}};
}

Project some_project() {
    Project project;
    project.scan = {"/scans/a bone.ply", sha256({}), Unit::cm, 0.5, {1, 2.5, 1.0 / 3}, 12, 1000, {"scaled"}};
    project.preset = "bunny";
    project.settings.stop.min_cuts = 3;
    project.settings.stop.max_faces = 200;
    project.settings.stop.max_obb = Vec3{1, 2, 3};
    project.settings.stop.max_unreachable = 0.02;
    project.history.weights_at_start = project.settings.objectives.weights;
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen = some_rank(4);
    cut.candidates = 120;
    cut.pieces = {"B", "C"};
    cut.fragments = 1;
    cut.runners_up = {some_rank(5)};
    project.history.decisions = {WeightsChange{{1, 2, 3, 0.1}}, cut, Reset{}};
    project.history.committed = 2;
    project.cuts = committed_cuts(project.history);
    project.pieces = {{"B", 1, 8, 600, {0, 0, 1}}, {"C", 1, 8, 399, {0, 0, -1}}};
    project.fragment_list = {{"", 1, 4, 1, {0, 0, 0}}};
    project.warnings = {"scaled"};
    project.beam = BeamState{1, {}, {{0, {"B"}, {{"B", 3, 812, 790.5, false}}}}, {}};
    return project;
}

Plan some_plan() {
    Plan plan;
    plan.scan = {"bone.ply", std::string(64, 'a'), Unit::mm, 1, {1, 2, 3}, 12, 1000, {{0, 0, 0}, {2, 4, 6}}};
    PlanCut first;
    first.piece = "A";
    first.inside = {1, 2, 3};
    first.volume_mm3 = 1000;
    first.number = 1;
    first.plane = {{0, 0, 1}, 5.5};
    first.from_centre = 2.5;
    first.makes_mm3 = {600, 400};
    PlanCut second = first;
    second.number = 2;
    second.piece = "B";
    second.path = {{1, true}};
    plan.cuts = {first, second};
    PlanDiscard discard;
    static_cast<PlanPiece&>(discard) = second;
    discard.after = 2;
    plan.discards = {discard};
    return plan;
}

// The file without the SHA-256 at its end, which the fuzzer appends.
Bytes some_evaluations() {
    const MemoryFolder folder;
    PieceEvaluations evaluations;
    evaluations.candidates = {{{{0, 0, 1}, 2}, 2.5, 0, 1}, {{{0, 1, 0}, 3}, 3, 1, 0}};
    CutEvaluation evaluation;
    evaluation.solids = {{}, {}};
    evaluation.solids[0].bases = {{}};
    evaluations.evaluations = {evaluation, std::nullopt};
    const Piece piece{"A", std::make_shared<const TriangleMesh>(), {}};
    evaluation_store(folder.path, {}, {}).keep(piece, evaluations);
    Bytes bytes = read_file(std::filesystem::directory_iterator(folder.path)->path());
    bytes.resize(bytes.size() - sizeof(Sha256));
    return bytes;
}

DisplayMesh some_display_mesh() {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    mesh.cap_of = {2, no_cap, no_cap, 5};
    return display_mesh(mesh, display_grid({{-1, -1, -1}, {9, 9, 9}}));
}

// As the fuzzer makes a head for it: three numbers in place of that of the file.
Bytes without_counts(const DisplayMesh& mesh) {
    Bytes bytes{static_cast<std::uint8_t>(mesh.points.size()), static_cast<std::uint8_t>(mesh.triangles.size()),
                static_cast<std::uint8_t>(mesh.groups.size())};
    const Bytes whole = encode_display_mesh(mesh);
    bytes.insert(bytes.end(), whole.begin() + 20, whole.end());
    return bytes;
}

Bytes to_bytes(const std::string& text) {
    return {text.begin(), text.end()};
}

}  // namespace

std::vector<Encoded> project_seeds() {
    const std::string project = to_json(some_project());
    const std::string plan = to_text(some_plan());
    // These throw if a seed is refused.
    project_from_json(project, "seed");
    plan_from_text(plan, "seed");
    return {{"project", "decided", to_bytes(project)},
            {"project", "new", to_bytes(to_json(Project{}))},
            {"plan", "two-cuts", to_bytes(plan)},
            {"evaluations", "two-candidates", some_evaluations()},
            {"display", "tetrahedron", encode_display_mesh(some_display_mesh())},
            {"display", "without-counts", without_counts(some_display_mesh())},
            {"display", "states", encode_display_states({std::string(32, 'a'), {0, 6, 4}})}};
}

}  // namespace qchopper
