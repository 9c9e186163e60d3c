// Marks are mapped by nearest points (segment/import/map_painted.h).

#include "app/store/no_cut_surface.h"

#include <cstring>

#include "app/store/painted_scan.h"
#include "app/store/project_lines.h"
#include "base/error.h"
#include "base/timings.h"
#include "segment/import/map_painted.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

}  // namespace

std::optional<NoCutMarks> read_no_cut(const ProjectChoices& choices) {
    if (!choices.no_cut) return std::nullopt;
    const Bytes bytes = read_file(*choices.no_cut);
    return NoCutMarks{parse_no_cut_ply(bytes, choices.no_cut->string()), sha256(bytes)};
}

std::optional<NoCutSurface> mark_no_cut(const ProjectChoices& choices, std::optional<NoCutMarks> marks,
                                        ImportedScan& imported, CandidateOptions& options, const Context& context) {
    if (!marks) return std::nullopt;
    const StageTimer stage(context, "surface that must not be cut found");
    TriangleMesh& painted = marks->points.mesh;
    place_on_scan(painted, imported.mm_per_unit * choices.scale, imported.centre);
    if (marks->sha256 != imported.sha256) check_is_of_scan(painted, imported.mesh, choices.no_cut->string());
    options.no_cut = no_cut_at(mapped_points(painted, marks->points.is_marked, imported.mesh));
    if (!options.no_cut.points) {
        imported.report.warnings.emplace_back(
            "All surface may be cut: none is painted (docs/user/candidate-planes.md).");
        return std::nullopt;
    }
    NoCutSurface record{fs::absolute(*choices.no_cut), options.no_cut.points->size(),
                        sha256(no_cut_bytes(options.no_cut))};
    context.message(no_cut_line(record) + ".");
    return record;
}

Bytes no_cut_bytes(const NoCut& no_cut) {
    if (!no_cut.points) return {};
    Bytes bytes(no_cut.points->size() * sizeof(Vec3));
    std::memcpy(bytes.data(), no_cut.points->data(), bytes.size());
    return bytes;
}

NoCut load_no_cut(const fs::path& folder, const NoCutSurface& record) {
    const fs::path file = folder / no_cut_file;
    Bytes bytes;
    std::error_code error;
    if (fs::exists(file, error)) bytes = read_file(file);
    if (bytes.size() != record.points * sizeof(Vec3) || sha256(bytes) != record.sha256) {
        throw InputError(InputFault::config, file.string() + " is not what the project wrote",
                         "restore the file, or prepare the scan again");
    }
    std::vector<Vec3> points(record.points);
    std::memcpy(points.data(), bytes.data(), bytes.size());
    return no_cut_at(std::move(points));
}

}  // namespace qchopper
