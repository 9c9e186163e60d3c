// Imports a scan: reads a file, repairs the mesh and shifts it to its own centre, in millimetres.
//
// The mesh is closed, its outer shells face outwards, and mesh point + centre is the file's point times mm_per_unit and
// scale (tests/segment/import/import_scan_test.cpp). The scan is repaired in the unit and place of its file; after that
// points are only scaled and shifted.

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/context.h"
#include "base/sha256.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/repair.h"

namespace qchopper {

enum class Unit { mm, cm, m, in, ft, um };

double mm_per(Unit unit);
std::string name_of(Unit unit);

// "mm", "cm", "m", "in", "ft" or "um". Throws InputError (use) for anything else.
Unit unit_named(std::string_view name);
// The unit of that length, exactly. Throws InputError (use) if there is none.
Unit unit_of(double mm);

// Length of one unit of a scan in mm: that of its file or, if the file has none, the operator's; nothing if both are
// missing. Throws InputError (use) if both are given and differ.
std::optional<double> agreed_mm_per_unit(std::optional<double> in_file, std::optional<double> given,
                                         const std::string& name);

// A bone, or a model of one, is 1 cm to 20 m long: another length tells of a wrong unit. Lengths in mm.
bool is_usual_size(Vec3 size);
// "The scan measures 3.0 mm x 2.0 mm x 1.0 mm: is its unit right?", of a size that is not usual.
std::string size_warning(Vec3 size);

struct ImportOptions {
    std::optional<double> mm_per_unit;  // the operator's; nothing: that of the file. Above 0
    double scale = 1;                   // the operator's factor, above 0; other than 1 it is reported as a warning
    RepairOptions repair = {};          // its mm_per_unit is not used: the scan's is
    bool may_lack_unit = false;         // a scan without a unit is repaired as if it were in mm
    // Called with a size, in mm and scaled, that is not usual, before the repair. It may throw to refuse the scan;
    // empty: every size is taken.
    std::function<void(Vec3 size)> on_unusual_size = {};
};

// A repaired scan in the unit and place of its file.
struct RepairedScan {
    TriangleMesh mesh;
    RepairReport report;
    MeshFormat format = MeshFormat::ply_ascii;
    std::optional<double> mm_per_unit;  // nothing: not known
    Sha256 sha256;                      // of the file's bytes; of a scan in several files over the hashes of all
    Box scanned;                        // of the points of all faces, before the repair
    std::vector<std::string> warnings;  // whole sentences for the operator
};

// Throws InputError: (missing) no such file, (mesh) a scan that is wrong or cannot be made a solid, (use) impossible
// options, or no unit; and Cancelled. With Fill::none a scan may stay open.
RepairedScan repair_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context = {});

// Scales it about the origin of its file, with the volume in its report; every other place and length of the report
// stays that of the scan, where it can be found again. A scale other than 1 adds a warning.
void enlarge(RepairedScan& scan, double scale);

struct ImportReport {
    RepairReport repair;
    std::vector<std::string> warnings;  // whole sentences for the operator
};

struct ImportedScan {
    TriangleMesh mesh;  // mm, about its own centre
    Vec3 centre;        // mm: subtracted from every point; the centre of the scan's box before the repair
    double mm_per_unit = 1;
    Sha256 sha256;
    ImportReport report;
};

// Throws what repair_scan throws, and InputError (mesh) for a scan that stays open.
ImportedScan import_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context = {});

}  // namespace qchopper
