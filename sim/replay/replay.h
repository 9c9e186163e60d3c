// The proof that a program mills its piece: the parsed program is executed on the arm of the cell, the foam is
// removed, and what is left is compared with the piece.
//
// mm, seconds, setup coordinates. Gouge holds for exact and for rounded corners alike (gouge.h); what is left is that
// of the corners that ReplayOptions::is_worst says: with the parabola of rounded_corner.h more foam stays in corners
// than with exact ones, and a real controller lies between both. The report does not depend on the number of threads
// (tests/sim/replay/replay_test.cpp).

#pragma once

#include <array>
#include <vector>

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/finding.h"
#include "sim/replay/leftover.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/path_time.h"
#include "sim/replay/scene.h"
#include "sim/replay/time_account.h"
#include "sim/replay/volumes.h"

namespace qchopper {

struct ReplayOptions {
    double cell = 0.25;              // of the foam; figures are claimed up to 0.25
    bool is_worst = true;            // corners that may be rounded are
    double gouge_floor = 0.01;       // gouges up to this are not told from none
    double max_gouge = 0.25;         // a deeper one is a finding
    double max_beyond_mm3 = 1;       // more volume gouged deeper than that is a finding
    double min_share = 0.995;        // of the reachable surface within tolerance
    double max_given_up = 0.005;     // of the surface, where nobody ordered it
    double max_standing_mm3 = 2000;  // of foam that touches the piece little; what lies on its surface is in the shares
    LeftoverOptions leftover;
    double volume_cell = 0.5;
};

struct ReplayReport {
    bool is_good = false;  // no findings
    std::vector<Finding> findings;
    std::array<std::size_t, finding_kinds> counts{};
    double largest_gouge = 0;
    SourcePlace gouge_place;
    Vec3 gouge_at;
    double largest_rounding = 0;  // deviation of a rounded corner from its point
    VolumeFigures volumes;
    LeftoverFigures leftover;  // of the last part: the piece must be there after it
    MillingFigures milling;
    PathTime time;
    std::vector<MachineTime> account;
    // Per triangle of the target: mean leftover above 0, deepest gouge below; of the base 0. Leftover only after the
    // last part.
    std::vector<float> deviation;
    StockRecord left;  // after every part but the last
    // Of what is not given up.
    double share_within() const { return ratio(leftover.within_mm2, leftover.reachable_mm2 - leftover.given_up_mm2()); }
    double share_given_up() const { return ratio(leftover.given_up_mm2(), leftover.area_mm2); }
    double share_reachable() const { return ratio(leftover.reachable_mm2, leftover.area_mm2); }
    double share_air() const { return ratio(milling.air_mm, milling.feed_mm); }
    static double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }
};

// Throws what check_scene throws, InputError (mesh) if the stock before is of another block or other directions, and
// Cancelled.
ReplayReport replay(const ParsedProgram& program, const ReplayScene& scene, const ReplayOptions& options = {},
                    const Context& context = {});

}  // namespace qchopper
