// The meshes that are measured, as pieces ready to be cut.

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
    double fragment_volume_mm3 = 0;  // 1e-5 of the scan's
    std::size_t faces() const { return piece.mesh->triangles.size(); }
};

// Where the real scans lie unless --data says otherwise.
std::filesystem::path default_data();

// A scan as it comes in, in mm. Nothing, and a line on stderr, if the file is not there.
std::shared_ptr<const TriangleMesh> scan(const std::filesystem::path& file, double mm_per_unit);

// The whole of a scan as one piece, however many solids it is.
Measured whole(const std::string& name, const TriangleMesh& mesh);
// The solid with most faces.
Measured biggest(const std::string& name, const TriangleMesh& mesh);
Measured one_shell(const std::string& name, Specimen specimen, std::size_t faces);

// The candidates of a piece, by normal: what the sweep is asked.
struct Planes {
    Vec3 normal;
    std::vector<double> offsets;
};
std::vector<Planes> by_normal(const std::vector<Candidate>& candidates);

}  // namespace qchopper::bench
