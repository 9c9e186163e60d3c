// What a repair has done, as lines and as JSON.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segment/import/import_scan.h"

namespace qchopper {

// Which file the report is about.
struct RepairedFile {
    std::filesystem::path scan;
    std::filesystem::path out;
    double scale = 1;
};

// A line for each step that had something to do, the distance, and a verdict.
std::vector<std::string> lines(const RepairedScan& scan, const RepairedFile& file);
// The document qchopper-repair-2 (docs/repair.md).
std::string document(const RepairedScan& scan, const RepairedFile& file);

}  // namespace qchopper
