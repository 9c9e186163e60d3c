// What mapped_access() is asked, for tests and benches: a piece in any block, milled along given directions.

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "cam/setup/mapped_access.h"

namespace qchopper::test_pieces {

struct AccessCase {
    const TriangleMesh* mesh = nullptr;
    std::optional<std::int32_t> base;  // cut whose cap lies on the table
    Vec3 up;                           // unit
    Pose piece_in_setup;
    Box block;                     // where the piece is put by that pose, the spoil layer included
    std::vector<Vec3> directions;  // unit, in piece coordinates
    std::optional<ToolBody> tool;
    double smallest_ball_radius = 0;
    bool steep_counts = true;

    // Shifted so that the middle of the block is at x = y = 0, as setup.h wants it.
    Setup setup() const {
        Setup setup;
        setup.base = base;
        setup.up = up;
        const Vec3 middle = block.centre();
        setup.piece_in_setup = piece_in_setup;
        setup.piece_in_setup.shift = piece_in_setup.shift - Vec3{middle.x, middle.y, 0};
        setup.block.size = block.size();
        setup.spoil = -block.min.z;
        for (const Vec3& d : directions) setup.access.orientations.push_back({d, 0, 0, 0});
        setup.access.steep_counts = steep_counts;
        return setup;
    }
};

inline MappedAccess mapped_access(const AccessCase& of, const HeightFieldOptions& options = {}) {
    return qchopper::mapped_access(*of.mesh, of.setup(), {of.tool, of.smallest_ball_radius}, options);
}

}  // namespace qchopper::test_pieces
