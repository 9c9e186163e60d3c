// A tree of the mesh is asked, per sample, whether any triangle is nearer to the centre of the ball than its radius: of
// two boxes the nearer one first, and none that is farther, so that the search ends with the first triangle found.

#include "segment/access/tool_fit.h"

#include <cassert>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr std::size_t samples_at_once = 256;

}  // namespace

std::vector<bool> too_narrow(const TriangleMesh& mesh, const std::vector<bool>& is_left_out,
                             std::span<const SurfaceSample> samples, const BallFit& ball) {
    assert(ball.radius > 0 && ball.allowance >= 0 && ball.lift > 0);
    assert(is_left_out.empty() || is_left_out.size() == mesh.triangles.size());
    const TriangleTree tree(mesh);
    const double height = ball.radius + ball.height_mm();
    std::vector<std::uint8_t> is_too_narrow(samples.size());  // threads write no bits of one word
    parallel_ranges(0, samples.size(), samples_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t i = first; i < end; ++i) {
            const Vec3 centre = samples[i].point + height * samples[i].normal;
            is_too_narrow[i] = tree.is_any_nearer(mesh, centre, ball.radius, is_left_out) ? 1 : 0;
        }
    });
    return {is_too_narrow.begin(), is_too_narrow.end()};
}

}  // namespace qchopper
