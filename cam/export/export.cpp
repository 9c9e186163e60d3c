// Gathers what the writers of segment/io need. O(faces); memory for one copy of the meshes where they are moved.

#include "cam/export/export.h"

#include <array>
#include <vector>

#include "base/error.h"
#include "segment/io/write_3mf.h"
#include "segment/io/write_glb.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 4> names{"3mf", "stl", "ply", "glb"};  // in the order of ExportFormat

Bytes as_3mf(std::span<const ExportPiece> pieces, const ExportNotes& notes) {
    std::vector<Solid3mf> solids;
    for (const ExportPiece& piece : pieces) solids.push_back({piece.name, piece.mesh.get(), piece.pose});
    return to_3mf(solids, {{"Title", notes.title}, {"Application", "qchopper " + notes.program_version}});
}

std::vector<GlbNote> glb_notes(const ExportPiece& piece, const ExportNotes& notes) {
    std::vector<GlbNote> made{{"id", piece.name}, {"step", piece.step}, {"unit", std::string("mm")}};
    if (!piece.parent.empty()) made.emplace_back("parent", piece.parent);
    if (piece.fits) made.emplace_back("fits", *piece.fits);
    made.emplace_back("scan_sha256", to_hex(notes.scan_sha256));
    return made;
}

// GLB is single precision: coordinates are relative to the middle of each piece.
Bytes as_glb(std::span<const ExportPiece> pieces, const ExportNotes& notes) {
    std::vector<TriangleMesh> meshes;
    GlbScene scene{"qchopper " + notes.program_version, notes.title, {}};
    for (const ExportPiece& piece : pieces) {
        TriangleMesh lying = apply(piece.pose, *piece.mesh);
        GlbNode node;
        node.name = "piece/" + piece.name;
        node.origin = bounds(lying).centre();
        for (Vec3& p : lying.points) p = p - node.origin;
        node.surface = piece.colour;
        node.notes = glb_notes(piece, notes);
        node.keys = piece.moves;
        meshes.push_back(std::move(lying));
        scene.nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < meshes.size(); ++i) scene.nodes[i].mesh = &meshes[i];
    return to_glb(scene);
}

}  // namespace

ExportFormat export_format_named(std::string_view name) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name) return static_cast<ExportFormat>(i);
    }
    throw InputError(InputFault::use, std::string(name) + " is no format to export to", "name 3mf, stl, ply or glb");
}

bool holds_many(ExportFormat format) {
    return format == ExportFormat::threemf || format == ExportFormat::glb;
}

void stand_in_a_row(std::span<ExportPiece> pieces, double gap) {
    double end = 0;
    for (ExportPiece& piece : pieces) {
        const Box box = bounds(apply(piece.pose, *piece.mesh));
        piece.pose.shift.x += end - box.min.x;
        end += box.size().x + gap;
    }
}

Bytes export_file(ExportFormat format, std::span<const ExportPiece> pieces, const ExportNotes& notes) {
    return format == ExportFormat::threemf ? as_3mf(pieces, notes) : as_glb(pieces, notes);
}

Bytes export_file(ExportFormat format, const ExportPiece& piece) {
    if (piece.pose == Pose{}) return format == ExportFormat::stl ? to_stl(*piece.mesh) : to_ply(*piece.mesh);
    const TriangleMesh lying = apply(piece.pose, *piece.mesh);
    return format == ExportFormat::stl ? to_stl(lying) : to_ply(lying);
}

}  // namespace qchopper
