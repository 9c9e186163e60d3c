// Edges are chosen by the quadric error of M. Garland and P. Heckbert, "Surface simplification using quadric error
// metrics" (1997). One end of an edge moves to the other end, so every point stays on the surface.

#include "segment/sample/thin_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <tuple>
#include <vector>

#include "segment/mesh/measure.h"
#include "segment/sample/crossing.h"

namespace qchopper {
namespace {

// Sum of squared distances to planes, weighted by area: a symmetric 4 x 4 matrix.
struct Quadric {
    std::array<double, 10> m{};

    void add_plane(Vec3 n, double d, double weight) {
        const std::array<double, 4> p{n.x, n.y, n.z, d};
        std::size_t k = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i; j < 4; ++j) m[k++] += weight * p[i] * p[j];
        }
    }
    void add(const Quadric& other) {
        for (std::size_t k = 0; k < m.size(); ++k) m[k] += other.m[k];
    }
    double at(Vec3 p) const {
        return m[0] * p.x * p.x + 2 * m[1] * p.x * p.y + 2 * m[2] * p.x * p.z + 2 * m[3] * p.x + m[4] * p.y * p.y +
               2 * m[5] * p.y * p.z + 2 * m[6] * p.y + m[7] * p.z * p.z + 2 * m[8] * p.z + m[9];
    }
};

// Triangles by the cubes of space that their boxes touch; cubes far apart may share a list.
class Neighbourhood {
 public:
    Neighbourhood(double cell, std::size_t triangles) : cell_(cell), lists_(1 << 16), seen_(triangles) {}

    void insert(std::uint32_t triangle, const Box& box) {
        for_each_list(box, [&](std::vector<std::uint32_t>& list) { list.push_back(triangle); });
    }
    void remove(std::uint32_t triangle, const Box& box) {
        for_each_list(box, [&](std::vector<std::uint32_t>& list) {
            const auto at = std::find(list.begin(), list.end(), triangle);
            if (at == list.end()) return;
            *at = list.back();
            list.pop_back();
        });
    }
    // Whether the predicate holds for any triangle whose cubes the box touches; each is asked once.
    template <class Predicate>
    bool any(const Box& box, const Predicate& predicate) {
        ++round_;
        bool found = false;
        for_each_list(box, [&](const std::vector<std::uint32_t>& list) {
            for (std::size_t i = 0; i < list.size() && !found; ++i) {
                if (seen_[list[i]] == round_) continue;
                seen_[list[i]] = round_;
                found = predicate(list[i]);
            }
        });
        return found;
    }

 private:
    template <class Visit>
    void for_each_list(const Box& box, const Visit& visit) {
        const auto cube = [&](double x) { return static_cast<std::int64_t>(std::floor(x / cell_)); };
        for (std::int64_t x = cube(box.min.x); x <= cube(box.max.x); ++x) {
            for (std::int64_t y = cube(box.min.y); y <= cube(box.max.y); ++y) {
                for (std::int64_t z = cube(box.min.z); z <= cube(box.max.z); ++z) {
                    const auto mixed = static_cast<std::uint64_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
                    visit(lists_[mixed & (lists_.size() - 1)]);
                }
            }
        }
    }

    double cell_;
    std::vector<std::vector<std::uint32_t>> lists_;
    std::vector<std::uint64_t> seen_;
    std::uint64_t round_ = 0;
};

// How much a collapse may turn and squeeze the triangles around it.
struct Strictness {
    double least_cosine;
    double least_quality;  // 1: equilateral, 0: a line
};
constexpr std::array<Strictness, 3> rounds{{{0.6, 0.15}, {0.3, 0.04}, {0.1, 0.005}}};

struct Candidate {
    double cost;
    std::uint32_t from;
    std::uint32_t to;
    std::uint64_t age;                          // of both ends' quadrics when the cost was taken
    bool operator<(const Candidate& b) const {  // the cheapest comes out of a priority queue first
        return std::tie(b.cost, b.from, b.to) < std::tie(cost, from, to);
    }
};

