// Products of poses; a block is inside where its four corners are.

#include "cam/setup/block_placement.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

Pose turned_about_z(double angle, Vec3 shift) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, shift};
}

bool has_rotary_table(const Cell& cell) {
    return cell.machine && cell.machine->rotary_table;
}

}  // namespace

Pose setup_in_table(const BlockPlacement& placement, double spoil) {
    return turned_about_z(placement.turn, {placement.x, placement.y, spoil});
}

Pose table_in_cell(const Cell& cell, double angle) {
    if (has_rotary_table(cell)) return cell.machine->rotary_table->table_in_cell * turned_about_z(angle, {});
    return {Pose{}.row, {cell.table.centre_x, cell.table.centre_y, cell.table.height}};
}

Pose setup_in_cell(const Cell& cell, double spoil, const BlockPlacement& placement, std::size_t orientation) {
    return table_in_cell(cell, placement.table_angle(orientation)) * setup_in_table(placement, spoil);
}

double inside_table(const Cell& cell, Vec3 block_size, const BlockPlacement& placement) {
    double least = std::numeric_limits<double>::infinity();
    for (const double side_x : {-0.5, 0.5}) {
        for (const double side_y : {-0.5, 0.5}) {
            const Vec3 corner = apply(setup_in_table(placement, 0), {side_x * block_size.x, side_y * block_size.y, 0});
            const double inside = has_rotary_table(cell)
                                      ? cell.machine->rotary_table->radius - std::hypot(corner.x, corner.y)
                                      : std::min(0.5 * cell.table.size_x - std::abs(corner.x),
                                                 0.5 * cell.table.size_y - std::abs(corner.y));
            least = std::min(least, inside);
        }
    }
    return least;
}

}  // namespace qchopper
