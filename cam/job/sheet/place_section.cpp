// Of a block with glue faces at its sides the tolerance is that of touching off, of others the foam around the piece.

#include "cam/job/sheet/place_section.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "base/text.h"
#include "base/units.h"
#include "cam/job/glue_faces.h"
#include "cam/job/sheet/sheet_html.h"
#include "cam/job/sheet/touch_points.h"

namespace qchopper {
namespace {

using namespace sheet;

// The sides of the block lie along the axes of the cell where it is not turned.
std::string where_it_stands(const Cell& cell, const Setup& setup) {
    const BlockPlacement& place = setup.placement;
    const std::string size = size_text(setup.block.size, setup.flush_faces()) + " mm along x, y and z";
    const bool is_rotary = cell.machine && cell.machine->rotary_table;
    const std::string axes = is_rotary ? "the rotary table at 0 degrees" : "the cell";
    if (place.x == 0 && place.y == 0 && place.turn == 0) {
        return "Stand the block in the middle of the table, its sides along the axes of " + axes + ": " + size + ".";
    }
    std::string text = "Stand the block, " + size + ", with its middle " + fixed(place.x, 1) + " mm along x and " +
                       fixed(place.y, 1) + " mm along y from the middle of the table";
    if (place.turn == 0) return text + ", its sides along the axes of " + axes + ".";
    return text + ", its x turned by " + fixed(degrees(place.turn), 1) + " degrees from that of " + axes +
           ", counted from x towards y.";
}

// Of a block without glue faces at its sides, in the middle of which the piece lies.
std::string how_exactly(const Setup& setup) {
    const Vec3 block = setup.block.size;
    const Vec3 piece = setup.box.size();
    const double beside_x = (block.x - piece.x) / 2;
    const double beside_y = (block.y - piece.y) / 2;
    return paragraph("How exactly it must lie: the foam around the piece is what the block may be off, " +
                     fixed(beside_x, 1) + " mm along x and " + fixed(beside_y, 1) +
                     " mm along y. Further off, the piece sticks out of the block. A turn by 1 degree moves the "
                     "corners of the block by " +
                     fixed(std::hypot(block.x, block.y) / 2 * std::sin(radians(1)), 1) +
                     " mm. The underside must lie flat on the table.");
}

std::string name_of(BlockFace face) {
    return names_of(face)(face);
}

BlockFace opposite(BlockFace face) {
    return static_cast<BlockFace>(static_cast<std::size_t>(face) ^ 1U);
}

const char* name_of_axis(std::size_t axis) {
    return axis == 0 ? "x" : "y";
}

// Of a block with a glue face at its sides.
std::string touch_off(const Setup& setup) {
    const TouchFaces faces = touch_faces(setup);
    const FlushFaces flush = setup.flush_faces();
    const std::size_t across = axis_of(*faces.first);
    const std::size_t along = 1 - across;
    std::string html =
        "How exactly it must lie: skin is carved in the base frame, and glue faces are where the saw left "
        "them. They may be off that frame by " +
        significant(touch_off_mm, 3) + " mm and " + significant(touch_off_deg, 3) +
        " degrees (assumed); a step in the skin becomes up to twice as high.";
    if (!faces.second) {
        const std::vector<double> foam = foam_around(setup);
        const double least = std::min(foam[2 * along], foam[2 * along + 1]);
        html += std::string(" Along ") + name_of_axis(along) +
                ", where no glue face is, the block may be off by the foam, " + fixed(least, 1) + " mm.";
    }
    html = paragraph(html + " The underside must lie flat on the table.");
    std::string how = "Touch off three points: P1 and P2 on glue face " + name_of(*faces.first) +
                      " give the direction of " + name_of_axis(along) + " and the place along " + name_of_axis(across) +
                      ", P3 " + (faces.second ? "on glue face " + name_of(*faces.second) : std::string("at a corner")) +
                      " the place along " + name_of_axis(along) + ". z comes from the table: z = 0 is " +
                      fixed(setup.spoil, 1) +
                      " mm above it. Touch faces from the side; the middle of the tool stands off by its radius. If "
                      "the points are off their place, move the block, or correct the base frame by as much.";
    for (const std::optional<BlockFace>& touched : {faces.first, faces.second}) {
        if (!touched || !flush[static_cast<std::size_t>(opposite(*touched))]) continue;
        how += " Do not touch " + name_of(opposite(*touched)) + ", opposite of " + name_of(*touched) +
               ": it takes the error of the size.";
    }
    return html + paragraph(how);
}

}  // namespace

std::string place_section(const JobInput& input) {
    const Setup& setup = input.setup;
    const bool is_glued = touch_faces(setup).first.has_value();
    std::string html = paragraph(where_it_stands(input.cell, setup));
    if (!is_glued) html += how_exactly(setup);
    const Pose in_cell =
        setup_in_cell(input.cell, setup.spoil, {setup.placement.x, setup.placement.y, setup.placement.turn, {}}, 0);
    const bool is_rotary = input.cell.machine && input.cell.machine->rotary_table;
    html += paragraph(
        "Base frame of the program: its origin lies on the vertical through the middle of the block, at the height of "
        "the piece's base, " +
        fixed(setup.spoil, 1) +
        " mm above the table, its axes along the sides of the block, z up. In the cell it is at (" +
        fixed(in_cell.shift.x, 1) + ", " + fixed(in_cell.shift.y, 1) + ", " + fixed(in_cell.shift.z, 1) + ")" +
        (is_rotary ? " with the rotary table at 0 degrees." : "."));
    html += is_glued ? touch_off(setup)
                     : paragraph(
                           "Touch off three corners with the tool tip: P1 and P2 give the direction of x, P3 the "
                           "side of y. If one is off its place, move the block, or correct the base frame by as "
                           "much.");
    Rows rows{{word("point"), word("where"), right("x"), right("y"), right("z"), right("x in the cell"),
               right("y in the cell"), right("z in the cell")}};
    for (const TouchPoint& point : touch_points(setup)) {
        const Vec3 at = apply(in_cell, point.at);
        rows.push_back({word(point.name), word(point.where), number(point.at.x, 1), number(point.at.y, 1),
                        number(point.at.z, 1), number(at.x, 1), number(at.y, 1), number(at.z, 1)});
    }
    return section("2. Place of the block and base frame", html + table(rows));
}

}  // namespace qchopper
