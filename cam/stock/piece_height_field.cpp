// A linear function over the part of a triangle that lies in a cell is largest at a corner of that part. The triangle
// is cut into the strips of the rows (I. E. Sutherland and G. W. Hodgman, "Reentrant polygon clipping", 1974); the
// corners of its parts in cells are then the corners of a strip and where the sides of a strip cross the lines between
// columns. O(triangles + cells covered); several threads raise a cell to the highest of them, whatever their order.
// The highest point of a solid over any place lies on a triangle that does not face down: the others are left out.
//
// cells_under.h finds centres only: here each cell that a triangle touches counts, with the highest point in it.

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "base/box.h"
#include "base/error.h"
#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "segment/mesh/footprint.h"
#include "segment/mesh/measure.h"
#include "segment/raster/shared_value.h"

namespace qchopper {
namespace {

constexpr std::size_t triangles_at_once = 4096;
constexpr double beside_line = 0.075;  // mm

// The least float that is not below a height; never -0, which would make the result depend on the order.
float rounded_up(double height) {
    const float nearest = static_cast<float>(height) + 0.0F;
    if (!(static_cast<double>(nearest) < height)) return nearest;
    // The bits of a float count up with it above zero, and down below.
    const auto bits = std::bit_cast<std::int32_t>(nearest);
    return std::bit_cast<float>(bits >= 0 ? bits + 1 : bits - 1) + 0.0F;
}

// A convex polygon in cells across and mm along the direction: a triangle cut by two lines has five corners.
struct StripPart {
    std::array<Vec3, 8> corner;
    std::size_t size = 0;
    void add(Vec3 p) { corner[size++] = p; }
};

// Where the side from a to b has a given y, which lies between theirs; x and z not beyond the corners.
Vec3 at_y(Vec3 a, Vec3 b, double y) {
    const double t = (y - a.y) / (b.y - a.y);
    const auto between = [t](double p, double q) {
        return std::clamp(p + t * (q - p), std::min(p, q), std::max(p, q));
    };
    return {between(a.x, b.x), y, between(a.z, b.z)};
}

// The part of a polygon on one side of a line of constant y.
StripPart cut_at(const StripPart& polygon, double y, bool keeps_above) {
    StripPart part;
    for (std::size_t k = 0; k < polygon.size; ++k) {
        const Vec3& a = polygon.corner[k];
        const Vec3& b = polygon.corner[(k + 1) % polygon.size];
        const bool is_a_in = keeps_above ? a.y >= y : a.y <= y;
        const bool is_b_in = keeps_above ? b.y >= y : b.y <= y;
        if (is_a_in) part.add(a);
        if (is_a_in != is_b_in) part.add(at_y(a, b, y));
    }
    return part;
}

class CellRow {
 public:
    CellRow(HeightField& map, std::size_t row) : first_(&map.height[row * map.columns]), columns_(map.columns) {}

    // Of the side from a to b: its first corner, and where it crosses lines between columns.
    void raise_along(Vec3 a, Vec3 b) {
        const auto column = static_cast<std::ptrdiff_t>(std::floor(a.x));
        raise(column, a.z);
        if (static_cast<double>(column) == a.x) raise(column - 1, a.z);
        const double low = std::min(a.x, b.x);
        const double high = std::max(a.x, b.x);
        for (double line = std::floor(low) + 1; line < high; ++line) {
            const double z = a.z + (line - a.x) / (b.x - a.x) * (b.z - a.z);
            const double within = std::clamp(z, std::min(a.z, b.z), std::max(a.z, b.z));
            raise(static_cast<std::ptrdiff_t>(line) - 1, within);
            raise(static_cast<std::ptrdiff_t>(line), within);
        }
    }

 private:
    void raise(std::ptrdiff_t column, double z) {
        if (column < 0 || column >= static_cast<std::ptrdiff_t>(columns_)) return;
        raise_shared(first_[column], rounded_up(z));
    }

    float* first_;
    std::size_t columns_;
};

// Precondition: the corners lie in the map.
void raise_under(HeightField& map, const StripPart& triangle) {
    double low = triangle.corner[0].y;
    double high = low;
    for (std::size_t k = 1; k < 3; ++k) {
        low = std::min(low, triangle.corner[k].y);
        high = std::max(high, triangle.corner[k].y);
    }
    // A corner on the line between rows touches both.
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(low) - 1));
    const auto last = std::min(static_cast<std::size_t>(std::max(0.0, std::floor(high))), map.rows - 1);
    StripPart rest = triangle;
    for (std::size_t row = first; row <= last && rest.size > 0; ++row) {
        const auto line = static_cast<double>(row + 1);
        const StripPart strip = row == last ? rest : cut_at(rest, line, false);
        CellRow cells(map, row);
        for (std::size_t k = 0; k < strip.size; ++k) {
            cells.raise_along(strip.corner[k], strip.corner[(k + 1) % strip.size]);
        }
        if (row < last) rest = cut_at(rest, line, true);
    }
}

