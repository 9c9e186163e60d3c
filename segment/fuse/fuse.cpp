// The cost is that of the alignment and of the lattice.

#include "segment/fuse/fuse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "base/text.h"
#include "segment/fuse/align.h"
#include "segment/fuse/distance_grid.h"
#include "segment/fuse/median.h"
#include "segment/fuse/scan_list.h"
#include "segment/fuse/scan_surface.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/submesh.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double longest_edge_spacings = 4;  // a longer one bridges a step in depth
constexpr std::size_t min_pairs = 30;        // fewer leave the pose of a scan free
constexpr double misfit = 3;                 // medians
constexpr double least_shell = 0.01;         // of the area of the largest

// The median length of the edges of a mesh that came without a grid.
double edge_length(const TriangleMesh& mesh) {
    std::vector<double> lengths;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const std::array<Vec3, 3> corner = corners_of(mesh, t);
        for (std::size_t i = 0; i < 3; ++i) lengths.push_back(norm(corner[(i + 1) % 3] - corner[i]));
    }
    return median(std::move(lengths));
}

struct ReadScan {
    ScanSurface surface;
    double spacing = 0;
};

ReadScan read(const fs::path& file, const std::string& name) {
    const Bytes bytes = read_scan(file);
    ReadScan scan;
    if (is_range_scan(bytes)) {
        const RangeScan grid = parse_range_scan(bytes, name);
        scan.spacing = grid_spacing(grid);
        scan.surface = scan_surface(name, triangulate(grid, longest_edge_spacings * scan.spacing), true);
    } else {
        ReadOptions options;
        options.weld = true;
        scan.surface = scan_surface(name, parse_mesh(bytes, name, {}, options).mesh, false);
        scan.spacing = edge_length(scan.surface.mesh);
    }
    if (scan.surface.mesh.triangles.empty() || scan.spacing <= 0) {
        throw InputError(InputFault::mesh, name + " has no surface: no three neighbours in its grid",
                         "leave this scan out of the list");
    }
    return scan;
}

std::vector<Pose> poses_of(const std::vector<PosedScan>& listed, bool is_other_sign) {
    std::vector<Pose> poses;
    poses.reserve(listed.size());
    for (const PosedScan& scan : listed) poses.push_back(is_other_sign ? scan.other : scan.pose);
    return poses;
}

// Leaves small shells out, and says how many.
std::size_t keep_large_shells(TriangleMesh& mesh) {
    const Shells found = shells(mesh);
    std::vector<double> area(found.count(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area[found.shell_of[t]] += norm(area_vector(mesh, t));
    const double least = least_shell * *std::ranges::max_element(area);
    std::vector<std::uint32_t> group_of;
    std::vector<bool> is_kept;
    for (const std::uint32_t shell : found.shell_of) is_kept.push_back(area[shell] >= least);
    const auto left_out = static_cast<std::size_t>(std::ranges::count_if(area, [&](double a) { return a < least; }));
    keep_triangles(mesh, is_kept);
    group_of.assign(mesh.triangles.size(), 0);
    mesh = std::move(submeshes(mesh, group_of, 1).front());
    return left_out;
}

void describe_scans(const std::vector<ScanSurface>& surfaces, const Alignment& alignment, FuseReport& report) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const AlignedScan& aligned = alignment.scans[i];
        const TriangleMesh& mesh = surfaces[i].mesh;
        if (aligned.pairs < min_pairs) {
            throw InputError(InputFault::mesh, surfaces[i].name + " overlaps no other scan where its pose puts it",
                             "correct its pose in the list, or leave the scan out");
        }
        report.scans.push_back({surfaces[i].name, mesh.points.size(), mesh.triangles.size(), aligned.pairs,
                                aligned.residual, aligned.residual <= misfit * alignment.residual, aligned.pose});
    }
}

double missing_share(const TriangleMesh& mesh) {
    Vec3 sum;
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 one = area_vector(mesh, t);
        sum = sum + one;
        area += norm(one);
    }
    return area > 0 ? norm(sum) / area : 0;
}

}  // namespace

Fused fuse(const fs::path& list, const FuseOptions& options, const Context& context) {
    if (options.voxel && !(*options.voxel > 0 && std::isfinite(*options.voxel))) {
        throw InputError(InputFault::use, "the voxel is not a length above 0",
                         Sentence::with_key("positive_voxel", {}, "give a voxel above 0"));
    }
    const std::vector<PosedScan> listed = parse_scan_list(read_file(list, record_limit), list.filename().string());
    Fused fused;
    FuseReport& report = fused.report;
    std::vector<ScanSurface> surfaces;
    std::vector<double> spacings;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        context.check_cancelled();
        context.progress("scans read", i, listed.size());
        ReadScan scan = read(list.parent_path() / listed[i].file, listed[i].file);
        surfaces.push_back(std::move(scan.surface));
        spacings.push_back(scan.spacing);
    }
    report.spacing = median(spacings);
    report.voxel = options.voxel.value_or(report.spacing);

    std::array<std::vector<Pose>, 2> poses{poses_of(listed, false), poses_of(listed, true)};
    const double limit = 0.1 * norm(bounds(surfaces.front().mesh).size());
    report.is_other_sign = apart(surfaces, poses[1], limit, context) < apart(surfaces, poses[0], limit, context);
    AlignOptions how;
    how.spacing = report.spacing;
    const Alignment alignment = align(surfaces, poses[report.is_other_sign ? 1 : 0], how, context);
    report.rounds = alignment.rounds;
    report.residual = alignment.residual;
    describe_scans(surfaces, alignment, report);

    std::vector<Pose> aligned;
    for (const AlignedScan& scan : alignment.scans) aligned.push_back(scan.pose);
    fused.mesh = merge_scans(surfaces, aligned, report.voxel, context);
    if (fused.mesh.triangles.empty()) {
        throw InputError(InputFault::mesh, "the scans give no surface",
                         Sentence::with_key("another_voxel", {}, "give another voxel"));
    }
    report.shells_left_out = keep_large_shells(fused.mesh);
    report.open_edges = edges(fused.mesh).faults.open;
    report.missing_share = missing_share(fused.mesh);
    return fused;
}

}  // namespace qchopper
