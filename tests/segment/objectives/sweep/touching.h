// Makes solids that touch themselves and each other without crossing: built of the cells of a grid.
//
// Some neighbouring cells are parted by a wall without thickness (two coincident faces that face each other), some
// cells meet in an edge or a corner only. Where more than two faces meet at an edge they are paired at random, through
// the material or through the void, and every vertex has one fan of faces: closed, oriented, two faces at every edge,
// as a repaired scan is.

#pragma once

#include <array>
#include <map>
#include <random>
#include <vector>

#include "segment/mesh/connectivity/disjoint_sets.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper::touching {

using Cell = std::array<int, 3>;

struct Face {
    std::array<Cell, 4> corner;  // counter-clockwise seen from outside
    std::uint32_t first = 0;     // number of its first corner; the middles of its edges follow the four corners
};

struct Grid {
    int n = 0;
    std::vector<char> full;
    std::map<std::pair<Cell, int>, bool> wall;  // between a cell and the next along an axis
    std::size_t place(const Cell& c) const {
        const auto side = static_cast<std::size_t>(n);
        return (static_cast<std::size_t>(c[0]) * side + static_cast<std::size_t>(c[1])) * side +
               static_cast<std::size_t>(c[2]);
    }
    bool is_full(const Cell& c) const {
        for (const int x : c) {
            if (x < 0 || x >= n) return false;
        }
        return full[place(c)] != 0;
    }
    bool is_walled(const Cell& c, int axis) const {
        const auto at = wall.find({c, axis});
        return at != wall.end() && at->second;
    }
    // Has cell c a face towards its neighbour along the axis?
    bool has_face(const Cell& c, int axis, bool forwards) const {
        Cell other = c;
        other[static_cast<std::size_t>(axis)] += forwards ? 1 : -1;
        return is_full(c) && (!is_full(other) || is_walled(forwards ? c : other, axis));
    }
};

inline Grid random_grid(std::mt19937& random, int n, double share_full, double share_walls) {
    std::uniform_real_distribution<double> share(0, 1);
    Grid grid;
    grid.n = n;
    const auto side = static_cast<std::size_t>(n);
    grid.full.resize(side * side * side);
    for (char& cell : grid.full) cell = share(random) < share_full ? 1 : 0;
    grid.full[0] = 1;
    for (int x = 0; x < n; ++x) {
        for (int y = 0; y < n; ++y) {
            for (int z = 0; z < n; ++z) {
                for (int axis = 0; axis < 3; ++axis) grid.wall[{{x, y, z}, axis}] = share(random) < share_walls;
            }
        }
    }
    return grid;
}

// The faces of all cells, found by cell, axis and direction.
struct Faces {
    std::vector<Face> all;
    std::map<std::tuple<Cell, int, bool>, std::uint32_t> number;
};

inline Faces faces_of(const Grid& grid) {
    Faces faces;
    for (int x = 0; x < grid.n; ++x) {
        for (int y = 0; y < grid.n; ++y) {
            for (int z = 0; z < grid.n; ++z) {
                for (int axis = 0; axis < 3; ++axis) {
                    for (const bool forwards : {false, true}) {
                        const Cell c{x, y, z};
                        if (!grid.has_face(c, axis, forwards)) continue;
                        const auto a = static_cast<std::size_t>(axis);
                        Face face;
                        for (std::size_t k = 0; k < 4; ++k) {
                            const std::size_t turn = forwards ? k : 3 - k;
                            face.corner[k] = c;
                            face.corner[k][a] += forwards ? 1 : 0;
                            face.corner[k][(a + 1) % 3] += turn == 1 || turn == 2 ? 1 : 0;
                            face.corner[k][(a + 2) % 3] += turn >= 2 ? 1 : 0;
                        }
                        face.first = static_cast<std::uint32_t>(8 * faces.all.size());
                        faces.number[{c, axis, forwards}] = static_cast<std::uint32_t>(faces.all.size());
                        faces.all.push_back(face);
                    }
                }
            }
        }
    }
    return faces;
}

// The two corners of a face at the ends of an edge, and the middle of the edge.
inline std::array<std::uint32_t, 3> edge_of(const Face& face, const Cell& from, const Cell& to) {
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        if (face.corner[k] == from && face.corner[next] == to)
            return {face.first + k, face.first + next, face.first + 4 + k};
        if (face.corner[k] == to && face.corner[next] == from)
            return {face.first + next, face.first + k, face.first + 4 + k};
    }
    return {};
}

