// Voxels, their parts, loads, one solution, the stress at the centre of every brick turned to the axes of the mesh. The
// size of the voxels is found by halving, on a handful of grids. The cost is that of the solution (displacements.h).

#include "segment/structure/stress.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "base/text.h"
#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/measure.h"
#include "segment/structure/displacements.h"

namespace qchopper {
namespace {

constexpr double foot_share = 0.05;  // of the height: what stands on the ground, and what carries the load

void check(const StructureOptions& o) {
    const auto refuse = [](const std::string& what, const std::string& to_do) {
        throw InputError(InputFault::use, "structure: " + what, to_do);
    };
    const auto is_positive = [](double x) { return std::isfinite(x) && x > 0; };
    const double length = norm(o.up);
    if (!is_positive(length)) refuse("the upright direction is not a direction", "pass three numbers, not all 0");
    if (!is_positive(o.density_kg_per_m3)) refuse("the density is not above 0", "pass it in kg/m3");
    if (!is_positive(o.strength_mpa)) refuse("the strength is not above 0", "pass it in MPa");
    if (!std::isfinite(o.force_n) || o.force_n < 0) refuse("the force is below 0", "pass it in N, downwards");
    if (!o.has_own_weight && o.force_n == 0) refuse("there is no load", "take the own weight or a force");
    if (!(o.poisson_ratio >= 0 && o.poisson_ratio < 0.49)) refuse("Poisson's ratio is not from 0 to 0.49", "pass 0.3");
    if (!std::isfinite(o.voxel_mm) || o.voxel_mm < 0) refuse("the voxel size is below 0", "pass it in mm");
}

// What the solver is given, and which voxels it is for.
struct VoxelModel {
    VoxelGrid grid;
    std::vector<std::uint32_t> voxels;
    std::vector<std::uint32_t> part;       // per voxel
    std::vector<std::uint8_t> does_stand;  // per part
    std::vector<std::uint32_t> standing;   // voxels that stand
    std::vector<std::uint32_t> part_of;    // per standing voxel
    BrickNodes nodes;                      // of these
};

// Per part: its layers.
struct Layers {
    std::uint32_t first = no_voxel;
    std::uint32_t last = 0;
    std::size_t voxels = 0;
};

std::vector<Layers> layers_of_parts(const VoxelModel& m) {
    std::vector<Layers> layers;
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        if (m.part[i] >= layers.size()) layers.resize(m.part[i] + 1);
        Layers& l = layers[m.part[i]];
        const std::uint32_t layer = m.grid.place(m.voxels[i])[2];
        l.first = std::min(l.first, layer);
        l.last = std::max(l.last, layer);
        ++l.voxels;
    }
    return layers;
}

// The voxels joined by faces: per voxel of the list the number of its part; parts are numbered by their first voxel.
std::vector<std::uint32_t> parts_joined_by_faces(const std::vector<VoxelNeighbours>& neighbours) {
    DisjointSets sets(neighbours.size());
    for (std::uint32_t i = 0; i < neighbours.size(); ++i) {
        for (const std::uint32_t n : neighbours[i]) {
            if (n != no_voxel) sets.unite(i, n);
        }
    }
    std::vector<std::uint32_t> part(neighbours.size());
    std::uint32_t parts = 0;
    for (std::uint32_t i = 0; i < part.size(); ++i) part[i] = sets.root(i) == i ? parts++ : part[sets.root(i)];
    return part;
}

VoxelModel model_of(const TriangleMesh& mesh, const VoxelGrid& grid) {
    VoxelModel m;
    m.grid = grid;
    m.voxels = voxels_inside(mesh, grid);
    if (m.voxels.empty()) return m;
    m.part = parts_joined_by_faces(voxel_neighbours(grid, m.voxels));
    const std::vector<Layers> layers = layers_of_parts(m);
    std::uint32_t lowest = no_voxel;
    std::uint32_t highest = 0;
    for (const Layers& l : layers) {
        lowest = std::min(lowest, l.first);
        highest = std::max(highest, l.last);
    }
    const double foot = lowest + foot_share * (highest + 1 - lowest);
    for (const Layers& l : layers) m.does_stand.push_back(l.first <= foot ? 1 : 0);
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        if (m.does_stand[m.part[i]] == 0) continue;
        m.standing.push_back(m.voxels[i]);
        m.part_of.push_back(m.part[i]);
    }
    m.nodes = brick_nodes(grid, m.standing);
    return m;
}

