// Makes a closed solid of a scan and writes it as a mesh file.

#pragma once

#include <filesystem>

#include "base/context.h"
#include "segment/import/import_scan.h"

namespace qchopper {

struct RepairRequest {
    std::filesystem::path scan;
    std::filesystem::path out;  // .ply or .stl
    ImportOptions options;
};

// The mesh is written in the unit of the scan, enlarged by options.scale. Throws InputError: (use) another ending,
// (create) the file exists or cannot be made; and what repair_scan and write_mesh throw. Then nothing is written.
RepairedScan repair_file(const RepairRequest& request, const Context& context);

}  // namespace qchopper
