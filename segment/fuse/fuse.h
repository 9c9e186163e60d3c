// From range scans and their first poses to one mesh.
//
// Lengths are in the unit of the scans, which no file states. The steps: each scan becomes a surface (scan_surface.h),
// the poses are read with both signs of qr and those with which the scans lie nearer to each other are taken
// (scan_list.h), all scans are aligned (align.h) and merged (distance_grid.h), and shells of less than a hundredth of
// the area of the largest are left out. Holes stay open, for repair/. Same input, same bytes, whatever the number of
// threads (tests/segment/fuse/fuse_test.cpp).

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/pose.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct FuseOptions {
    std::optional<double> voxel;  // edge of a lattice cell; nothing: the spacing of the points
};

struct FusedScan {
    std::string file;
    std::size_t points = 0;
    std::size_t triangles = 0;
    std::size_t pairs = 0;  // of its points with those of other scans
    double residual = 0;    // median distance of its pairs after the alignment
    bool fits = true;       // not more than 3 times the median of all
    Pose pose;              // in the common frame
};

struct FuseReport {
    std::vector<FusedScan> scans;  // in the order of the list
    bool is_other_sign = false;    // the poses are those with the opposite sign of qr
    double spacing = 0;            // median distance of neighbours in a scan
    double voxel = 0;
    int rounds = 0;                   // of the alignment
    double residual = 0;              // median of all pairs
    std::size_t shells_left_out = 0;  // small ones
    std::size_t open_edges = 0;
    // What closes the mesh has at least this share of its area: the size of the sum of its area vectors, which is 0 for
    // a closed surface, over the sum of their sizes.
    double missing_share = 0;
};

struct Fused {
    TriangleMesh mesh;
    FuseReport report;
};

// The scans of a list, which lie beside it. Throws what parse_scan_list, parse_range_scan and parse_mesh throw;
// InputError (missing) for a scan that cannot be read; (use) for a voxel that is not above 0; (mesh) for a scan without
// triangles, one that overlaps no other, and scans that give no surface. Throws Cancelled.
Fused fuse(const std::filesystem::path& list, const FuseOptions& options = {}, const Context& context = {});

}  // namespace qchopper
