// Pictures of an assembly guide: all pieces apart, a step of the assembly, a piece with the names of its neighbours.
//
// Lengths in mm. Glue faces have one colour in all of them. Drawn without ambient light; same input, same bytes,
// whatever the number of threads (tests/app/guide/guide_pictures_test.cpp). All throw Cancelled.

#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "app/jobs/project_joints.h"
#include "base/context.h"
#include "segment/cut/piece.h"
#include "segment/picture/camera.h"
#include "segment/picture/png.h"

namespace qchopper {

constexpr Rgb glue_colour{236, 128, 36};
constexpr Rgb standing_colour{186, 188, 190};

// From a direction above, and from the opposite one: of all pieces above too, of a single piece below, so that every
// face is turned to one of the two.
enum class GuideSide { front, back };

// All pieces, moved apart, with their names.
Pixels draw_apart(std::span<const Piece> pieces, GuideSide side, const Context& context);

// What stands grey, what moves in its colour and short of its place, an arrow along the move, and the glue faces of the
// cut that the step closes.
Pixels draw_step(std::span<const Piece> pieces, const ProjectJoints& joints, const AssemblyStep& step,
                 const Context& context);

// The view of draw_step: a direction from the eye to the pieces, from above, that sees the glue faces of what stands
// and the move from the side. `move` is a unit vector.
Vec3 view_of_step(Vec3 move);

// One piece in its colour, on each glue face the name of the piece that is glued to it, where that face is seen. `seen`
// are the joints whose names are written, by their indices.
struct DrawnPiece {
    Pixels pixels;
    std::vector<std::size_t> seen;
};
DrawnPiece draw_piece(std::span<const Piece> pieces, std::size_t piece, const ProjectJoints& joints, GuideSide side,
                      const Context& context);

}  // namespace qchopper
