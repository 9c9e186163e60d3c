// Imports real scans, and makes synthetic specimens of the wanted size.

#include "bench/specimens.h"

#include <algorithm>
#include <iostream>

#include "segment/import/import_scan.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/order.h"

namespace qchopper::bench {

std::filesystem::path default_data() {
    return QCHOPPER_MESHES;
}

std::shared_ptr<const TriangleMesh> scan(const std::filesystem::path& file, double mm_per_unit) {
    if (!std::filesystem::exists(file)) {
        std::cerr << file.string() << " is not there: skipped" << std::endl;
        return nullptr;
    }
    ImportOptions options;
    options.mm_per_unit = mm_per_unit;
    return std::make_shared<const TriangleMesh>(import_scan(file, options).mesh);
}

Measured whole(const std::string& name, const TriangleMesh& mesh) {
    Measured m{name, {}, 1e-5 * volume_mm3(mesh)};
    m.piece.name = "A";
    m.piece.mesh = std::make_shared<const TriangleMesh>(in_memory_order(mesh));
    return m;
}

Measured biggest(const std::string& name, const TriangleMesh& mesh) {
    Measured m{name, {}, 1e-5 * volume_mm3(mesh)};
    const Segmentation start = uncut(mesh, m.fragment_volume_mm3);
    m.piece = *std::max_element(start.pieces.begin(), start.pieces.end(), [](const Piece& a, const Piece& b) {
        return a.mesh->triangles.size() < b.mesh->triangles.size();
    });
    return m;
}

Measured one_shell(const std::string& name, Specimen specimen, std::size_t faces) {
    SampleOptions options;
    options.faces = faces;
    return biggest(name, sample(specimen, options));
}

std::vector<Planes> by_normal(const std::vector<Candidate>& candidates) {
    std::vector<Planes> planes;
    for (const Candidate& c : candidates) {
        if (planes.empty() || planes.back().normal != c.plane.normal) planes.push_back({c.plane.normal, {}});
        planes.back().offsets.push_back(c.plane.offset);
    }
    return planes;
}

}  // namespace qchopper::bench
