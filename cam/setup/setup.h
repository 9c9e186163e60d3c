// How a piece is held and oriented: which cap lies on the table, from which directions the tool comes, how the piece is
// turned, and the block it is milled from.
//
// Values only; lengths in mm. Setup coordinates: z up, the piece's base plane (its lowest point, without a base) at z =
// 0, the underside of the block at z = -spoil, the block's middle at x = y = 0. Along an axis with one flush face the
// piece lies against that face, along others the middle of its box is at 0. x lies along the long side of the piece's
// box in that turn, or across it where the block fits into the cell only so.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cell.h"
#include "cam/setup/block.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/surface_access.h"
#include "cam/setup/workholding.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// A cap that is a face of the block: the saw makes it, and no tool has to reach it.
struct FlushCap {
    std::int32_t cut = 0;
    BlockFace face = BlockFace::top;
    double area_mm2 = 0;
    bool operator==(const FlushCap&) const = default;
};

struct Setup {
    int base_number = 0;               // as PieceBase::number: with what --base chooses it
    std::optional<std::int32_t> base;  // number of the cut whose cap lies on the table; none: the piece owns no cap
    std::string base_description;      // the same for people
    Vec3 up{0, 0, 1};                  // unit vector in piece coordinates
    Pose piece_in_setup;
    Box box;  // of the piece in setup coordinates

    // Numbers of the tools that may be used, by order of the operator or for their stick-out; empty: all of the cell.
    std::vector<std::uint16_t> tools;

    double spoil = 0;  // thickness of the layer under the piece that stays on the table
    StockBlock block;
    std::vector<FlushCap> flush_caps;  // by cut; a face of the block is sawn in the plane of a cap if one lies in it
    double milled_caps_mm2 = 0;        // area of the caps that are neither the base nor flush
    BlockPlacement placement;          // of the block on the table

    std::optional<Workholding> workholding;  // nothing: not checked, in a cell without a machine
    SurfaceAccess access;                    // what the tool reaches
    double undercut = 0;                     // share of the projected area that faces down, base left out
    double undercut_by_count = 0;            // share of the triangles that face down, base left out
    double base_mm2 = 0;                     // projected area of the base; 0 without one
    double projected_area_mm2 = 0;           // of the piece, along up
    std::vector<std::string> warnings;
    // The block in setup coordinates: the one place that says where it lies (tests/cam/setup/setup_test.cpp).
    Box block_box() const {
        const Vec3 size = block.size;
        return {{-size.x / 2, -size.y / 2, -spoil}, {size.x / 2, size.y / 2, size.z - spoil}};
    }
    // Of it what is milled: the spoil layer under the piece is left standing.
    Box milled_box() const { return {{block_box().min.x, block_box().min.y, 0}, block_box().max}; }

    // From the tip into the spindle, in setup coordinates: a unit vector, to rounding.
    Vec3 tool_axis(const ToolOrientation& orientation) const { return rotate(piece_in_setup, orientation.tool_axis); }
    Vec3 tool_axis(std::size_t orientation) const { return tool_axis(access.orientations[orientation]); }

    FlushFaces flush_faces() const {
        FlushFaces faces{};
        for (const FlushCap& cap : flush_caps) faces[static_cast<std::size_t>(cap.face)] = true;
        return faces;
    }
    // Whether the cap of a cut is no surface to mill: the base, which is parted from the block, or sawn.
    bool is_unmilled(std::int32_t cut) const {
        return cut == base ||
               std::any_of(flush_caps.begin(), flush_caps.end(), [&](const FlushCap& cap) { return cap.cut == cut; });
    }

    bool operator==(const Setup&) const = default;
};

}  // namespace qchopper
