#include "segment/intake/inspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "segment/mesh/edges.h"
#include "segment/mesh/shells.h"
#include "segment/repair/manifold.h"
#include "segment/repair/nesting.h"
#include "segment/repair/weld.h"

namespace qchopper {
namespace {

std::size_t count_without_area(const TriangleMesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) count += norm(area_vector(mesh, t)) == 0;
    return count;
}

// Negative shells are cavities where something lies around them and inside out where nothing does. Shells with an
// open border have no sign.
void count_shells(const TriangleMesh& mesh, const Edges& found_edges, Inspection& result) {
    const Shells found = shells(mesh);
    result.shells = found.count();
    std::vector<bool> is_open(found.count());
    for (std::size_t h = 0; h < found_edges.twin.size(); ++h) {
        if (found_edges.twin[h] == no_twin) is_open[found.shell_of[h / 3]] = true;
    }
    bool has_negative = false;
    for (std::size_t s = 0; s < found.count(); ++s) has_negative |= !is_open[s] && found.volume[s] < 0;
    if (!has_negative) return;
    const std::vector<std::vector<std::uint32_t>> around = shells_around(mesh, found);
    for (std::size_t s = 0; s < found.count(); ++s) {
        if (is_open[s] || !(found.volume[s] < 0)) continue;
        ++(around[s].empty() ? result.inside_out : result.cavities);
    }
}

// How lengths are told next to the longest of them.
struct Wording {
    const char* unit;
    double mm;
    int decimals;  // three digits for the longest
};

Wording wording_for(double longest_mm) {
    const auto in = [&](const char* unit, double mm) {
        const double value = longest_mm / mm;
        return Wording{unit, mm, value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2};
    };
    if (longest_mm >= 999.5) return in("m", 1000);
    return longest_mm >= 99.95 ? in("cm", 10) : in("mm", 1);
}

std::string in_words(double mm, const Wording& wording) {
    std::array<char, 400> text{};  // the largest double has 309 digits
    std::snprintf(text.data(), text.size(), "%.*f %s", wording.decimals, mm / wording.mm, wording.unit);
    return text.data();
}

}  // namespace

Inspection inspect(const RawMesh& scan) {
    Inspection result;
    result.format = scan.format;
    result.faces_in_file = scan.faces_in_file;
    result.faces_without_area = scan.faces_without_area;
    result.points_in_file = scan.mesh.points.size();
    result.triangles_in_file = scan.mesh.triangles.size();
    TriangleMesh mesh = scan.mesh;
    const WeldCounts counts = weld(mesh);
    result.welded = counts.welded;
    result.collapsed = counts.collapsed;
    result.unreferenced = counts.unreferenced;
    result.triangles = mesh.triangles.size();
    result.vertices = mesh.points.size();
    result.box = bounds(mesh);
    result.no_area = count_without_area(mesh);
    result.volume = volume_mm3(mesh);
    result.area = area_mm2(mesh);
    const Edges found = edges(mesh);
    result.open_edges = found.faults.open;
    result.inconsistent = found.faults.inconsistent;
    result.non_manifold = found.faults.non_manifold;
    result.pinched = count_pinched(mesh, found);
    // As intake counts shells: surfaces that only touch in points are two. At faulty edges they would fall to pieces.
    const bool has_faults = found.faults.non_manifold + found.faults.inconsistent > 0;
    if (has_faults) count_shells(mesh, found, result);
    split_pinched(mesh, found);
    if (!has_faults) count_shells(mesh, found, result);
    for (const std::vector<std::uint32_t>& loop : border_loops(mesh, unpaired(mesh, found).open)) {
        result.holes.push_back({centre_of(mesh, loop), loop.size()});
    }
    return result;
}

std::string size_in_words(Vec3 size_mm) {
    const Wording wording = wording_for(std::max({size_mm.x, size_mm.y, size_mm.z}));
    return in_words(size_mm.x, wording) + " x " + in_words(size_mm.y, wording) + " x " + in_words(size_mm.z, wording);
}

}  // namespace qchopper
