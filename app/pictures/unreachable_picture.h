// Draws all pieces apart, from two opposite sides, their surface in colours by what becomes of it in their setups, with
// a legend.
//
// The colours are those of the setup sheets (cam/job/sheet/setup_picture.h): what does not count as out of reach is
// pale. Same input, same bytes, whatever the number of threads (tests/app/pictures/unreachable_picture_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "base/files/file.h"
#include "cam/setup/surface_access.h"
#include "segment/cut/piece.h"

namespace qchopper {

// How the surface of one piece is milled.
struct MilledPiece {
    std::span<const SurfaceState> states;  // per triangle of the piece; empty: not known, all of it counts as reached
    std::optional<std::int32_t> base_cut;  // whose cap lies on the table
};

// Per triangle the number of its SurfaceState, or base_state where it is of the base.
constexpr std::uint8_t base_state = static_cast<std::uint8_t>(SurfaceState::ignored) + 1;
std::vector<std::uint8_t> surface_states(const TriangleMesh& mesh, const MilledPiece& milled);

// PNG. `shifts` (mm) moves the pieces apart; `narrow_counts`: what is too narrow for the smallest tool counts as out of
// reach. Preconditions: one entry per piece in each; there is a piece. Throws
// Cancelled.
Bytes draw_unreachable(std::span<const Piece> pieces, std::span<const Vec3> shifts, std::span<const MilledPiece> milled,
                       bool narrow_counts, const Context& context = {});

}  // namespace qchopper
