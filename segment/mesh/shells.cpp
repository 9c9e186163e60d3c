#include "segment/mesh/shells.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "segment/mesh/disjoint_sets.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// Where the surface meets the line of constant height h and side s, as its coordinate t along the line.
// The rule ">= is above" makes every closed surface cross the line an even number of times, also through vertices.
struct LineFrame {
    Vec3 up;
    Vec3 side;
    Vec3 along;
};

LineFrame line_frame(Vec3 axis) {
    const Vec3 up = normalized(axis);
    const Vec3 least = std::abs(up.x) <= std::abs(up.y) && std::abs(up.x) <= std::abs(up.z) ? Vec3{1, 0, 0}
                       : std::abs(up.y) <= std::abs(up.z)                                   ? Vec3{0, 1, 0}
                                                                                            : Vec3{0, 0, 1};
    const Vec3 along = normalized(cross(up, least));
    return {up, cross(up, along), along};
}

struct Coordinates {
    double h;
    double s;
    double t;
};

// The point at which an edge passes height h, always computed from its upper end: one edge, one point.
Coordinates at_height(const Coordinates& a, const Coordinates& b, double h) {
    const Coordinates& upper = a.h >= h ? a : b;
    const Coordinates& lower = a.h >= h ? b : a;
    const double f = (upper.h - h) / (upper.h - lower.h);
    return {h, upper.s + f * (lower.s - upper.s), upper.t + f * (lower.t - upper.t)};
}

std::optional<double> crossing(const Coordinates (&corner)[3], double h, double s) {
    Coordinates ends[2] = {};
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        const Coordinates& a = corner[k];
        const Coordinates& b = corner[(k + 1) % 3];
        if ((a.h >= h) != (b.h >= h)) ends[count++] = at_height(a, b, h);
    }
    if (count != 2 || (ends[0].s >= s) == (ends[1].s >= s)) return std::nullopt;
    const Coordinates& right = ends[0].s >= s ? ends[0] : ends[1];
    const Coordinates& left = ends[0].s >= s ? ends[1] : ends[0];
    return right.t + (right.s - s) / (right.s - left.s) * (left.t - right.t);
}

// Looks for what surrounds a cavity; keeps the triangles sorted by shell so that far shells are passed over whole.
class Surroundings {
 public:
    Surroundings(const TriangleMesh& mesh, const Shells& shells, Vec3 axis)
        : mesh_(mesh), shells_(shells), frame_(line_frame(axis)), first_(shells.count() + 1, 0) {
        for (const std::uint32_t shell : shells.shell_of) ++first_[shell + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        triangles_.resize(mesh.triangles.size());
        std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) triangles_[next[shells.shell_of[t]]++] = t;
    }

    // Nothing if the line meets nothing, or does not leave material there.
    std::optional<Tether> tether(std::uint32_t cavity) const {
        const std::uint32_t from = farthest_vertex(cavity);
        const Coordinates start = coordinates(mesh_.points[from]);
        double nearest = std::numeric_limits<double>::infinity();
        std::uint32_t hit = none;
        for (std::uint32_t shell = 0; shell < shells_.count(); ++shell) {
            if (shell == cavity || !may_meet(shells_.box[shell], start)) continue;
            for (std::size_t i = first_[shell]; i < first_[shell + 1]; ++i) {
                const std::uint32_t t = triangles_[i];
                const std::optional<double> at = crossing_of(t, start);
                if (at && *at > start.t && *at < nearest) {
                    nearest = *at;
                    hit = t;
                }
            }
        }
        if (hit == none || dot(area_vector(mesh_, hit), frame_.along) <= 0) return std::nullopt;
        return Tether{cavity, from, hit};
    }

 private:
    Coordinates coordinates(Vec3 p) const { return {dot(frame_.up, p), dot(frame_.side, p), dot(frame_.along, p)}; }

    std::optional<double> crossing_of(std::uint32_t triangle, const Coordinates& start) const {
        const Triangle& t = mesh_.triangles[triangle];
        const double h[3] = {dot(frame_.up, mesh_.points[t[0]]), dot(frame_.up, mesh_.points[t[1]]),
                             dot(frame_.up, mesh_.points[t[2]])};
        const int above = (h[0] >= start.h) + (h[1] >= start.h) + (h[2] >= start.h);
        if (above == 0 || above == 3) return std::nullopt;
        const Coordinates corner[3] = {coordinates(mesh_.points[t[0]]), coordinates(mesh_.points[t[1]]),
                                       coordinates(mesh_.points[t[2]])};
        return crossing(corner, start.h, start.s);
    }

    std::uint32_t farthest_vertex(std::uint32_t shell) const {
        double best = -std::numeric_limits<double>::infinity();
        std::uint32_t vertex = none;
        for (std::size_t i = first_[shell]; i < first_[shell + 1]; ++i) {
            for (const std::uint32_t v : mesh_.triangles[triangles_[i]]) {
                const double along = dot(frame_.along, mesh_.points[v]);
                if (along <= best) continue;
                best = along;
                vertex = v;
            }
        }
        return vertex;
    }

