// Caps that are faces of the block: that those are which the job names, by the piece and the block alone, and that no
// tool comes to them.
//
// mm, setup coordinates. A cap is the triangles of the target in its plane that face outwards. It is a face of the
// block if all of its points are as near to that face as the cell's flush tolerance, and half a step of the sizes of
// sawn blocks, allow. What is milled off a block that is too long by a margin would not show that: foam that is left is
// asked for on what is milled alone (tests/sim/replay/flush_check_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

constexpr double flush_slack = 0.05;   // mm, half of a step of the sizes of sawn blocks
constexpr double min_flush_cap = 400;  // mm2; a smaller cap may lie in a face of the block without being named

// What a sawn face may be off, so that a tool that comes no nearer mills nothing of it.
constexpr double sawn_beyond = 0.5;    // mm
constexpr double sawn_turn = 8.73e-4;  // radians: a twentieth of a degree
constexpr double run_over = 2;         // mm; a tool comes no farther over the rim than this and its radius

// Whether a triangle lies in a plane, within the single precision of piece.stl, and faces outwards. O(1).
bool is_in_plane(const TriangleMesh& mesh, std::size_t triangle, Vec3 point, Vec3 outward);

// Findings against what the job says of the caps: one that is no face of the block and is said to be, and one that is
// said to be milled and is a face, where the cell keeps foam. O(caps * triangles).
void check_flush_faces(const ReplayScene& scene, FindingLog& log);

// Findings against tools that would mill a sawn face that stands out by sawn_beyond and is turned by sawn_turn, farther
// from its rim than their radius and run_over. Drills are left out: their holes are judged for themselves. The cost is
// that of find_gouges, and O(caps * points * edges of the rim). Throws Cancelled.
void check_beside_flush_faces(const ToolPath& path, const ReplayScene& scene, FindingLog& log, const Context& context);

}  // namespace qchopper
