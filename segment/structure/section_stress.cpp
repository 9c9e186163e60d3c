// The area of the section of a cube, as a function of the distance, is the density of a sum of three uniform variables
// whose widths are the components of the normal: a box, a trapezoid, or its mean over a window. Voxels are sorted to
// the planes that cross them; on every plane disjoint sets over faces make the sections.

#include "segment/structure/section_stress.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>

#include "segment/mesh/connectivity/disjoint_sets.h"

namespace qchopper {
namespace {

constexpr double min_component = 1e-4;  // below it the differences that follow would lose their digits

// The widths of the three variables, the largest first; those that count as 0 are 0.
std::array<double, 3> widths(Vec3 normal) {
    std::array<double, 3> w{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
    std::sort(w.begin(), w.end(), std::greater<>());
    for (double& x : w) x = x < min_component ? 0 : x;
    return w;
}

// The integral up to x of the density 1/a within a/2 of 0, and the integral of that.
double first_integral(double x, double a) {
    return std::clamp(x / a + 0.5, 0.0, 1.0);
}
double second_integral(double x, double a) {
    if (x <= -a / 2) return 0;
    if (x >= a / 2) return x;
    return (x + a / 2) * (x + a / 2) / (2 * a);
}

double section_of(const std::array<double, 3>& w, double x) {
    const auto& [a, b, c] = w;
    if (b == 0) return std::abs(x) < a / 2 ? 1 / a : std::abs(x) == a / 2 ? 1 / (2 * a) : 0;
    if (c == 0) return (first_integral(x + b / 2, a) - first_integral(x - b / 2, a)) / b;
    const double upper = second_integral(x + c / 2 + b / 2, a) - second_integral(x + c / 2 - b / 2, a);
    const double lower = second_integral(x - c / 2 + b / 2, a) - second_integral(x - c / 2 - b / 2, a);
    return std::max(0.0, (upper - lower) / (b * c));
}

// A voxel that a plane crosses.
struct Crossed {
    std::uint32_t voxel = 0;  // position in the part's list
    double area = 0;          // in faces of a voxel
};

struct SectionSums {
    double area = 0;
    double stress = 0;  // area times MPa
    double thick = 0;
};

// Tension and shear of a voxel on planes with this normal, in MPa.
double tension_and_shear(const Stress& stress, Vec3 normal) {
    const Vec3 t = traction(stress, normal);
    const double along = dot(normal, t);
    return std::max(along, 0.0) + norm(t - along * normal);
}

// Finds the sections of one plane after the other.
class Sections {
 public:
    Sections(const StressedPart& part, Vec3 normal)
        : part_(part), normal_(normal), place_(part.voxels.size(), no_voxel) {}

    SectionStress of(const std::vector<Crossed>& crossed) {
        DisjointSets sets(crossed.size());
        for (std::uint32_t i = 0; i < crossed.size(); ++i) place_[crossed[i].voxel] = i;
        for (std::uint32_t i = 0; i < crossed.size(); ++i) {
            for (const std::size_t side : {0U, 2U, 4U}) {
                const std::uint32_t other = part_.neighbours[crossed[i].voxel][side];
                if (other != no_voxel && place_[other] != no_voxel) sets.unite(i, place_[other]);
            }
        }
        std::vector<SectionSums> sums(crossed.size());
        for (std::uint32_t i = 0; i < crossed.size(); ++i) {
            const std::uint32_t voxel = part_.voxels[crossed[i].voxel];
            SectionSums& s = sums[sets.root(i)];
            s.area += crossed[i].area;
            s.stress += crossed[i].area * tension_and_shear(part_.model->stress[voxel], normal_);
            s.thick += part_.model->is_thick[voxel] != 0 ? crossed[i].area : 0;
        }
        for (const Crossed& c : crossed) place_[c.voxel] = no_voxel;
        return total(sums);
    }

 private:
    SectionStress total(const std::vector<SectionSums>& sums) const {
        SectionStress result;
        for (const SectionSums& s : sums) {
            if (s.area <= 0) continue;
            ++result.sections;
            result.value += s.stress / s.area / part_.model->strength_mpa;
            result.area_mm2 += s.area * part_.model->grid.size * part_.model->grid.size;
            if (s.thick < s.area / 2) ++result.too_coarse;
        }
        return result;
    }

    const StressedPart& part_;
    Vec3 normal_;
    std::vector<std::uint32_t> place_;  // per voxel of the part: among those crossed, or no_voxel
};

}  // namespace

StressedPart stressed_part(std::shared_ptr<const StressedModel> model, const TriangleMesh& mesh) {
    StressedPart part;
    std::vector<std::uint32_t> numbers;
    std::uint32_t at = 0;
    for (const std::uint32_t number : voxels_inside(mesh, model->grid)) {
        while (at < model->voxels.size() && model->voxels[at] < number) ++at;
        if (at == model->voxels.size() || model->voxels[at] != number) continue;
        part.voxels.push_back(at);
        numbers.push_back(number);
    }
    part.neighbours = voxel_neighbours(model->grid, numbers);
    part.model = std::move(model);
    return part;
}

std::vector<SectionStress> section_stress(const StressedPart& part, Vec3 normal, std::span<const double> offsets) {
    assert(std::is_sorted(offsets.begin(), offsets.end()) && std::abs(norm(normal) - 1) < 1e-9);
    const VoxelGrid& grid = part.model->grid;
    const Vec3 across{dot(grid.axis[0], normal), dot(grid.axis[1], normal), dot(grid.axis[2], normal)};
    const std::array<double, 3> w = widths(across);
    const double reach = grid.size * (w[0] + w[1] + w[2]) / 2;
    std::vector<std::vector<Crossed>> crossed(offsets.size());
    for (std::uint32_t i = 0; i < part.voxels.size(); ++i) {
        const double height = dot(normal, grid.centre(part.model->voxels[part.voxels[i]]));
        auto offset = std::lower_bound(offsets.begin(), offsets.end(), height - reach);
        for (; offset != offsets.end() && *offset <= height + reach; ++offset) {
            const double area = section_of(w, (*offset - height) / grid.size);
            if (area > 0) crossed[static_cast<std::size_t>(offset - offsets.begin())].push_back({i, area});
        }
    }
    Sections sections(part, normal);
    std::vector<SectionStress> result;
    result.reserve(offsets.size());
    for (const std::vector<Crossed>& plane : crossed) result.push_back(sections.of(plane));
    return result;
}

}  // namespace qchopper
