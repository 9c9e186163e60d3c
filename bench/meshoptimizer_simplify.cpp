// meshopt_simplify on points in single precision, which are converted before the clock starts.

#include "bench/clock.h"
#include "bench/other_simplifiers.h"

#ifdef QCHOPPER_HAS_MESHOPTIMIZER
#include <meshoptimizer.h>
#endif

namespace qchopper::bench {

#ifdef QCHOPPER_HAS_MESHOPTIMIZER

std::optional<OtherSimplified> meshoptimizer_simplify(const TriangleMesh& mesh, std::size_t faces) {
    std::vector<float> points;
    for (const Vec3& p : mesh.points) {
        for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(p[axis]));
    }
    std::vector<unsigned> indices;
    for (const Triangle& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
    std::vector<unsigned> made(indices.size());
    const double started = cpu_s();
    made.resize(meshopt_simplify(made.data(), indices.data(), indices.size(), points.data(), mesh.points.size(),
                                 3 * sizeof(float), 3 * faces, 1.0F, 0, nullptr));
    OtherSimplified result;
    result.seconds = cpu_s() - started;
    result.mesh.points = mesh.points;
    for (std::size_t i = 0; i + 2 < made.size(); i += 3) {
        result.mesh.triangles.push_back({made[i], made[i + 1], made[i + 2]});
    }
    return result;
}

#else

std::optional<OtherSimplified> meshoptimizer_simplify(const TriangleMesh&, std::size_t) {
    return {};
}

#endif

}  // namespace qchopper::bench
