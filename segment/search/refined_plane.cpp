// A pattern search in three coordinates; each plane costs what DenseAccess asks.

#include "segment/search/refined_plane.h"

#include <array>
#include <cmath>

#include "base/units.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

constexpr double first_turn = radians(3);
constexpr int levels = 2;
constexpr int max_moves = 2;  // of one step size

// A plane by how far it is moved and turned: along the normal, then about two axes across it.
using Move = std::array<double, 3>;

Plane moved(const Plane& from, Vec3 middle, const Move& move) {
    const PlaneFrame frame = frame_across(from.normal);
    const Vec3 pivot = middle - (height(from.normal, middle) - from.offset) * from.normal;
    const Vec3 normal = normalized(from.normal + std::tan(move[1]) * frame.u + std::tan(move[2]) * frame.v);
    return canonical({normal, dot(normal, pivot) + move[0]});
}

}  // namespace

RefinedPlane refined_plane(DenseAccess& access, const Piece& piece, const Plane& from, double step_mm,
                           const Context& context, const std::function<bool(const Plane&)>& is_allowed, bool may_turn) {
    const Vec3 middle = bounds(*piece.mesh).centre();
    Move best{};
    RefinedPlane found{from, access.unreachable_mm2(from)};
    Move step{step_mm, first_turn, first_turn};
    for (int level = 0; level < levels; ++level) {
        for (int moves = 0; moves < max_moves && found.unreachable_mm2 > 0; ++moves) {
            const Move start = best;
            const double before = found.unreachable_mm2;
            for (std::size_t k = 0; k < (may_turn ? step.size() : 1); ++k) {
                for (const double sign : {-1.0, 1.0}) {
                    context.check_cancelled();
                    Move tried = start;
                    tried[k] += sign * step[k];
                    const Plane plane = moved(from, middle, tried);
                    if (is_allowed && !is_allowed(plane)) continue;
                    const double unreachable = access.unreachable_mm2(plane);
                    if (unreachable >= found.unreachable_mm2) continue;
                    found = {plane, unreachable};
                    best = tried;
                }
            }
            if (found.unreachable_mm2 >= before) break;
        }
        for (double& s : step) s /= 2;
    }
    return found;
}

}  // namespace qchopper