class Thinning {
 public:
    explicit Thinning(TriangleMesh& mesh)
        : mesh_(mesh),
          left_(mesh.triangles.size()),
          is_alive_(mesh.triangles.size(), true),
          star_(mesh.points.size()),
          quadric_(mesh.points.size()),
          age_(mesh.points.size()),
          near_(norm(bounds(mesh).size()) / 100, mesh.triangles.size()) {
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Vec3 area = area_vector(mesh, t);
            const Vec3 normal = normalized(area);
            for (const std::uint32_t corner : mesh.triangles[t]) {
                star_[corner].push_back(t);
                quadric_[corner].add_plane(normal, -dot(normal, mesh.points[mesh.triangles[t][0]]), norm(area));
            }
            near_.insert(t, box_of(mesh.triangles[t]));
        }
    }

    void run(std::size_t target, const Context& context) {
        for (const Strictness& strictness : rounds) {
            std::size_t before = left_ + 1;
            while (left_ > target && left_ < before) {
                before = left_;
                run_once(target, strictness, context);
            }
        }
        compact();
    }

 private:
    Box box_of(const Triangle& t) const {
        Box box{mesh_.points[t[0]], mesh_.points[t[0]]};
        for (const std::uint32_t corner : t) {
            for (int axis = 0; axis < 3; ++axis) {
                box.min[axis] = std::min(box.min[axis], mesh_.points[corner][axis]);
                box.max[axis] = std::max(box.max[axis], mesh_.points[corner][axis]);
            }
        }
        return box;
    }

    void run_once(std::size_t target, const Strictness& strictness, const Context& context) {
        std::priority_queue<Candidate> queue;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_alive_[t]) continue;
            for (std::size_t k = 0; k < 3; ++k)
                queue.push(candidate(mesh_.triangles[t][k], mesh_.triangles[t][(k + 1) % 3]));
        }
        while (left_ > target && !queue.empty()) {
            const Candidate next = queue.top();
            queue.pop();
            if (next.age != age_[next.from] + age_[next.to] || star_[next.from].empty() || star_[next.to].empty()) {
                continue;
            }
            if (!collapse(next.from, next.to, strictness)) continue;
            for (const std::uint32_t neighbour : neighbours(next.to)) {
                queue.push(candidate(next.to, neighbour));
                queue.push(candidate(neighbour, next.to));
            }
            if ((left_ & 0x3ff) == 0) context.check_cancelled();
        }
    }

    Candidate candidate(std::uint32_t from, std::uint32_t to) const {
        const Vec3 p = mesh_.points[to];
        const Vec3 along = p - mesh_.points[from];
        const double length2 = dot(along, along);
        // the last term spreads the points evenly where the surface is flat
        const double cost = quadric_[from].at(p) + quadric_[to].at(p) + 1e-6 * length2 * length2;
        return {cost, from, to, age_[from] + age_[to]};
    }

    std::vector<std::uint32_t> neighbours(std::uint32_t point) const {
        std::vector<std::uint32_t> found;
        for (const std::uint32_t t : star_[point]) {
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                if (corner != point) found.push_back(corner);
            }
        }
        std::sort(found.begin(), found.end());
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    }

    // A collapse keeps the surface a surface when its two ends have two neighbours in common and no more.
    bool keeps_manifold(std::uint32_t from, std::uint32_t to) const {
        const std::vector<std::uint32_t> a = neighbours(from);
        const std::vector<std::uint32_t> b = neighbours(to);
        std::vector<std::uint32_t> common;
        std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
        return common.size() == 2 && star_[common[0]].size() > 3 && star_[common[1]].size() > 3 &&
               std::binary_search(a.begin(), a.end(), to);
    }

    bool collapse(std::uint32_t from, std::uint32_t to, const Strictness& strictness) {
        if (!keeps_manifold(from, to)) return false;
        std::vector<std::uint32_t> changed;
        std::vector<Triangle> after;
        for (const std::uint32_t t : star_[from]) {
            Triangle triangle = mesh_.triangles[t];
            if (std::find(triangle.begin(), triangle.end(), to) != triangle.end()) continue;
            std::replace(triangle.begin(), triangle.end(), from, to);
            if (!is_fair(mesh_.triangles[t], triangle, strictness)) return false;
            changed.push_back(t);
            after.push_back(triangle);
        }
        if (meets_anything(from, after)) return false;
        apply(from, to, changed, after);
        return true;
    }

    bool is_fair(const Triangle& before, const Triangle& after, const Strictness& strictness) const {
        const auto normal = [&](const Triangle& t) {
            return cross(mesh_.points[t[1]] - mesh_.points[t[0]], mesh_.points[t[2]] - mesh_.points[t[0]]);
        };
        const Vec3 old_normal = normal(before);
        const Vec3 new_normal = normal(after);
        const double size = norm(new_normal);
        if (dot(old_normal, new_normal) < strictness.least_cosine * norm(old_normal) * size) return false;
        double edges2 = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 edge = mesh_.points[after[(k + 1) % 3]] - mesh_.points[after[k]];
            edges2 += dot(edge, edge);
        }
        return 2 * std::sqrt(3.0) * size > strictness.least_quality * edges2;
    }

    bool meets_anything(std::uint32_t from, const std::vector<Triangle>& after) {
        for (std::size_t i = 0; i < after.size(); ++i) {
            for (std::size_t j = i + 1; j < after.size(); ++j) {
                if (triangles_cross(mesh_.points, after[i], after[j])) return true;
            }
            const Box box = box_of(after[i]);
            const bool crosses = near_.any(box, [&](std::uint32_t t) {
                const Triangle& other = mesh_.triangles[t];
                if (std::find(other.begin(), other.end(), from) != other.end()) return false;  // goes away
                const Box other_box = box_of(other);
                for (int axis = 0; axis < 3; ++axis) {
                    if (other_box.min[axis] > box.max[axis] || other_box.max[axis] < box.min[axis]) return false;
                }
                return triangles_cross(mesh_.points, after[i], other);
            });
            if (crosses) return true;
        }
        return false;
    }

    void apply(std::uint32_t from, std::uint32_t to, const std::vector<std::uint32_t>& changed,
               const std::vector<Triangle>& after) {
        for (const std::uint32_t t : star_[from]) {
            near_.remove(t, box_of(mesh_.triangles[t]));
            if (std::find(changed.begin(), changed.end(), t) != changed.end()) continue;
            is_alive_[t] = false;
            --left_;
            for (const std::uint32_t corner : mesh_.triangles[t]) {
                if (corner != from) std::erase(star_[corner], t);
            }
        }
        for (std::size_t i = 0; i < changed.size(); ++i) {
            mesh_.triangles[changed[i]] = after[i];
            near_.insert(changed[i], box_of(after[i]));
            star_[to].push_back(changed[i]);
        }
        star_[from].clear();
        quadric_[to].add(quadric_[from]);
        ++age_[to];
    }

    void compact() {
        TriangleMesh thin;
        constexpr std::uint32_t unused = 0xffffffff;
        std::vector<std::uint32_t> place(mesh_.points.size(), unused);
        for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_alive_[t]) continue;
            Triangle triangle = mesh_.triangles[t];
            for (std::uint32_t& corner : triangle) {
                if (place[corner] == unused) {
                    place[corner] = static_cast<std::uint32_t>(thin.points.size());
                    thin.points.push_back(mesh_.points[corner]);
                }
                corner = place[corner];
            }
            thin.triangles.push_back(triangle);
        }
        mesh_ = std::move(thin);
    }

    TriangleMesh& mesh_;
    std::size_t left_;
    std::vector<bool> is_alive_;
    std::vector<std::vector<std::uint32_t>> star_;  // per point, the triangles around it
    std::vector<Quadric> quadric_;
    std::vector<std::uint64_t> age_;
    Neighbourhood near_;
};

}  // namespace

void thin_out(TriangleMesh& mesh, std::size_t target, const Context& context) {
    if (mesh.triangles.size() > target) Thinning(mesh).run(target, context);
}

}  // namespace qchopper