// Along the edge that two faces share their corners and middles become one vertex each.
inline void join(DisjointSets& corners, const Face& f, const Face& g, const Cell& from, const Cell& to) {
    const auto a = edge_of(f, from, to);
    const auto b = edge_of(g, from, to);
    for (std::size_t k = 0; k < 3; ++k) corners.unite(a[k], b[k]);
}

// The faces around the edge that starts at `from` along `axis`, in turn: those that lead into material and those that
// lead out of it alternate.
inline void pair_around(const Faces& faces, const Cell& from, int axis, bool through_material, DisjointSets& corners) {
    const auto a = static_cast<std::size_t>((axis + 1) % 3);
    const auto b = static_cast<std::size_t>((axis + 2) % 3);
    const auto quadrant = [&](int q) {
        Cell c = from;
        if (q == 1 || q == 2) c[a] -= 1;
        if (q == 2 || q == 3) c[b] -= 1;
        return c;
    };
    std::vector<std::uint32_t> in_turn;
    bool starts_inwards = false;
    for (int q = 0; q < 4; ++q) {
        const int along = static_cast<int>(q % 2 == 0 ? a : b);
        const bool forwards = q == 2 || q == 3;  // from quadrant q to the next
        for (const bool inwards : {false, true}) {
            const Cell c = quadrant(inwards ? (q + 1) % 4 : q);
            const auto at = faces.number.find({c, along, inwards ? !forwards : forwards});
            if (at == faces.number.end()) continue;
            if (in_turn.empty()) starts_inwards = inwards;
            in_turn.push_back(at->second);
        }
    }
    Cell to = from;
    to[static_cast<std::size_t>(axis)] += 1;
    const std::size_t shift = starts_inwards == through_material ? 0 : 1;
    for (std::size_t i = shift; i < in_turn.size() + shift; i += 2) {
        join(corners, faces.all[in_turn[i % in_turn.size()]], faces.all[in_turn[(i + 1) % in_turn.size()]], from, to);
    }
}

// Every face has a point of its own somewhere in it, so that the two sides of a wall are divided differently.
inline TriangleMesh mesh_of(std::mt19937& random, const Grid& grid) {
    const Faces faces = faces_of(grid);
    DisjointSets corners(8 * faces.all.size());
    for (int x = 0; x <= grid.n; ++x) {
        for (int y = 0; y <= grid.n; ++y) {
            for (int z = 0; z <= grid.n; ++z) {
                for (int axis = 0; axis < 3; ++axis) pair_around(faces, {x, y, z}, axis, random() % 2 == 0, corners);
            }
        }
    }
    TriangleMesh mesh;
    std::map<std::uint32_t, std::uint32_t> number;
    const auto vertex = [&](std::uint32_t corner, Vec3 p) {
        const auto [at, is_new] =
            number.try_emplace(corners.root(corner), static_cast<std::uint32_t>(mesh.points.size()));
        if (is_new) mesh.points.push_back(p);
        return at->second;
    };
    for (const Face& face : faces.all) {
        std::array<Vec3, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
            const Cell& c = face.corner[k];
            p[k] = {16.0 * c[0], 16.0 * c[1], 16.0 * c[2]};
        }
        const double s = static_cast<double>(1 + random() % 15) / 16;
        const double t = static_cast<double>(1 + random() % 15) / 16;
        const auto middle = static_cast<std::uint32_t>(mesh.points.size());
        mesh.points.push_back(p[0] + s * (p[1] - p[0]) + t * (p[3] - p[0]));
        for (std::uint32_t k = 0; k < 4; ++k) {
            const Vec3 a = p[k];
            const Vec3 b = p[(k + 1) % 4];
            const std::uint32_t from = vertex(face.first + k, a);
            const std::uint32_t half_way = vertex(face.first + 4 + k, 0.5 * (a + b));
            const std::uint32_t to = vertex(face.first + (k + 1) % 4, b);
            mesh.triangles.push_back({from, half_way, middle});
            mesh.triangles.push_back({half_way, to, middle});
        }
    }
    return mesh;
}

}  // namespace qchopper::touching
