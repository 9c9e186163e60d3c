// What a replay finds against a program: its kind, where in the program, and how much.
//
// Kinds are named as in reports (to_word). Of each kind all are counted, and the first and the worst ones are kept with
// their text.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

enum class FindingKind : std::uint8_t {
    chunk_order,  // the chunks are not those of the job, in its order
    tool_frame,   // $TOOL is not that of the cell file
    base_frame,   // $BASE is not that of the job
    load,         // the load data are not those of spindle and tool
    table_angle,  // the rotary table does not stand as the job says, or moves while the arm follows a line
    tool_axis,    // a line is not along the direction of its chunk
    tool_change,  // another tool is needed, and nobody was asked to change it
    reach,        // no joints hold a pose
    joint_limit,
    cable,
    arm_configuration,  // the arm would have to change its configuration, or an axis to jump
    singularity,
    joint_speed,
    outside_reach,   // the tip goes beyond the travel; of gantries only
    collision,       // of arm, spindle, holder or tool with what stands still, or with the arm
    holder_contact,  // holder or spindle in foam
    rapid_in_foam,
    feed_window,  // foam is cut slower or faster than the tool may
    link_feed,
    deep_cut,      // more foam at once than the flute is long
    plunge,        // straight down into foam with a tool whose centre does not cut
    removal_rate,  // foam is removed faster than the tool may
    below_floor,   // a tool point below -spoil + 2 mm
    spindle_off,
    spindle_speed,
    extraction_off,
    left_on,          // spindle or extraction at the end of the program
    unknown_signal,   // an output, an input or a call that the cell file does not name like that
    motion_limit,     // a speed or an acceleration above that of the cell file
    not_home,         // the arm is not at home at the beginning, at a stop or at the end
    start_from_home,  // a comment says that the way is free, and it is not
    gouge,
    gouge_volume,
    given_up,       // surface that tools of the cell reach and those that the program uses do not
    leftover,       // too small a share of the reachable surface is within tolerance
    standing_foam,  // foam beside the piece where the tools of the program come to
    missing_hole,
    shifted_hole,
    hole_depth,     // too deep, or not deep enough
    hole_diameter,  // drilled with another drill
    repeated_hole,  // drilled again after the drill left it, or no deeper than before
    extra_hole,     // a drill in foam where the program is to drill no hole
    no_cut,         // the program removes nothing
    flush_face      // a cap is not the sawn face that the job says, or a tool comes to one
};
constexpr std::size_t finding_kinds = 44;

// "chunk_order", "rapid_in_foam"
const char* to_word(FindingKind kind);

struct Finding {
    FindingKind kind = FindingKind::no_cut;
    SourcePlace place;  // line 0: of no line
    double number = 0;  // mm, degrees, mm/s or revolutions/min, as the text says
    std::string text;   // without the place
};

// Collects findings: of each kind the first ones and the one with the largest number.
class FindingLog {
 public:
    // `text` is called only if the finding is kept; `worse` is what is compared, larger is worse.
    template <class Text>
    void add(FindingKind kind, SourcePlace place, double number, double worse, const Text& text) {
        if (wants(kind, worse)) keep(kind, place, number, worse, text());
    }
    // Of one without a number.
    void add(FindingKind kind, SourcePlace place, const std::string& text) {
        add(kind, place, 0, 0, [&] { return text; });
    }
    std::size_t count(FindingKind kind) const { return kinds_[static_cast<std::size_t>(kind)].count; }
    // By kind, then in the order in which they were found.
    std::vector<Finding> findings() const;
    std::array<std::size_t, finding_kinds> counts() const;

 private:
    struct OfKind {
        std::size_t count = 0;
        double worst = 0;
        std::vector<Finding> first;
        Finding worst_one;
    };
    bool wants(FindingKind kind, double worse);
    void keep(FindingKind kind, SourcePlace place, double number, double worse, std::string text);

    std::array<OfKind, finding_kinds> kinds_;
};

}  // namespace qchopper
