#include "segment/repair/outwards.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "segment/mesh/shells.h"
#include "segment/repair/nesting.h"

namespace qchopper {

Outwards turn_outwards(TriangleMesh& mesh, bool turn) {
    Outwards result;
    const Shells found = shells(mesh);
    result.shells = found.count();
    const std::vector<std::vector<std::uint32_t>> around = shells_around(mesh, found);
    std::vector<bool> is_turned(found.count());
    for (std::size_t s = 0; s < found.count(); ++s) {
        const bool should_be_outer = around[s].size() % 2 == 0;
        const bool is_outer = !(found.volume[s] < 0);
        const bool in_turned = std::any_of(around[s].begin(), around[s].end(), [&](std::uint32_t outer) {
            return around[outer].empty() && found.volume[outer] < 0;
        });
        is_turned[s] = turn && is_outer != should_be_outer && (around[s].empty() || in_turned);
        result.turned += is_turned[s];
        result.cavities += is_outer == static_cast<bool>(is_turned[s]);
        result.overlapping += is_outer != should_be_outer && !is_turned[s];
    }
    if (result.turned == 0) return result;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (is_turned[found.shell_of[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    return result;
}

}  // namespace qchopper