void raise_to_mesh(HeightField& map, const TriangleMesh& mesh) {
    parallel_ranges(0, mesh.triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            if (rotate(map.piece_in_field, area_vector(mesh, t)).z < 0) continue;
            StripPart triangle;
            for (const auto index : mesh.triangles[t]) {
                const Vec3 p = apply(map.piece_in_field, mesh.points[index]);
                triangle.add({p.x / map.cell, p.y / map.cell, p.z});
            }
            raise_under(map, triangle);
        }
    });
}

Box box_in_map(const Pose& piece_in_field, const Setup& setup, const TriangleMesh& mesh) {
    const Pose setup_in_piece = inverse(setup.piece_in_setup);
    const Box block = setup.block_box();
    Box box;
    for (unsigned k = 0; k < 8; ++k) {
        const Vec3 corner{(k & 1U) != 0 ? block.max.x : block.min.x, (k & 2U) != 0 ? block.max.y : block.min.y,
                          (k & 4U) != 0 ? block.max.z : block.min.z};
        const Vec3 p = rotate(piece_in_field, apply(setup_in_piece, corner));
        if (k == 0) box = {p, p};
        extend(box, p);
    }
    for (const Vec3& p : mesh.points) extend(box, rotate(piece_in_field, p));
    return box;
}

// A plane of constant z of the setup, as far as it lies between two heights of the map.
class FloorPlane {
 public:
    FloorPlane(const Setup& setup, const HeightField& map, double floor_z, double low, double high)
        : cell_(map.cell), low_(low), high_(high) {
        const Pose map_in_setup = setup.piece_in_setup * inverse(map.piece_in_field);
        upright_ = map_in_setup.row[2];
        above_origin_ = floor_z - map_in_setup.shift.z;
    }

    // Its highest point over a cell.
    float height(std::size_t column, std::size_t row) const {
        // The corner at which the plane is highest is the one farthest against the upright.
        const double x = cell_ * (static_cast<double>(column) + (upright_.x < 0 ? 1 : 0));
        const double y = cell_ * (static_cast<double>(row) + (upright_.y < 0 ? 1 : 0));
        const double rest = above_origin_ - upright_.x * x - upright_.y * y;
        if (upright_.z > 1e-9) return rounded_up(std::clamp(rest / upright_.z, low_, high_));
        return rounded_up(rest > 0 ? high_ : low_);
    }

 private:
    double cell_;
    double low_;
    double high_;
    Vec3 upright_;
    double above_origin_ = 0;
};

void check(const PieceHeightFieldOptions& options) {
    const auto refuse = [](const std::string& name, const std::string& rule) {
        throw InputError(InputFault::use, name + " of the height map " + rule, "give another value");
    };
    if (!(options.cell > 0) || !std::isfinite(options.cell)) refuse("cell", "is not a length above zero");
    if (!(options.border >= 0) || !std::isfinite(options.border)) refuse("border", "is not a length from zero on");
    if (!std::isfinite(options.floor_z)) refuse("floor_z", "is not finite");
}

}  // namespace

HeightField piece_height_field(const Setup& setup, const TriangleMesh& mesh, std::size_t orientation,
                               const PieceHeightFieldOptions& options) {
    check(options);
    assert(is_consistent(mesh) && orientation < setup.access.orientations.size());
    HeightField map;
    map.cell = options.cell;
    const Vec3 tool_axis = setup.access.orientations[orientation].tool_axis;
    // Rows along the sides of the block: the map of a block that is turned under it is up to twice as large.
    const auto [e1, e2] = frame_under(setup.tool_axis(orientation));
    map.piece_in_field.row = {rotate_inverse(setup.piece_in_setup, e1), rotate_inverse(setup.piece_in_setup, e2),
                              tool_axis};
    const Box box = box_in_map(map.piece_in_field, setup, mesh);
    // Sides of the block, and walls that lie whole cells from them, are neither on lines between cells nor in the
    // middle, where rounding decides whether a cell has them. It is the same length for all cells, so that maps with
    // the same border share their frame.
    const double beside = options.border + beside_line;
    const Vec3 size = box.size() + Vec3{2 * beside, 2 * beside, 0};
    if ((size.x / map.cell + 1) * (size.y / map.cell + 1) > static_cast<double>(max_field_cells)) {
        throw InputError(InputFault::use, "a height map of the block would have too many cells", "use larger cells");
    }
    map.columns = static_cast<std::size_t>(size.x / map.cell) + 1;
    map.rows = static_cast<std::size_t>(size.y / map.cell) + 1;
    const double middle = box.centre().z;
    map.piece_in_field.shift = {beside - box.min.x, beside - box.min.y, -middle};
    map.height.resize(map.columns * map.rows);
    const FloorPlane floor(setup, map, options.floor_z, box.min.z - middle, box.max.z - middle);
    parallel_for(0, map.rows, [&](std::size_t row) {
        for (std::size_t c = 0; c < map.columns; ++c) map.height[row * map.columns + c] = floor.height(c, row);
    });
    raise_to_mesh(map, mesh);
    return map;
}

Vec3 field_to_setup(const Setup& setup, const HeightField& map, Vec3 point) {
    return apply(setup.piece_in_setup, apply_inverse(map.piece_in_field, point));
}

Vec3 setup_to_field(const Setup& setup, const HeightField& map, Vec3 point) {
    return apply(map.piece_in_field, apply_inverse(setup.piece_in_setup, point));
}

}  // namespace qchopper
