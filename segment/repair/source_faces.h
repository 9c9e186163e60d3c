// Which face of the scan each face of a mesh is, on the mesh's way through the repair.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace qchopper {

constexpr std::uint32_t new_face = std::numeric_limits<std::uint32_t>::max();

// A step of the repair that is given it, not null, keeps it in step with the triangles of the mesh.
struct SourceFaces {
    // Per triangle the number of the face in the scan; new_face where a step has made it or given it other corners.
    std::vector<std::uint32_t> of;
};

inline std::size_t count_new(const SourceFaces& sources) {
    return static_cast<std::size_t>(std::count(sources.of.begin(), sources.of.end(), new_face));
}

}  // namespace qchopper
