// Edges are chosen by the quadric error of M. Garland and P. Heckbert, "Surface simplification using quadric error
// metrics" (1997). One end of an edge moves to the other end, so every point stays on the surface.

#include "segment/sample/thin_out.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
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

constexpr std::uint32_t gone = 1U << 31;  // the age of a point that is no more

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
    // Triangles whose cubes the box touches, each once.
    void collect(const Box& box, std::vector<std::uint32_t>& found) {
        ++round_;
        found.clear();
        for_each_list(box, [&](const std::vector<std::uint32_t>& list) {
            for (const std::uint32_t triangle : list) {
                if (seen_[triangle] == round_) continue;
                seen_[triangle] = round_;
                found.push_back(triangle);
            }
        });
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

Box joined(const Box& a, const Box& b) {
    Box both = a;
    for (int axis = 0; axis < 3; ++axis) {
        both.min[axis] = std::min(both.min[axis], b.min[axis]);
        both.max[axis] = std::max(both.max[axis], b.max[axis]);
    }
    return both;
}

bool overlap(const Box& a, const Box& b) {
    return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y && a.min.z <= b.max.z &&
           b.min.z <= a.max.z;
}

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
    std::uint32_t age;                          // of both ends' quadrics when the cost was taken
    bool operator<(const Candidate& b) const {  // the cheapest comes out of a priority queue first
        if (cost != b.cost) return cost > b.cost;
        return from != b.from ? from > b.from : to > b.to;
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
        const Box a{mesh_.points[t[0]], mesh_.points[t[0]]};
        const Box b{mesh_.points[t[1]], mesh_.points[t[1]]};
        return joined(joined(a, b), {mesh_.points[t[2]], mesh_.points[t[2]]});
    }

    void run_once(std::size_t target, const Strictness& strictness, const Context& context) {
        std::vector<Candidate> all;
        for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
            if (!is_alive_[t]) continue;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = mesh_.triangles[t][k];
                const std::uint32_t b = mesh_.triangles[t][(k + 1) % 3];
                if (a < b) all.push_back(cheaper(a, b));
            }
        }
        std::priority_queue<Candidate> queue({}, std::move(all));
        while (left_ > target && !queue.empty()) {
            const Candidate next = queue.top();
            queue.pop();
            if (next.age != age_[next.from] + age_[next.to]) continue;
            std::uint32_t kept = next.to;
            if (!collapse(next.from, next.to, strictness)) {
                if (!collapse(next.to, next.from, strictness)) continue;
                kept = next.from;
            }
            for (const std::uint32_t neighbour : neighbours(kept)) queue.push(cheaper(kept, neighbour));
            if ((left_ & 0x3ff) == 0) context.check_cancelled();
        }
    }

    Candidate cheaper(std::uint32_t a, std::uint32_t b) const { return std::max(candidate(a, b), candidate(b, a)); }

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
        std::vector<Box> boxes;
        Box all = box_of(after.front());
        for (const Triangle& triangle : after) {
            boxes.push_back(box_of(triangle));
            all = joined(all, boxes.back());
        }
        for (std::size_t i = 0; i < after.size(); ++i) {
            for (std::size_t j = i + 1; j < after.size(); ++j) {
                if (triangles_cross(mesh_.points, after[i], after[j])) return true;
            }
        }
        near_.collect(all, nearby_);
        for (const std::uint32_t t : nearby_) {
            const Triangle& other = mesh_.triangles[t];
            const Box box = box_of(other);
            if (!overlap(box, all)) continue;
            if (std::find(other.begin(), other.end(), from) != other.end()) continue;  // goes away
            for (std::size_t i = 0; i < after.size(); ++i) {
                if (overlap(box, boxes[i]) && triangles_cross(mesh_.points, after[i], other)) return true;
            }
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
        age_[from] = gone;
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
    std::vector<std::uint32_t> age_;
    Neighbourhood near_;
    std::vector<std::uint32_t> nearby_;  // kept to save allocations
};

}  // namespace

void thin_out(TriangleMesh& mesh, std::size_t target, const Context& context) {
    if (mesh.triangles.size() > target) Thinning(mesh).run(target, context);
}

}  // namespace qchopper
