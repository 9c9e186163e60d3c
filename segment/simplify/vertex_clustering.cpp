// J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes" (1993), with the mean
// of the points in a cell for all of them. A hash table holds the cells that have a point. O(points + faces), about 40
// ms for two million faces, all on one thread.
//
// The size of the cells: a surface of area vectors a passes through sum(|ax| + |ay| + |az|) / size^2 cells, and a
// closed surface has two faces per point. Where that guess leaves another number of faces, because the mesh is coarse
// or has thin walls, the size is corrected and the cells are found again.

#include "segment/simplify/vertex_clustering.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "segment/mesh/measure.h"
#include "segment/mesh/point_table.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

// The cells that have a point.
struct OccupiedCells {
    std::size_t count = 0;
    std::vector<std::uint32_t> of_point;  // counted in the order of the first point in each
};

OccupiedCells cells_of(const TriangleMesh& mesh, double size, std::size_t expected) {
    OccupiedCells found;
    found.of_point.resize(mesh.points.size());
    std::vector<Vec3> corners;  // in cells: whole numbers
    PointTable table(expected);
    const Vec3 least = bounds(mesh).min;
    const double per_mm = 1 / size;
    Vec3 last{-1, -1, -1};
    std::uint32_t number = none;
    const auto whole = [](double x) { return static_cast<double>(static_cast<std::int64_t>(x)); };
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Vec3 scaled = per_mm * (mesh.points[i] - least);
        const Vec3 corner{whole(scaled.x), whole(scaled.y), whole(scaled.z)};
        if (!(corner == last)) {  // the point before is often in the same cell
            const auto next = static_cast<std::uint32_t>(corners.size());
            number = table.find_or_note(corners, corner, PointTable::hash_of(corner), next);
            if (number == next) corners.push_back(corner);
            last = corner;
        }
        found.of_point[i] = number;
    }
    found.count = corners.size();
    return found;
}

Triangle cells_of_corners(const OccupiedCells& cells, const Triangle& t) {
    return {cells.of_point[t[0]], cells.of_point[t[1]], cells.of_point[t[2]]};
}

std::size_t faces_left(const TriangleMesh& mesh, const OccupiedCells& cells) {
    return static_cast<std::size_t>(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
        return !has_equal_corners(cells_of_corners(cells, t));
    }));
}

// Of the points in each cell; and how far a point is from it.
std::vector<Vec3> means_of(const TriangleMesh& mesh, const OccupiedCells& cells, double& largest_shift) {
    std::vector<Vec3> means(cells.count);
    std::vector<double> points(cells.count, 0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        means[cells.of_point[i]] = means[cells.of_point[i]] + mesh.points[i];
        ++points[cells.of_point[i]];
    }
    for (std::size_t c = 0; c < cells.count; ++c) means[c] = 1 / points[c] * means[c];
    double squared = 0;
    for (std::size_t i = 0; i < mesh.points.size(); ++i) {
        const Vec3 shift = means[cells.of_point[i]] - mesh.points[i];
        squared = std::max(squared, dot(shift, shift));
    }
    largest_shift = std::sqrt(squared);
    return means;
}

// Whether a face has the corners of one before it in the same sense; three whole numbers are a point of the table.
class SeenFaces {
 public:
    explicit SeenFaces(std::size_t faces) : table_(faces) { corners_.reserve(faces); }
    bool is_new(const Triangle& t) {
        const auto least = static_cast<std::size_t>(std::min_element(t.begin(), t.end()) - t.begin());
        const auto corner = [&](std::size_t k) { return static_cast<double>(t[(least + k) % 3]); };
        const Vec3 corners{corner(0), corner(1), corner(2)};
        const auto next = static_cast<std::uint32_t>(corners_.size());
        if (table_.find_or_note(corners_, corners, PointTable::hash_of(corners), next) != next) return false;
        corners_.push_back(corners);
        return true;
    }

 private:
    PointTable table_;
    std::vector<Vec3> corners_;
};

ClusteredMesh clustered(const TriangleMesh& mesh, const OccupiedCells& cells, double size, std::size_t expected) {
    ClusteredMesh result;
    result.cell = size;
    const std::vector<Vec3> means = means_of(mesh, cells, result.largest_shift);
    std::vector<bool> has_face(cells.count, false);
    SeenFaces seen(expected);
    TriangleMesh& made = result.mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle corners = cells_of_corners(cells, mesh.triangles[t]);
        if (has_equal_corners(corners) || !seen.is_new(corners)) continue;
        made.triangles.push_back(corners);
        if (!mesh.cap_of.empty()) made.cap_of.push_back(mesh.cap_of[t]);
        for (const std::uint32_t corner : corners) has_face[corner] = true;
    }
    std::vector<std::uint32_t> number(cells.count, none);
    for (std::size_t c = 0; c < cells.count; ++c) {
        if (!has_face[c]) continue;
        number[c] = static_cast<std::uint32_t>(made.points.size());
        made.points.push_back(means[c]);
    }
    for (Triangle& t : made.triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
    return result;
}

// For so many faces, as the head of this file says; the area is that of some of the faces.
double guessed_size(const TriangleMesh& mesh, std::size_t faces) {
    constexpr std::size_t asked = 100'000;
    std::size_t every = mesh.triangles.size() / asked + 1;
    if (every > 1) every |= 1U;  // faces often come in pairs of one direction
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += every) {
        const Vec3 a = area_vector(mesh, t);
        area += std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
    }
    return std::sqrt(2 * area * static_cast<double>(every) / static_cast<double>(faces));
}

}  // namespace

ClusteredMesh cluster_vertices(const TriangleMesh& mesh, double cell, const Context& context) {
    assert(cell > 0 && is_consistent(mesh));
    const OccupiedCells cells = cells_of(mesh, cell, 0);
    context.check_cancelled();
    return clustered(mesh, cells, cell, 0);
}

ClusteredMesh cluster_to(std::size_t faces, const TriangleMesh& mesh, const Context& context) {
    assert(faces > 0 && is_consistent(mesh));
    if (mesh.triangles.size() <= faces) return {mesh, 0, 0};
    constexpr int max_tries = 6;
    const auto wanted = static_cast<double>(faces);
    const Vec3 box = bounds(mesh).size();
    const double longest = std::max({box.x, box.y, box.z, std::numeric_limits<double>::min()});
    double size = guessed_size(mesh, faces);
    for (int tried = 1;; ++tried) {
        // a cell that holds all, and one too small to be counted, are the limits
        size = std::clamp(std::isfinite(size) ? size : longest, longest / (1 << 20), 2 * longest);
        const OccupiedCells cells = cells_of(mesh, size, faces);
        context.check_cancelled();
        const auto left = static_cast<double>(faces_left(mesh, cells));
        if (tried == max_tries || (left > 0.85 * wanted && left < 1.15 * wanted)) {
            return clustered(mesh, cells, size, faces);
        }
        size *= std::clamp(std::sqrt(left / wanted), 0.25, 4.0);
    }
}

}  // namespace qchopper
