// Reads, repairs, checks and shifts, in that order. The cost is that of the repair; memory holds the bytes of the file
// beside the mesh.

#include "segment/import/import_scan.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "base/timings.h"
#include "segment/import/inspect.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr double largest_mm = 1e11;  // beyond this a double does not resolve 0.0001 mm

std::string place(Vec3 p) {
    return significant(p.x, 6) + ", " + significant(p.y, 6) + ", " + significant(p.z, 6);
}

// The unit of the scan; nothing where it may lack one.
std::optional<double> mm_per_unit_of(const RawMesh& scan, const std::string& name, const ImportOptions& options) {
    const std::optional<double> agreed = agreed_mm_per_unit(scan.mm_per_unit, options.mm_per_unit, name);
    if (agreed || options.may_lack_unit) return agreed;
    throw InputError(InputFault::use, name + " is " + name_of(scan.format) + ", which has no unit",
                     Sentence::with_key("give_unit", {}, "give the unit of the scan: mm, cm, m or in"));
}

void check(const ImportOptions& options) {
    const double unit = options.mm_per_unit.value_or(1);
    const double factor = unit * options.scale;
    if (unit > 0 && options.scale > 0 && std::isfinite(factor) && factor != 0) return;
    throw InputError(InputFault::use, "units and scale must be positive numbers",
                     Sentence::with_key("leave_scale", {}, "leave the scale out for 1"));
}

// Around the points of all triangles, of which there is at least one.
Box box_of(const TriangleMesh& mesh) {
    const Vec3 first = mesh.points[mesh.triangles[0][0]];
    Box box{first, first};
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t corner : t) extend(box, mesh.points[corner]);
    }
    return box;
}

void check_range(const Box& box, double mm_per_unit, const std::string& name) {
    const double far = largest_mm / mm_per_unit;
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min[axis] >= -far && box.max[axis] <= far) continue;
        throw InputError(InputFault::mesh,
                         name + " reaches to (" + place(box.max) + ") and (" + place(box.min) +
                             "): more than 100 000 km from its origin",
                         Sentence::with_key("check_unit", {}, "check the unit, or export the scan again"));
    }
}

std::string scale_warning(double scale) {
    return "The scan is scaled by " + significant(scale, 6) + ": its pieces are not in true size.";
}

// Throws InputError (mesh) for a result that is no solid. One that may be open must have faces.
void check_solid(const RepairedScan& scan, const std::string& name, bool may_be_open) {
    const std::optional<Refusal> refused = refusal_of(scan.report);
    if (!refused || (may_be_open && !scan.mesh.triangles.empty())) return;
    throw InputError(InputFault::mesh, name + refused->why, refused->to_do);
}

// The hash of the bytes; with further files the hash over the hashes of all.
Sha256 hash_of(const Bytes& bytes, const std::vector<Sha256>& beside) {
    const Sha256 own = sha256(bytes);
    if (beside.empty()) return own;
    Bytes all(own.bytes.begin(), own.bytes.end());
    for (const Sha256& other : beside) all.insert(all.end(), other.bytes.begin(), other.bytes.end());
    return sha256(all);
}

}  // namespace

bool is_usual_size(Vec3 size) {
    const double longest = std::max({size.x, size.y, size.z});
    return longest >= 10 && longest <= 20'000;
}

std::string size_warning(Vec3 size) {
    return "The scan measures " + describe_size(size) + ": is its unit right?";
}

RepairedScan repair_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context) {
    check(options);
    const std::string name = name_of_scan(path);
    RepairedScan result;
    context.check_cancelled();
    StageTimer stage(context, "scan read");
    const Bytes bytes = read_scan(path);
    context.progress("MB of the scan read", 0, bytes.size() / 1'000'000);
    RawMesh scan = parse_mesh(bytes, name, folder_of(path));
    result.format = scan.format;
    result.sha256 = hash_of(bytes, scan.beside);
    result.warnings = std::move(scan.warnings);
    if (scan.faces_without_area > 0) {
        result.warnings.push_back(counted(scan.faces_without_area, "face has", "faces have") +
                                  " fewer than three corners; left out.");
    }
    result.mm_per_unit = mm_per_unit_of(scan, name, options);
    const double unit = result.mm_per_unit.value_or(1);
    result.scanned = box_of(scan.mesh);
    check_range(result.scanned, unit * options.scale, name);
    const Vec3 size = unit * options.scale * result.scanned.size();
    if (result.mm_per_unit && options.on_unusual_size && !is_usual_size(size)) options.on_unusual_size(size);
    stage.next("scan repaired");
    RepairOptions repairs = options.repair;
    repairs.mm_per_unit = unit;
    Repaired repaired = repair(std::move(scan.mesh), repairs, context);
    result.mesh = std::move(repaired.mesh);
    result.report = std::move(repaired.report);
    check_solid(result, name, repairs.fill.fill == Fill::none);
    for (std::string& warning : warnings(result.report)) result.warnings.push_back(std::move(warning));
    return result;
}

void enlarge(RepairedScan& scan, double scale) {
    if (scale == 1) return;
    for (Vec3& p : scan.mesh.points) p = scale * p;
    scan.report.volume *= scale * scale * scale;
    scan.warnings.push_back(scale_warning(scale));
}

ImportedScan import_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context) {
    RepairedScan scan = repair_scan(path, options, context);
    const StageTimer stage(context, "scan centred");
    check_solid(scan, path.string(), false);
    ImportedScan imported;
    imported.mm_per_unit = scan.mm_per_unit.value_or(1);
    const double factor = imported.mm_per_unit * options.scale;
    imported.centre = factor * scan.scanned.centre();
    imported.mesh = std::move(scan.mesh);
    for (Vec3& p : imported.mesh.points) p = factor * p - imported.centre;
    imported.sha256 = scan.sha256;
    imported.report = {std::move(scan.report), {}};
    if (options.scale != 1) imported.report.warnings.push_back(scale_warning(options.scale));
    for (std::string& warning : scan.warnings) imported.report.warnings.push_back(std::move(warning));
    const Vec3 size = bounds(imported.mesh).size();
    if (!is_usual_size(size)) imported.report.warnings.push_back(size_warning(size));
    return imported;
}

}  // namespace qchopper