    // Conservative: could the half-line from `start` pass the box?
    bool may_meet(const Box& box, const Coordinates& start) const {
        const Vec3 centre = box.centre();
        const Vec3 half = 0.5 * box.size();
        const auto reach = [&](Vec3 d) {
            return std::abs(d.x) * half.x + std::abs(d.y) * half.y + std::abs(d.z) * half.z + 1e-9 * norm(half);
        };
        const Coordinates c = coordinates(centre);
        return std::abs(c.h - start.h) <= reach(frame_.up) && std::abs(c.s - start.s) <= reach(frame_.side) &&
               c.t + reach(frame_.along) >= start.t;
    }

    const TriangleMesh& mesh_;
    const Shells& shells_;
    LineFrame frame_;
    std::vector<std::size_t> first_;
    std::vector<std::uint32_t> triangles_;
};

}  // namespace

Shells shells(const TriangleMesh& mesh) {
    DisjointSets sets(mesh.points.size());
    for (const Triangle& t : mesh.triangles) {
        sets.unite(t[0], t[1]);
        sets.unite(t[0], t[2]);
    }
    Shells result;
    result.shell_of.resize(mesh.triangles.size());
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    std::vector<Vec3> origin;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& triangle = mesh.triangles[t];
        std::uint32_t& shell = number[sets.root(triangle[0])];
        const Vec3 a = mesh.points[triangle[0]];
        if (shell == none) {
            shell = static_cast<std::uint32_t>(origin.size());
            origin.push_back(a);
            result.volume.push_back(0);
            result.box.push_back({a, a});
        }
        result.shell_of[t] = shell;
        const Vec3 o = origin[shell];
        const Vec3 b = mesh.points[triangle[1]];
        const Vec3 c = mesh.points[triangle[2]];
        result.volume[shell] += dot(a - o, cross(b - o, c - o)) / 6;
        Box& box = result.box[shell];
        for (const Vec3& p : {a, b, c}) {
            for (int axis = 0; axis < 3; ++axis) {
                box.min[axis] = std::min(box.min[axis], p[axis]);
                box.max[axis] = std::max(box.max[axis], p[axis]);
            }
        }
    }
    return result;
}

std::vector<Tether> tethers(const TriangleMesh& mesh, const Shells& shells, Vec3 axis) {
    std::vector<Tether> result;
    const bool has_cavity = std::any_of(shells.volume.begin(), shells.volume.end(), [](double v) { return v < 0; });
    if (!has_cavity || shells.count() == 1) return result;
    const Surroundings surroundings(mesh, shells, axis);
    for (std::uint32_t shell = 0; shell < shells.count(); ++shell) {
        if (shells.volume[shell] >= 0) continue;
        if (const auto tether = surroundings.tether(shell)) result.push_back(*tether);
    }
    return result;
}

Solids solids(const TriangleMesh& mesh, const Shells& shells, Vec3 axis) {
    Solids result;
    result.solid_of_shell.assign(shells.count(), none);
    DisjointSets sets(shells.count());
    const std::vector<Tether> ties = tethers(mesh, shells, axis);
    for (const Tether& tie : ties) sets.unite(tie.cavity, shells.shell_of[tie.triangle]);
    const auto cavities = std::count_if(shells.volume.begin(), shells.volume.end(), [](double v) { return v < 0; });
    result.loose_cavities = static_cast<std::size_t>(cavities) - ties.size();
    for (std::uint32_t shell = 0; shell < shells.count(); ++shell) {
        std::uint32_t& solid = result.solid_of_shell[sets.root(shell)];
        if (solid == none) solid = static_cast<std::uint32_t>(result.count++);
        result.solid_of_shell[shell] = solid;
    }
    return result;
}

TriangleMesh extract(const TriangleMesh& mesh, const std::vector<std::uint32_t>& group_of, std::uint32_t group) {
    TriangleMesh part;
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (group_of[t] != group) continue;
        Triangle triangle = mesh.triangles[t];
        for (std::uint32_t& v : triangle) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(triangle);
        if (!mesh.cap_of.empty()) part.cap_of.push_back(mesh.cap_of[t]);
    }
    return part;
}

std::vector<TriangleMesh> split_solids(const TriangleMesh& mesh, Vec3 axis) {
    const Shells all_shells = shells(mesh);
    const Solids all_solids = solids(mesh, all_shells, axis);
    if (all_solids.count == 1) return {mesh};
    // One pass for all solids: a scan can have hundreds.
    std::vector<TriangleMesh> parts(all_solids.count);
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        TriangleMesh& part = parts[all_solids.solid_of_shell[all_shells.shell_of[t]]];
        Triangle triangle = mesh.triangles[t];
        for (std::uint32_t& v : triangle) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(part.points.size());
                part.points.push_back(mesh.points[v]);
            }
            v = number[v];
        }
        part.triangles.push_back(triangle);
        if (!mesh.cap_of.empty()) part.cap_of.push_back(mesh.cap_of[t]);
    }
    return parts;
}

}  // namespace qchopper