// The least voxels with which the unknowns are not exceeded, to a few percent.
VoxelModel fitting_model(const TriangleMesh& mesh, const StructureOptions& o, const Context& context) {
    if (o.voxel_mm > 0) return model_of(mesh, voxel_grid(mesh, o.up, o.voxel_mm));
    const double wanted = static_cast<double>(o.unknowns);
    double size = std::cbrt(std::abs(volume_mm3(mesh)) * 3 / wanted);
    if (!(size > 0)) throw InputError(InputFault::mesh, "structure: the model has no volume");
    VoxelModel best;
    for (int attempt = 0; attempt < 12; ++attempt) {
        context.check_cancelled();
        VoxelModel m = model_of(mesh, voxel_grid(mesh, o.up, size));
        const double unknowns = 3 * static_cast<double>(m.nodes.number.size());
        if (unknowns <= wanted && unknowns > 3 * static_cast<double>(best.nodes.number.size())) best = std::move(m);
        if (unknowns <= wanted && unknowns > 0.93 * wanted) break;
        size *= std::cbrt(std::clamp(unknowns / (0.97 * wanted), 0.3, 8.0));
    }
    return best;
}

BrickLoads loads_of(const VoxelModel& m, const StructureOptions& o) {
    BrickLoads loads;
    loads.load.resize(m.nodes.number.size());
    loads.is_held.assign(m.nodes.number.size(), 0);
    const std::vector<Layers> layers = layers_of_parts(m);
    const auto height_of = [](const Layers& l) { return static_cast<double>(l.last + 1 - l.first); };
    std::uint32_t largest = m.part_of.front();
    for (const std::uint32_t p : m.part_of) {
        if (layers[p].voxels > layers[largest].voxels) largest = p;
    }
    std::vector<std::uint8_t> is_loaded(m.nodes.number.size(), 0);
    // kg/m3 * m/s2 * mm to MPa: the weight of a voxel by the area of its face.
    const double weight = o.has_own_weight ? 1e-9 * o.density_kg_per_m3 * 9.80665 * m.grid.size : 0;
    for (std::size_t i = 0; i < m.standing.size(); ++i) {
        const Layers& l = layers[m.part_of[i]];
        for (const std::uint32_t node : m.nodes.corners[i]) {
            loads.load[node].z -= weight / 8;
            if (!m.nodes.is_exterior(node)) continue;
            const double above = m.nodes.place(node)[2] - static_cast<double>(l.first);
            if (above <= foot_share * height_of(l)) loads.is_held[node] = 7;
            if (m.part_of[i] == largest && above >= (1 - foot_share) * height_of(l)) is_loaded[node] = 1;
        }
    }
    const auto loaded = static_cast<double>(std::count(is_loaded.begin(), is_loaded.end(), 1));
    const double force = o.force_n / (m.grid.size * m.grid.size);
    for (std::size_t node = 0; node < is_loaded.size(); ++node) {
        if (is_loaded[node] != 0) loads.load[node].z -= force / loaded;
    }
    return loads;
}

// From the axes of the grid to those of the mesh.
Stress turned(const Eigen::Matrix<double, 6, 1>& s, const VoxelGrid& grid) {
    Eigen::Matrix3d axes;
    for (int k = 0; k < 3; ++k) {
        const Vec3 a = grid.axis[static_cast<std::size_t>(k)];
        axes.row(k) << a.x, a.y, a.z;
    }
    Eigen::Matrix3d m;
    m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    const Eigen::Matrix3d t = axes.transpose() * m * axes;
    return {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(2, 0)};
}

