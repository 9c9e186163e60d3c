// A binary file per piece: the fields in the order of the structs, in the byte order of the machine, then a SHA-256.
// O(triangles) for the name, O(candidates) for the content.

#include "app/store/caches/evaluation_store.h"

#include <cassert>

#include "app/store/caches/cache_file.h"
#include "segment/structure/stress.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// To be raised whenever candidates or evaluations of the same piece change.
constexpr std::uint32_t version_of_evaluations = 5;

void put(CacheWriter& out, const BaseShare& b) {
    out.put(b.cut);
    for (const double x : {b.down_mm2, b.all_mm2, b.down_count, b.all_count}) out.put(x);
}

void put(CacheWriter& out, const CutEvaluation& evaluation) {
    out.put(evaluation.cap_area_mm2);
    out.put(evaluation.fragility);
    for (const double x : {evaluation.seam_mm, evaluation.connector, evaluation.symmetry_mm, evaluation.structure})
        out.put(x);
    out.put(evaluation.coarse_sections);
    out.put(evaluation.solids.size());
    for (const SolidEvaluation& solid : evaluation.solids) {
        out.put(solid.faces);
        out.put(solid.volume_mm3);
        for (const double x : {solid.size.x, solid.size.y, solid.size.z}) out.put(x);
        out.put(static_cast<std::uint8_t>(solid.above));
        out.put(solid.bases.size());
        for (const BaseShare& base : solid.bases) put(out, base);
    }
}

CutEvaluation evaluation_from(CacheReader& in) {
    CutEvaluation evaluation;
    evaluation.cap_area_mm2 = in.get<double>();
    evaluation.fragility = in.get<double>();
    for (double* x : {&evaluation.seam_mm, &evaluation.connector, &evaluation.symmetry_mm, &evaluation.structure})
        *x = in.get<double>();
    evaluation.coarse_sections = in.get<std::uint32_t>();
    evaluation.solids.resize(in.count());
    for (SolidEvaluation& solid : evaluation.solids) {
        solid.faces = in.get<std::size_t>();
        solid.volume_mm3 = in.get<double>();
        for (double* x : {&solid.size.x, &solid.size.y, &solid.size.z}) *x = in.get<double>();
        solid.above = in.get<std::uint8_t>() != 0;
        solid.bases.resize(in.count());
        for (BaseShare& b : solid.bases) {
            b.cut = in.get<std::int32_t>();
            for (double* x : {&b.down_mm2, &b.all_mm2, &b.down_count, &b.all_count}) *x = in.get<double>();
        }
    }
    return evaluation;
}

CacheWriter content_of(const PieceEvaluations& evaluations) {
    CacheWriter out;
    assert(evaluations.candidates.size() == evaluations.evaluations.size());
    out.put(evaluations.candidates.size());
    for (std::size_t i = 0; i < evaluations.candidates.size(); ++i) {
        const Candidate& c = evaluations.candidates[i];
        out.put(c.plane);
        out.put(c.wanted_offset);
        out.put(c.normal_index);
        out.put(c.offset_index);
        out.put(static_cast<std::uint8_t>(evaluations.evaluations[i].has_value()));
        if (evaluations.evaluations[i]) put(out, *evaluations.evaluations[i]);
    }
    return out;
}

std::optional<PieceEvaluations> found_in(const fs::path& file) {
    const std::optional<Bytes> bytes = kept(file);
    if (!bytes) return std::nullopt;
    CacheReader in(*bytes);
    PieceEvaluations evaluations;
    evaluations.candidates.resize(in.count());
    for (Candidate& c : evaluations.candidates) {
        for (double* x : {&c.plane.normal.x, &c.plane.normal.y, &c.plane.normal.z, &c.plane.offset, &c.wanted_offset})
            *x = in.get<double>();
        c.normal_index = in.get<int>();
        c.offset_index = in.get<int>();
        evaluations.evaluations.emplace_back();
        if (in.get<std::uint8_t>() != 0) evaluations.evaluations.back() = evaluation_from(in);
    }
    if (!in.is_whole()) return std::nullopt;
    return evaluations;
}

void put(CacheWriter& out, const CandidateOptions& options) {
    const bool is_sphere = options.normals == CandidateNormals::sphere;
    out.put_all(std::vector<double>{static_cast<double>(options.offsets_per_normal), is_sphere ? 1.0 : 0.0,
                                    options.offset_step_mm.value_or(0)});
    if (options.no_cut.points) out.put_all(*options.no_cut.points);
}

fs::path file_for(const fs::path& folder, const std::string& settings, const Piece& piece) {
    CacheWriter out;
    out.put(settings);
    out.put_all(piece.mesh->points);
    out.put_all(piece.mesh->triangles);
    out.put_all(piece.mesh->cap_of);
    if (piece.seam_cost) out.put_all(*piece.seam_cost);
    if (piece.stress) {
        out.put(piece.stress->strength_mpa);
        out.put_all(piece.stress->voxels);
        out.put_all(piece.stress->stress);
    }
    for (const HalfSpace& half_space : piece.half_spaces) {
        out.put(half_space.cut);
        out.put(half_space.plane);
        out.put(static_cast<std::uint8_t>(half_space.above));
    }
    return cache_file(folder, out, ".evaluations");
}

}  // namespace

EvaluationStore evaluation_store(const fs::path& folder, const Objectives& objectives,
                                 const CandidateOptions& options) {
    CacheWriter w;
    w.put(version_of_evaluations);
    w.put(static_cast<int>(objectives.fragility_form));
    w.put(objectives.fragility_distance);
    w.put(static_cast<std::uint8_t>(objectives.undercut_by_area));
    put(w, options);
    w.put(static_cast<std::uint8_t>(objectives.needs_sizes()));
    w.put(static_cast<std::uint8_t>(objectives.needs_seam()));
    if (objectives.needs_connector()) {
        const ConnectorOptions& c = objectives.connector;
        w.put(static_cast<int>(c.form));
        for (const double x : {c.diameter, c.depth, c.wall, c.spacing}) w.put(x);
    }
    w.put(static_cast<std::uint8_t>(objectives.needs_symmetry()));
    if (objectives.needs_symmetry()) w.put(*objectives.symmetry_plane);
    const std::string settings(w.bytes().begin(), w.bytes().end());
    EvaluationStore store;
    store.find = [=](const Piece& piece) { return found_in(file_for(folder, settings, piece)); };
    store.keep = [=](const Piece& piece, const PieceEvaluations& evaluations) {
        keep(file_for(folder, settings, piece), content_of(evaluations));
    };
    return store;
}

}  // namespace qchopper
