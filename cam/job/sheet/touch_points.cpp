// Points on a face lie at half the height that is milled, where no clamp is.

#include "cam/job/sheet/touch_points.h"

#include "cam/job/glue_faces.h"

namespace qchopper {
namespace {

constexpr double from_end = 0.1;  // of the length of the face

std::string sign_of(double value) {
    return value < 0 ? "-" : "+";
}

TouchPoint corner(const Box& block, const std::string& name, bool max_x, bool max_y) {
    const Vec3 at{max_x ? block.max.x : block.min.x, max_y ? block.max.y : block.min.y, block.max.z};
    return {name, "corner of the block's top at " + sign_of(max_x ? 1 : -1) + "x, " + sign_of(max_y ? 1 : -1) + "y",
            at};
}

// At a share of the length of a face at the side.
TouchPoint on_face(const Box& block, const std::string& name, BlockFace face, double share) {
    const int across = static_cast<int>(axis_of(face));
    const int along = 1 - across;
    Vec3 at;
    at[across] = is_at_max(face) ? block.max[across] : block.min[across];
    at[along] = block.min[along] + share * block.size()[along];
    at.z = block.max.z / 2;
    const std::string end = share == 0.5 ? "its middle" : sign_of(share - 0.5) + (along == 0 ? "x" : "y");
    return {name, "glue face " + std::string(names_of(face)(face)) + ", at " + end, at};
}

}  // namespace

std::array<TouchPoint, 3> touch_points(const Setup& setup) {
    const Box block = setup.block_box();
    const TouchFaces faces = touch_faces(setup);
    if (!faces.first) {
        return {corner(block, "P1", false, false), corner(block, "P2", true, false), corner(block, "P3", false, true)};
    }
    const bool is_high = is_at_max(*faces.first);
    const bool is_x = axis_of(*faces.first) == 0;
    return {on_face(block, "P1", *faces.first, from_end), on_face(block, "P2", *faces.first, 1 - from_end),
            faces.second ? on_face(block, "P3", *faces.second, 0.5)
                         : corner(block, "P3", is_x && is_high, !is_x && is_high)};
}

}  // namespace qchopper
