// Marks are mapped by nearest points (segment/import/map_painted.h), the inside is found by rays (inside.h of
// segment/access); a triangle is ignored if either says so.

#include "app/store/ignored_surface.h"

#include <algorithm>

#include "app/store/painted_scan.h"
#include "app/store/project_lines.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/text.h"
#include "base/timings.h"
#include "segment/access/inside.h"
#include "segment/import/map_painted.h"
#include "segment/io/read_painted.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double min_left = 0.001;  // of the area: with less there is nothing to mill

double ignored_share(const TriangleMesh& scan) {
    double ignored = 0;
    double all = 0;
    for (std::size_t t = 0; t < scan.triangles.size(); ++t) {
        const double area = norm(area_vector(scan, t));
        all += area;
        if (is_ignored(scan, t)) ignored += area;
    }
    return all > 0 ? ignored / all : 0;
}

}  // namespace

std::optional<PaintedScan> read_painted(const ProjectChoices& choices) {
    if (!choices.ignore.painted) return std::nullopt;
    const Bytes bytes = read_file(*choices.ignore.painted);
    return PaintedScan{parse_painted_ply(bytes, choices.ignore.painted->string()), sha256(bytes)};
}

std::optional<IgnoredSurface> ignore_surface(const ProjectChoices& choices, std::optional<PaintedScan> painted,
                                             ImportedScan& imported, const Context& context) {
    if (!painted && !choices.ignore.inside) return std::nullopt;
    const StageTimer stage(context, "ignored surface found");
    TriangleMesh& scan = imported.mesh;
    IgnoredSurface ignored;
    ignored.inside = choices.ignore.inside;
    std::vector<std::uint8_t> flags(scan.triangles.size());
    if (painted) {
        ignored.painted = fs::absolute(*choices.ignore.painted);
        place_on_scan(painted->mesh, imported.mm_per_unit * choices.scale, imported.centre);
        if (painted->sha256 != imported.sha256) {
            check_is_of_scan(painted->mesh, scan, choices.ignore.painted->string());
        }
        flags = mapped_marks(painted->mesh, scan);
        painted.reset();
    }
    if (choices.ignore.inside) {
        const std::vector<std::uint8_t> inside = inside_surface(scan, context);
        std::transform(flags.begin(), flags.end(), inside.begin(), flags.begin(),
                       [](std::uint8_t a, std::uint8_t b) { return std::max(a, b); });
    }
    scan.ignored = std::move(flags);
    ignored.share = ignored_share(scan);
    if (ignored.share > 1 - min_left) {
        throw InputError(InputFault::mesh, "all of the scan's surface would be ignored",
                         "paint only what may stay as it is");
    }
    if (ignored.share == 0) {
        scan.ignored.clear();
        imported.report.warnings.emplace_back(
            ignored.painted.empty() ? "No surface is ignored: none lies inside."
                                    : "No surface is ignored: none is painted (docs/user/ignored-surface.md).");
        return std::nullopt;
    }
    ignored.sha256 = sha256(scan.ignored);
    context.message(ignored_line(ignored) + ".");
    return ignored;
}

TriangleMesh scan_of_project(const fs::path& folder, const Project& project, const Context& context) {
    TriangleMesh scan = std::move(import_project_scan(project, context).mesh);
    if (!project.ignored) return scan;
    const fs::path file = folder / ignored_file;
    Bytes flags;
    std::error_code error;
    if (fs::exists(file, error)) flags = read_file(file, record_limit);
    if (flags.size() != scan.triangles.size() || sha256(flags) != project.ignored->sha256) {
        throw InputError(InputFault::config, file.string() + " is not what the project wrote",
                         "restore the file, or prepare the scan again");
    }
    scan.ignored = std::move(flags);
    return scan;
}

}  // namespace qchopper
