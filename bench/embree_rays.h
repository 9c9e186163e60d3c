// Embree's own triangles in its own tree, without this program's wrapping, for comparison.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

struct FreeRay {
    Vec3 origin;
    Vec3 direction;
};

class EmbreeRays {
 public:
    // Robust, default quality of the tree.
    explicit EmbreeRays(const TriangleMesh& mesh);
    ~EmbreeRays();
    EmbreeRays(const EmbreeRays&) = delete;
    EmbreeRays& operator=(const EmbreeRays&) = delete;
    // The distance to the first triangle, infinite without one; one by one, in single precision.
    std::vector<float> first_hits(std::span<const FreeRay> rays) const;
    // Whether it meets no triangle. May be called from many threads at once.
    bool is_free(const FreeRay& ray) const;

 private:
    struct Tree;
    Tree* tree_;
};

}  // namespace qchopper::bench
