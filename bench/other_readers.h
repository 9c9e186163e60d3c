// What other libraries do with the same file, to be compared with. Each in a source of its own.

#pragma once

#include <cstddef>
#include <filesystem>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

// Reads a file into OpenMesh's mesh of single or double precision; returns its faces.
std::size_t openmesh_read(const std::filesystem::path& file, bool doubles);

// Whether this bench was built with assimp.
bool has_assimp();
// Reads a file as assimp does without being asked for anything more: nothing welded. Returns its faces.
std::size_t assimp_read(const std::filesystem::path& file);

// A mesh as CGAL's Surface_mesh, and what its tests for self-intersections say.
class CgalSurface {
 public:
    explicit CgalSurface(const TriangleMesh& mesh);
    ~CgalSurface();
    CgalSurface(const CgalSurface&) = delete;
    CgalSurface& operator=(const CgalSurface&) = delete;
    bool does_self_intersect() const;        // ends at the first pair
    std::size_t self_intersections() const;  // all pairs

 private:
    struct Surface;
    Surface* surface_;
};

}  // namespace qchopper::bench
