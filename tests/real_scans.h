// What the list of the real meshes (MANIFEST.tsv beside them) says. Only a folder that is not there leaves a test
// without meshes: a list or a column that is missing is a mistake, and the test fails.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace qchopper {

struct RealScan {
    std::string file;
    std::size_t faces = 0;
};

// Closed, free of self-intersections, with fewer than `faces` faces, PLY or STL; none if there is no such folder.
// Throws std::runtime_error if the folder has no list, the list lacks a column, or a row has another number of cells.
std::vector<RealScan> valid_scans(const std::filesystem::path& folder, std::size_t faces);

}  // namespace qchopper