double largest_tension(const Stress& s) {
    Eigen::Matrix3d m;
    m << s.xx, s.xy, s.zx, s.xy, s.yy, s.yz, s.zx, s.yz, s.zz;
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// Fills in the stress of the voxels that stand; the others keep 0.
void add_stress(StressedModel& result, const VoxelModel& m, const Brick& brick, const Displacements& displacements) {
    result.stress.resize(m.voxels.size());
    std::size_t brick_index = 0;
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        if (m.does_stand[m.part[i]] == 0) continue;
        Eigen::Matrix<double, 6, 1> s = Eigen::Matrix<double, 6, 1>::Zero();
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const Vec3 u = displacements.of_node[m.nodes.corners[brick_index][corner]];
            for (std::size_t row = 0; row < 6; ++row) {
                const double* b = &brick.stress[row][3 * corner];
                s[static_cast<int>(row)] += b[0] * u.x + b[1] * u.y + b[2] * u.z;
            }
        }
        result.stress[i] = turned(s, m.grid);
        const double tension = largest_tension(result.stress[i]);
        if (tension > result.report.largest_tension_mpa) {
            result.report.largest_tension_mpa = tension;
            result.report.largest_tension_at = m.grid.centre(m.voxels[i]);
        }
        ++brick_index;
    }
}

// Whether the voxels around a node are joined by faces among themselves.
bool is_hinge(std::uint8_t voxels) {
    auto reached = static_cast<unsigned>(voxels & -voxels);
    for (int round = 0; round < 8; ++round) {
        for (unsigned voxel = 0; voxel < 8; ++voxel) {
            if ((reached >> voxel & 1U) == 0) continue;
            for (const unsigned bit : {1U, 2U, 4U}) reached |= (1U << (voxel ^ bit)) & voxels;
        }
    }
    return reached != voxels;
}

std::vector<FloatingSolid> floating_solids(const VoxelModel& m) {
    std::vector<FloatingSolid> of_part(m.does_stand.size());
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        FloatingSolid& f = of_part[m.part[i]];
        ++f.voxels;
        f.centre = f.centre + m.grid.centre(m.voxels[i]);
        if (m.does_stand[m.part[i]] != 0 || f.is_hinged) continue;
        const VoxelPlace at = m.grid.place(m.voxels[i]);
        for (std::uint32_t corner = 0; corner < 8 && !f.is_hinged; ++corner) {
            const std::uint32_t node =
                ((at[2] + (corner >> 2U)) * m.nodes.count[1] + at[1] + (corner >> 1U & 1U)) * m.nodes.count[0] + at[0] +
                (corner & 1U);
            f.is_hinged = std::binary_search(m.nodes.number.begin(), m.nodes.number.end(), node);
        }
    }
    std::vector<FloatingSolid> floating;
    for (std::size_t p = 0; p < of_part.size(); ++p) {
        if (m.does_stand[p] != 0) continue;
        floating.push_back(of_part[p]);
        floating.back().centre = (1.0 / static_cast<double>(of_part[p].voxels)) * of_part[p].centre;
    }
    std::stable_sort(floating.begin(), floating.end(),
                     [](const auto& a, const auto& b) { return a.voxels > b.voxels; });
    return floating;
}

}  // namespace

StressedModel stress_of(const TriangleMesh& mesh, const StructureOptions& options, const Context& context) {
    check(options);
    context.progress("iterations of the stress analysis", 0, 0);
    const VoxelModel m = fitting_model(mesh, options, context);
    if (m.standing.empty()) {
        throw InputError(InputFault::mesh, "structure: no voxel lies inside the model", "pass smaller voxels");
    }
    const Brick element = brick(options.poisson_ratio);
    const Displacements displacements =
        solve(m.nodes, element, loads_of(m, options), {structure_residual, 50'000}, context);
    StressedModel result;
    result.grid = m.grid;
    result.strength_mpa = options.strength_mpa;
    result.voxels = m.voxels;
    result.is_thick = thick_voxels(m.grid, m.voxels);
    StructureReport& report = result.report;
    report.unknowns = displacements.unknowns;
    report.iterations = displacements.iterations;
    report.residual = displacements.residual;
    if (!displacements.has_converged) {
        throw InputError(InputFault::mesh,
                         "structure: the stress analysis stopped at a residual of " +
                             significant(displacements.residual, 2) + " after " +
                             std::to_string(displacements.iterations) + " iterations",
                         "pass another voxel size");
    }
    add_stress(result, m, element, displacements);
    report.standing_voxels = m.standing.size();
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        if (m.does_stand[m.part[i]] != 0 && result.is_thick[i] == 0) ++report.thin_voxels;
    }
    report.hinges = static_cast<std::size_t>(std::count_if(m.nodes.voxels.begin(), m.nodes.voxels.end(), is_hinge));
    report.floating = floating_solids(m);
    return result;
}

}  // namespace qchopper
