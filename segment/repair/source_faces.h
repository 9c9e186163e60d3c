// Which face of the scan each triangle of a mesh is, while the mesh is repaired.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "segment/mesh/submesh.h"

namespace qchopper {

constexpr std::uint32_t new_face = std::numeric_limits<std::uint32_t>::max();

// A step of the repair to which it is passed, not null, keeps it at one value per triangle of the mesh.
struct SourceFaces {
    // Per triangle the number of the face in the scan; new_face where a step has made it or given it other corners.
    std::vector<std::uint32_t> of;
};

inline std::size_t count_new(const SourceFaces& sources) {
    return static_cast<std::size_t>(std::count(sources.of.begin(), sources.of.end(), new_face));
}

// Keeps the triangles whose flag is set (one flag per triangle), and their sources. All points stay.
inline void keep_triangles(TriangleMesh& mesh, const std::vector<bool>& is_kept, SourceFaces* sources) {
    keep_triangles(mesh, is_kept);
    if (sources != nullptr) keep_marked(sources->of, is_kept);
}

}  // namespace qchopper
