#include "tests/segment/regions/region_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <set>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/sample/isosurface.h"
#include "segment/simplify/simplify.h"

namespace qchopper::region_shapes {
namespace {

// The surface of a union of primitives, each of which is a region: that of the primitive nearest to the centroid.
Shape of_primitives(const std::string& name, const std::vector<FieldPrimitive>& primitives, const Box& box,
                    double spacing) {
    const auto alone = [](std::vector<FieldPrimitive> list) {
        BoneField field;
        field.parts.push_back(added(0, std::move(list)));
        return field;
    };
    Shape shape{name, isosurface(alone(primitives), box, spacing, {}), {}, primitives.size()};
    SimplifyOptions fewer;
    fewer.max_faces = 8'000;
    simplify(shape.mesh, fewer);
    std::vector<BoneField> fields;
    for (const FieldPrimitive& p : primitives) fields.push_back(alone({p}));
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners_of(shape.mesh, t);
        const Vec3 centroid = (1.0 / 3) * (a + b + c);
        std::uint32_t nearest = 0;
        for (std::uint32_t i = 1; i < fields.size(); ++i) {
            if (value_at(fields[i], centroid) < value_at(fields[nearest], centroid)) nearest = i;
        }
        shape.of.push_back(nearest);
    }
    return shape;
}

// The surface of unit cells, times `side`: a square of two triangles per free side.
TriangleMesh of_cells(const std::set<std::array<int, 3>>& cells, double side) {
    TriangleMesh mesh;
    std::map<std::array<int, 3>, std::uint32_t> number;
    const auto point = [&](std::array<int, 3> p) {
        const auto [found, is_new] = number.try_emplace(p, static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back({side * p[0], side * p[1], side * p[2]});
        return found->second;
    };
    for (const std::array<int, 3>& cell : cells) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int way : {0, 1}) {
                std::array<int, 3> next = cell;
                next[axis] += way == 1 ? 1 : -1;
                if (cells.contains(next)) continue;
                const std::size_t u = (axis + 1) % 3;
                const std::size_t v = (axis + 2) % 3;
                std::array<std::uint32_t, 4> corner;
                for (std::size_t k = 0; k < 4; ++k) {
                    std::array<int, 3> p = cell;
                    p[axis] += way;
                    p[u] += k == 1 || k == 2 ? 1 : 0;
                    p[v] += k >= 2 ? 1 : 0;
                    corner[k] = point(p);
                }
                if (way == 0) std::swap(corner[1], corner[3]);
                mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                mesh.triangles.push_back({corner[0], corner[2], corner[3]});
            }
        }
    }
    return mesh;
}

std::set<std::array<int, 3>> filled(std::array<int, 3> from, std::array<int, 3> to) {
    std::set<std::array<int, 3>> cells;
    for (int x = from[0]; x < to[0]; ++x) {
        for (int y = from[1]; y < to[1]; ++y) {
            for (int z = from[2]; z < to[2]; ++z) cells.insert({x, y, z});
        }
    }
    return cells;
}

Vec3 centroid_of(const TriangleMesh& mesh, std::size_t t) {
    const auto [a, b, c] = corners_of(mesh, t);
    return (1.0 / 3) * (a + b + c);
}

}  // namespace

Dumbbell dumbbell() {
    constexpr double bar = 4;
    Dumbbell made;
    made.bar_from = -15 + std::sqrt(9.0 * 9 - bar * bar);
    made.bar_to = 15 - std::sqrt(7.5 * 7.5 - bar * bar);
    made.length = made.bar_to - made.bar_from;
    made.shape = of_primitives("dumbbell",
                               {ball({-15, 0, 0}, 9), cone({-15, 0, 0}, bar, {15, 0, 0}, bar), ball({15, 0, 0}, 7.5)},
                               {{-26, -11, -11}, {26, 11, 11}}, 1.3);
    return made;
}

Shape chain_of_balls() {
    return of_primitives("chain of balls",
                         {ball({-20, 0, 0}, 7), ball({-8.5, 0, 0}, 6), ball({2, 0, 0}, 6.5), ball({12.5, 0, 0}, 5.5),
                          ball({22, 0, 0}, 5)},
                         {{-29, -9, -9}, {29, 9, 9}}, 1.2);
}

Shape hand() {
    struct Finger {
        double angle_deg;  // from the direction of the palm
        double length;     // from its round end
        double radius;
    };
    constexpr std::array<Finger, 5> fingers{
        {{-62, 15, 2.3}, {-22, 19, 2.5}, {20, 17.5, 2.6}, {60, 13, 2.1}, {98, 14, 2.4}}};
    constexpr double palm = 10;
    std::vector<FieldPrimitive> primitives{cone({0, 0, -22}, palm, {0, 0, 0}, palm)};
    for (const Finger& finger : fingers) {
        const double angle = finger.angle_deg * std::numbers::pi / 180;
        const Vec3 way{std::sin(angle), 0, std::cos(angle)};
        const Vec3 from = finger.angle_deg > 90 ? Vec3{0, 0, -9} : Vec3{};
        primitives.push_back(cone(from + 5 * way, finger.radius, from + (palm + finger.length) * way, finger.radius));
    }
    return of_primitives("hand", primitives, {{-28, -12, -34}, {30, 12, 34}}, 1.2);
}

