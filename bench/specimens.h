// Provides the meshes that are measured, as pieces that can be cut. Millimetres.

#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "segment/sample/sample.h"
#include "segment/search/segmentation.h"

namespace qchopper::bench {

struct Measured {
    std::string name;
    Piece piece;
    double fragment_volume_mm3 = 0;  // 1e-5 of the scan's volume
    std::size_t faces() const { return piece.mesh->triangles.size(); }
};

// The folder of the real scans unless --data names another.
std::filesystem::path default_data();

// Imports a scan. Null, and a line on stderr, if the file does not exist. Throws InputError as import_scan does.
std::shared_ptr<const TriangleMesh> scan(const std::filesystem::path& file, double mm_per_unit);

// The whole scan as one piece, even if it has several solids.
Measured whole(const std::string& name, const TriangleMesh& mesh);
// The solid with the most faces.
Measured biggest(const std::string& name, const TriangleMesh& mesh);
// The largest solid of a synthetic specimen with so many faces.
Measured one_shell(const std::string& name, Specimen specimen, std::size_t faces);

// Candidates with one normal, as the sweep takes them.
struct Planes {
    Vec3 normal;
    std::vector<double> offsets;
};
std::vector<Planes> by_normal(const std::vector<Candidate>& candidates);

}  // namespace qchopper::bench
