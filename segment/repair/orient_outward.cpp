// A shell with an even number of shells around it (containment.h) should face outwards, one with an odd number inwards.
// O(triangles + points), and the search for the shells around.

#include "segment/repair/orient_outward.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

constexpr double min_left = 1e-9;  // of the volume of all shells: less is rounding

// Shells that are turned together. The shells around a group are those around its largest one.
struct ShellGroups {
    std::vector<std::uint32_t> group_of;  // per shell
    std::vector<std::uint32_t> largest;   // per group: the shell of largest absolute volume
    std::vector<double> volume;           // per group
};

ShellGroups grouped(const Shells& found, std::vector<std::uint32_t> group_of) {
    ShellGroups groups{std::move(group_of), {}, {}};
    for (std::uint32_t s = 0; s < found.count(); ++s) {
        const std::uint32_t g = groups.group_of[s];
        if (g >= groups.volume.size()) {
            groups.volume.resize(g + 1, 0);
            groups.largest.resize(g + 1, s);
        }
        groups.volume[g] += found.volume[s];
        if (std::abs(found.volume[s]) > std::abs(found.volume[groups.largest[g]])) groups.largest[g] = s;
    }
    return groups;
}

ShellGroups each_by_itself(const Shells& found) {
    std::vector<std::uint32_t> group_of(found.count());
    std::iota(group_of.begin(), group_of.end(), 0);
    return grouped(found, std::move(group_of));
}

ShellGroups touching(const TriangleMesh& mesh, const Shells& found) {
    TriangleMesh welded = mesh;
    if (weld(welded).collapsed > 0) return each_by_itself(found);
    const Shells together = shells(welded);  // numbered by their first triangle, as those of the mesh are
    std::vector<std::uint32_t> group_of(found.count());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) group_of[found.shell_of[t]] = together.shell_of[t];
    return grouped(found, std::move(group_of));
}

// One flag per shell: whether it is to be turned, when those of a group are turned together.
std::vector<bool> inside_out(const Shells& found, const ShellGroups& groups, const IndexLists& around) {
    const auto around_group = [&](std::uint32_t g) {
        const std::span<const std::uint32_t> all = around[groups.largest[g]];
        std::vector<std::uint32_t> others(all.begin(), all.end());
        std::erase_if(others, [&](std::uint32_t s) { return groups.group_of[s] == g; });
        return others;
    };
    std::vector<bool> is_turned(groups.volume.size());
    for (std::uint32_t g = 0; g < groups.volume.size(); ++g) {
        const std::vector<std::uint32_t> others = around_group(g);
        const bool should_be_outer = others.size() % 2 == 0;
        const bool is_outer = !(groups.volume[g] < 0);
        const bool in_turned = std::any_of(others.begin(), others.end(), [&](std::uint32_t outer) {
            const std::uint32_t other = groups.group_of[outer];
            return groups.volume[other] < 0 && around_group(other).empty();
        });
        is_turned[g] = is_outer != should_be_outer && (others.empty() || in_turned);
    }
    std::vector<bool> result(found.count());
    for (std::uint32_t s = 0; s < found.count(); ++s) result[s] = is_turned[groups.group_of[s]];
    return result;
}

bool is_much_left(const Shells& found, const std::vector<bool>& is_turned) {
    double sum = 0;
    double all = 0;
    for (std::size_t s = 0; s < found.count(); ++s) {
        sum += is_turned[s] ? -found.volume[s] : found.volume[s];
        all += std::abs(found.volume[s]);
    }
    return sum > min_left * all;
}

Outward turned(TriangleMesh& mesh, bool turn, bool by_groups) {
    const Shells found = shells(mesh);
    const IndexLists around = shells_around(mesh, found);
    std::vector<bool> is_turned(found.count());
    const bool is_any = std::any_of(found.volume.begin(), found.volume.end(), [](double v) { return v < 0; });
    if (turn && is_any) {
        if (by_groups) is_turned = inside_out(found, touching(mesh, found), around);
        if (!by_groups || !is_much_left(found, is_turned)) {
            is_turned = inside_out(found, each_by_itself(found), around);
        }
    }
    Outward result;
    result.shells = found.count();
    for (std::size_t s = 0; s < found.count(); ++s) {
        const bool is_outer = !(found.volume[s] < 0);
        result.turned += is_turned[s];
        result.cavities += is_outer == static_cast<bool>(is_turned[s]);
        const bool is_wrong = is_outer != (around[s].size() % 2 == 0) && !is_turned[s];
        const bool is_held = turn && by_groups && !is_outer && around[s].empty();
        (is_held ? result.left : result.overlapping) += is_wrong;
    }
    if (result.turned == 0) return result;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (is_turned[found.shell_of[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
    return result;
}

}  // namespace

Outward orient_outward(TriangleMesh& mesh, bool turn) {
    return turned(mesh, turn, false);
}

Outward orient_touching_outward(TriangleMesh& mesh, bool turn) {
    return turned(mesh, turn, true);
}

}  // namespace qchopper