Shape cube_with_posts() {
    std::set<std::array<int, 3>> cells = filled({0, 0, 0}, {12, 12, 12});
    constexpr int base = 12;
    const std::array<std::array<int, 3>, 4> posts{{{1, 1, 7}, {8, 1, 8}, {1, 8, 9}, {8, 8, 10}}};
    for (const auto& [x, y, tall] : posts) cells.merge(filled({x, y, base}, {x + 3, y + 3, base + tall}));
    Shape shape{"cube with posts", of_cells(cells, 1), {}, 5};
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
        const Vec3 p = centroid_of(shape.mesh, t);
        shape.of.push_back(p.z < base + 0.1 ? 0U : 1U + (p.x > 6 ? 1U : 0U) + (p.y > 6 ? 2U : 0U));
    }
    return shape;
}

Shape two_boxes() {
    std::set<std::array<int, 3>> cells = filled({0, 0, 0}, {14, 6, 6});
    cells.merge(filled({0, 0, 6}, {6, 6, 16}));
    Shape shape{"two boxes", of_cells(cells, 1), {}, 2};
    for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
        shape.of.push_back(centroid_of(shape.mesh, t).z > 6 ? 1 : 0);
    }
    return shape;
}

Shape cylinder() {
    constexpr int around = 32;
    constexpr int tall = 12;
    constexpr double radius = 8;
    TriangleMesh mesh;
    for (int z = 0; z <= tall; ++z) {
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * std::numbers::pi * k / around;
            mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle), 1.6 * z});
        }
    }
    const auto at = [&](int z, int k) { return static_cast<std::uint32_t>(z * around + k % around); };
    const auto low = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back({0, 0, 0});
    mesh.points.push_back({0, 0, 1.6 * tall});
    Shape shape{"cylinder", {}, {}, 3};
    for (int k = 0; k < around; ++k) {
        mesh.triangles.push_back({low, at(0, k + 1), at(0, k)});
        shape.of.push_back(0);
        mesh.triangles.push_back({low + 1, at(tall, k), at(tall, k + 1)});
        shape.of.push_back(1);
        for (int z = 0; z < tall; ++z) {
            mesh.triangles.push_back({at(z, k), at(z, k + 1), at(z + 1, k + 1)});
            mesh.triangles.push_back({at(z, k), at(z + 1, k + 1), at(z + 1, k)});
            shape.of.insert(shape.of.end(), 2, 2);
        }
    }
    shape.mesh = std::move(mesh);
    return shape;
}

std::vector<std::uint32_t> flat_sides(const FaceGraph& graph) {
    DisjointSets sets(graph.size());
    for (const DualEdge& edge : graph.edges) {
        if (edge.turn < 1e-6) sets.unite(edge.face[0], edge.face[1]);
    }
    std::vector<std::uint32_t> of;
    for (std::uint32_t f = 0; f < graph.size(); ++f) of.push_back(sets.root(f));
    return of;
}

TriangleMesh with_noise(TriangleMesh mesh, double share, unsigned seed) {
    double sum = 0;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) sum += norm(mesh.points[t[k]] - mesh.points[t[(k + 1) % 3]]);
    }
    const double edge = sum / static_cast<double>(3 * mesh.triangles.size());
    std::mt19937 random(seed);
    std::normal_distribution<double> shift(0, share * edge / std::sqrt(3.0));
    for (Vec3& p : mesh.points) p = p + Vec3{shift(random), shift(random), shift(random)};
    return mesh;
}

TriangleMesh in_other_order(const TriangleMesh& mesh, unsigned seed, std::vector<std::uint32_t>& order) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> points(mesh.points.size());
    std::iota(points.begin(), points.end(), 0U);
    std::ranges::shuffle(points, random);
    TriangleMesh other;
    other.points.resize(points.size());
    for (std::size_t p = 0; p < points.size(); ++p) other.points[points[p]] = mesh.points[p];
    order.resize(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    for (const std::uint32_t t : order) {
        const Triangle& old = mesh.triangles[t];
        const std::size_t k = random() % 3;
        other.triangles.push_back({points[old[k]], points[old[(k + 1) % 3]], points[old[(k + 2) % 3]]});
    }
    return other;
}

double adjusted_rand_index(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b,
                           const std::vector<double>& area) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, double> both;
    std::map<std::uint32_t, double> of_a;
    std::map<std::uint32_t, double> of_b;
    double all = 0;
    for (std::size_t f = 0; f < area.size(); ++f) {
        both[{a[f], b[f]}] += area[f];
        of_a[a[f]] += area[f];
        of_b[b[f]] += area[f];
        all += area[f];
    }
    const auto squares = [](const auto& map) {
        double sum = 0;
        for (const auto& [key, value] : map) sum += value * value;
        return sum;
    };
    const double expected = squares(of_a) * squares(of_b) / (all * all);
    const double largest = 0.5 * (squares(of_a) + squares(of_b));
    return largest == expected ? 1 : (squares(both) - expected) / (largest - expected);
}

}  // namespace qchopper::region_shapes
