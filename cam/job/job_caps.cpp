// From the plane of a cut to the frame of the cap on one of its sides. O(triangles of the piece + corners of contacts).

#include "cam/job/job_caps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "base/text.h"
#include "base/units.h"
#include "cam/job/glue_faces.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

// With its origin in the point of the plane that is nearest to that of the piece.
Pose cap_frame(const HalfSpace& half_space) {
    const Vec3 out = -half_space.up();
    const PlaneFrame frame = frame_across(out);
    const Vec3 origin = half_space.plane.offset * half_space.plane.normal;
    // rows of piece_in_cap, then inverted
    return inverse(Pose{{frame.u, frame.v, out}, {-dot(frame.u, origin), -dot(frame.v, origin), -dot(out, origin)}});
}

Point2 in_cap(const Pose& cap_in_piece, Vec3 point) {
    const Vec3 p = apply_inverse(cap_in_piece, point);
    return {p.x, p.y};
}

// The side of the block in which a cap lies by its sawn face, at the side; nothing for other caps.
std::optional<BlockFace> sawn_side(const Setup& setup, std::int32_t cut) {
    for (const FlushCap& cap : setup.flush_caps) {
        if (cap.cut == cut && cap.face != BlockFace::top) return cap.face;
    }
    return std::nullopt;
}

// Why no tool may come out along the cap's normal; empty: one may.
std::string not_drilled_because(const HalfSpace& half_space, const Setup& setup, const Cell& cell) {
    if (setup.base && *setup.base == half_space.cut) return "its cap is the base, which lies on the table";
    if (sawn_side(setup, half_space.cut)) {
        return "its cap is a sawn side of the block: drill it before the block is carved";
    }
    if (!cell.machine) return "the cell file describes no machine";
    const Vec3 out = rotate(setup.piece_in_setup, -half_space.up());
    const double tilt = std::acos(std::clamp(out.z, -1.0, 1.0));
    const double max_tilt = cell.machine->robot ? cell.machine->max_tilt : 0;
    if (tilt <= max_tilt + 1e-6) return {};
    return "the tool would lean by " + fixed(tilt / degree, 0) + " degrees, and " + fixed(max_tilt / degree, 0) +
           " are allowed";
}

CapJoint cap_joint(const PieceJoint& joint, const Pose& cap_in_piece, const Setup& setup, const std::string& by_hand) {
    CapJoint made;
    made.area_mm2 = joint.contact.area_mm2;
    const Vec3 out = rotate(cap_in_piece, {0, 0, 1});
    for (const Dowel& dowel : joint.dowels) {
        const Point2 at = in_cap(cap_in_piece, dowel.point);
        made.holes.push_back({0, dowel.size.diameter, dowel.size.depth, at,
                              apply(setup.piece_in_setup, apply(cap_in_piece, {at.x, at.y, 0})),
                              -rotate(setup.piece_in_setup, out), false, by_hand});
    }
    return made;
}

// The outline in the frame, whose origin is moved to the least corner.
void draw_outline(DrawnCap& drawn, const Piece& piece, const HalfSpace& half_space) {
    Pose& frame = drawn.cap.cap_in_piece;
    const FlatPolygons flat = cap_polygons(piece, half_space);
    Rectangle2 box;
    for (const Vec3& p : flat.points) box.include(in_cap(frame, p));
    frame.shift = apply(frame, {box.min.x, box.min.y, 0});
    drawn.size = {box.max.x - box.min.x, box.max.y - box.min.y};
    for (const Loop& loop : outlines(flat)) {
        std::vector<Point2> line;
        for (const std::uint32_t p : loop) line.push_back(in_cap(frame, flat.points[p]));
        drawn.outline.push_back(std::move(line));
    }
}

// The corners of a side of the block, in the frame.
std::vector<Point2> corners_of_side(const Setup& setup, BlockFace side, const Pose& cap_in_piece) {
    const Box block = setup.block_box();
    const int across = static_cast<int>(axis_of(side));
    Vec3 at = is_at_max(side) ? block.max : block.min;
    const Pose cap_in_setup = setup.piece_in_setup * cap_in_piece;
    std::vector<Point2> corners;
    for (const auto& [is_far, is_high] : {std::pair(false, false), {true, false}, {true, true}, {false, true}}) {
        at[1 - across] = is_far ? block.max[1 - across] : block.min[1 - across];
        at.z = is_high ? block.max.z : block.min.z;
        corners.push_back(in_cap(cap_in_setup, at));
    }
    return corners;
}

}  // namespace

std::vector<DrawnCap> caps_of(std::span<const Piece> pieces, std::size_t index, std::span<const PieceJoint> joints,
                              const Setup& setup, const Cell& cell) {
    std::vector<DrawnCap> caps;
    for (const HalfSpace& half_space : pieces[index].half_spaces) {
        DrawnCap drawn;
        for (const PieceJoint& joint : joints) {
            if (joint.cut != half_space.cut || (joint.below != index && joint.above != index)) continue;
            if (drawn.cap.joints.empty()) {
                drawn.cap.cut = half_space.cut;
                drawn.cap.cap_in_piece = cap_frame(half_space);
                draw_outline(drawn, pieces[index], half_space);
            }
            const Pose& frame = drawn.cap.cap_in_piece;
            CapJoint made = cap_joint(joint, frame, setup, not_drilled_because(half_space, setup, cell));
            made.neighbour = pieces[joint.below == index ? joint.above : joint.below].name;
            made.note = describe_fault(joint, pieces, joints);
            drawn.cap.joints.push_back(std::move(made));
            drawn.names_at.push_back(in_cap(frame, middle_of(joint.contact, joint.plane)));
        }
        if (drawn.cap.joints.empty()) continue;
        if (const std::optional<BlockFace> side = sawn_side(setup, half_space.cut)) {
            drawn.block_side = corners_of_side(setup, *side, drawn.cap.cap_in_piece);
        }
        caps.push_back(std::move(drawn));
    }
    std::sort(caps.begin(), caps.end(), [](const DrawnCap& a, const DrawnCap& b) { return a.cap.cut < b.cap.cut; });
    std::size_t number = 0;
    for (DrawnCap& drawn : caps) {
        for (CapJoint& joint : drawn.cap.joints) {
            for (JobHole& hole : joint.holes) hole.number = ++number;
        }
    }
    return caps;
}

void decide_holes(std::vector<DrawnCap>& caps, const std::vector<std::size_t>& drilled,
                  const std::map<std::size_t, std::string>& reasons, const std::string& because) {
    for (DrawnCap& drawn : caps) {
        for (CapJoint& joint : drawn.cap.joints) {
            for (JobHole& hole : joint.holes) {
                hole.by_robot = std::binary_search(drilled.begin(), drilled.end(), hole.number);
                if (hole.by_robot || !hole.by_hand.empty()) continue;
                const auto own = reasons.find(hole.number);
                hole.by_hand = own == reasons.end() || own->second.empty() ? because : own->second;
            }
        }
    }
}

}  // namespace qchopper
