// Readers of other libraries, and CGAL's test for self-intersections, for comparison. Each library has its own source.

#pragma once

#include <cstddef>
#include <filesystem>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

// Reads a file into OpenMesh's mesh of single or double precision; returns the number of faces, 0 if it cannot.
std::size_t openmesh_read(const std::filesystem::path& file, bool doubles);

// Whether this bench was built with assimp.
bool has_assimp();
// Reads a file with assimp without post-processing: nothing is welded. Returns the number of faces, 0 if it cannot.
std::size_t assimp_read(const std::filesystem::path& file);

// A mesh as CGAL's Surface_mesh, and its tests for self-intersections.
class CgalSurface {
 public:
    explicit CgalSurface(const TriangleMesh& mesh);
    ~CgalSurface();
    CgalSurface(const CgalSurface&) = delete;
    CgalSurface& operator=(const CgalSurface&) = delete;
    bool does_self_intersect() const;        // stops at the first pair
    std::size_t self_intersections() const;  // number of all pairs

 private:
    struct Surface;
    Surface* surface_;
};

}  // namespace qchopper::bench
