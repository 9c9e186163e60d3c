// Takes in a scan: the whole way from a file to a closed solid in millimetres about its own centre.
//
// The mesh that comes out is closed, its outer shells face outwards, and mesh point + centre is the file's point times
// mm_per_unit and scale (tests/segment/import/import_scan_test.cpp). The scan is repaired as the file has it, in its
// own unit and place; then nothing is moved but by that shift.

#pragma once

#include <filesystem>
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
// The one of that length. Throws InputError (use) if there is none.
Unit unit_of(double mm);

// What one unit of a scan is in mm: what its file says or, where that says nothing, what the operator says. Throws
// InputError (use) if both say something and not the same.
std::optional<double> agreed_mm_per_unit(std::optional<double> in_file, std::optional<double> given,
                                         const std::string& name);

struct ImportOptions {
    std::optional<double> mm_per_unit;  // what one unit of the file is; nothing: what the file itself says
    double scale = 1;                   // the operator's enlargement; other than 1 it is reported as a warning
    RepairOptions repair = {};          // its mm_per_unit is set by the file
    bool may_lack_unit = false;         // a scan without a unit is taken as if it were in mm
};

// A scan as its file has it, in the unit of the file, repaired.
struct RepairedScan {
    TriangleMesh mesh;
    RepairReport report;
    MeshFormat format = MeshFormat::ply_ascii;
    std::optional<double> mm_per_unit;  // nothing: nobody knows
    Sha256 sha256{};                    // of the file's bytes, and of those of the files that belong to it
    Box scanned;                        // of the points in use, before the repair
    std::vector<std::string> warnings;  // whole sentences for the operator
};

// Throws InputError: (missing) no such file, (mesh) a scan that is wrong or cannot be made a solid, (use) impossible
// options, or no unit. With Fill::none a scan may stay open.
RepairedScan repair_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context = {});

// Enlarges it about the origin of its file, with its volume; every place and length of the report stays that of the
// scan, where it can be found again. Other than 1 it is told of in a warning.
void enlarge(RepairedScan& scan, double scale);

struct ImportReport {
    RepairReport repair;
    std::vector<std::string> warnings;  // whole sentences for the operator
};

struct ImportedScan {
    TriangleMesh mesh;  // mm, about its own centre
    Vec3 centre;        // mm: what was subtracted, the middle of the scan's box
    double mm_per_unit = 1;
    Sha256 sha256{};
    ImportReport report;
};

// Throws what repair_scan throws, and InputError (mesh) for a scan that stays open.
ImportedScan import_scan(const std::filesystem::path& path, const ImportOptions& options, const Context& context = {});

}  // namespace qchopper
