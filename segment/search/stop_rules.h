// Decides whether a segmentation is finished, and which piece is cut next (Nicholson 2016, section 4.3; fits_cell,
// max_unreachable and max_cuts are additions).
//
// Tests: tests/segment/search/stop_rules_test.cpp.

#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"

namespace qchopper {

enum class Stop { any, all };  // of the rules that are set

struct StopRules {
    std::optional<std::size_t> max_faces;   // every piece has fewer
    std::optional<int> min_cuts;            // at least so many were made
    std::optional<Vec3> max_obb;            // every piece's oriented box fits in this box (mm), in some axis order
    bool fits_cell = false;                 // every piece passes the check of the cell
    std::optional<double> max_unreachable;  // of no piece a larger share of the surface is out of reach; 0..1
    bool count_narrow = false;              // surface too narrow for the smallest tool counts as out of reach
    Stop combine = Stop::all;
    int max_cuts = 500;  // a safety stop, whatever the rules
    bool operator==(const StopRules&) const = default;

    bool is_any_set() const { return max_faces || min_cuts || max_obb || fits_cell || max_unreachable; }
};

// Whether a piece, as it would be milled, passes the check of the cell. Given by a module that sees cells.
using FitsCell = std::function<bool(const Piece&)>;

// The surface of a piece, its caps left out, that no tool reaches, and its share of the piece's surface. Given by a
// module that knows the tools. The same piece must give the same values.
struct UnreachableSurface {
    double mm2 = 0;
    double share = 0;
    double allowed_mm2 = 0;  // so much may stay out of reach whatever its share
};
using UnreachableOf = std::function<UnreachableSurface(const Piece&)>;

// Into how many boxes of allowed sizes planes along its axes divide a box of this size (mm) at least; 1: it has an
// allowed size itself, infinite: no number is enough. Never less for a box that is larger along any axis.
using BlocksNeeded = std::function<double(Vec3 box_size)>;

// The planes of the piece with this index in the order in which they are tried, from its ranking (rank_piece.h).
using PlanesOnTrial =
    std::function<std::vector<Ranked>(const Segmentation&, std::size_t piece, std::vector<Ranked> ranked)>;

// Which functions of PieceChecks the rules ask, each of the pieces that pass the one before.
struct AskedOfPieces {
    bool fits_cell = false;
    bool is_machinable = false;
    bool unreachable = false;
};

// What the rules ask of other modules. The rule of a function that is empty is left out; without blocks_needed a piece
// that does not fit the cell is cut as any other.
struct PieceChecks {
    FitsCell fits_cell;
    UnreachableOf unreachable;
    BlocksNeeded blocks_needed = {};  // allowed is what some block of the cell holds
    // Whether arm, tools and holder of the cell can mill the piece: a part of the rule fits_cell where a priority is
    // given, asked of pieces that fit the cell (app/jobs/setups.cpp says why). One that they cannot mill is cut for
    // the sizes of low_blocks_needed.
    FitsCell is_machinable = {};
    BlocksNeeded low_blocks_needed = {};
    // Surface (mm2) of which less is no gain of cuts on trial (trial.h): a patch that the finest tool cannot tell from
    // none.
    double min_gain_mm2 = 0;
    // Of a joint that cuts on trial make, surface (mm2) for each mm of its outline on the skin: the strip that is
    // finished by hand, as surface that no tool reaches is.
    double seam_width_mm = 0;
    PlanesOnTrial planes_on_trial = {};  // of a piece that is cut on trial; empty: the ranking as it is
    // Works out on several threads what will be asked of these pieces, which have different meshes, so that the answers
    // are known then. Empty: each is worked out when it is asked.
    std::function<void(std::span<const Piece>, const AskedOfPieces&)> work_out = {};
};

// Whether the segmentation is finished, and if not, the piece that is cut next: of those that do not satisfy the rules
// the one with the most faces; of several, the earlier in the list.
struct NextPiece {
    bool is_finished = false;
    std::optional<std::size_t> piece;  // index; nothing and not finished: no piece is left, or max_cuts is reached
    std::vector<std::size_t> waiting;  // indices of those that will be cut as far as is decided now, the next one first
    bool is_trial = false;  // the next piece breaks max_unreachable and no other rule is left to hold: trial.h
};

// Checks the rules and keeps the results per mesh: every piece is checked once, in any number of calls.
class StopJudge {
 public:
    // `box_size` returns the size of a piece's oriented box; called only if max_obb is set.
    // `priority`: of the pieces that break a rule the one with the largest is next, after those that are too large;
    // empty: the number of faces alone.
    StopJudge(StopRules rules, PieceChecks checks, std::function<Vec3(const Piece&)> box_size,
              std::function<double(const Piece&)> priority = {});

    // `passed_over`: names of pieces for which no candidate was found, or no cuts that make them better. Where all
    // rules must hold, a piece that breaks another rule is not asked what of it is out of reach.
    NextPiece next(const Segmentation& segmentation, const std::vector<std::string>& passed_over);

    // Whether the piece breaks a rule on single pieces.
    bool breaks_a_rule(const Piece& piece) { return !why(piece).empty(); }
    // Whether at most three of the pieces, or at most a tenth, break a rule on single pieces.
    bool do_few_break_rules(const Segmentation& segmentation);
    // The rules on single pieces that it breaks, with its figures: "5,300 faces (fewer than 5,000 are wanted)". Empty:
    // none.
    std::string why(const Piece& piece);
    // Of a piece that is too large, which breaks max_obb or fits_cell: the boxes into which it is to be cut, so that
    // both hold. Empty: it is not too large, or nothing is known of the blocks.
    BlocksNeeded too_large_for(const Piece& piece);
    // Precondition: max_unreachable is set, and its function is not empty.
    const UnreachableSurface& unreachable(const Piece& piece);
    double min_gain_mm2() const { return checks_.min_gain_mm2; }
    double seam_width_mm() const { return checks_.seam_width_mm; }
    std::vector<Ranked> planes_on_trial(const Segmentation& segmentation, std::size_t piece,
                                        std::vector<Ranked> ranked) const;

 private:
    struct Verdict {
        std::weak_ptr<const TriangleMesh> mesh;  // expired: the address may be that of another mesh
        std::vector<bool> holds;                 // per rule
        std::optional<UnreachableSurface> unreachable;
    };
    struct PieceRule {
        std::function<bool(const Piece&)> holds;
        std::function<std::string(const Piece&)> fault;  // of a piece that breaks it
        // What a piece that breaks it is to be cut into; empty: it is no rule of size.
        std::function<BlocksNeeded(const Piece&)> blocks = {};
    };
    PieceRule cell_rule() const;
    bool asks_machine() const { return is_size_first_ && checks_.is_machinable; }
    void work_out(const std::vector<Piece>& pieces) const;
    Verdict& verdict(const Piece& piece);
    bool is_access_limited() const { return rules_.max_unreachable && checks_.unreachable; }
    bool is_out_of_reach(const Piece& piece) { return is_more_than(unreachable(piece), *rules_.max_unreachable); }
    static bool is_more_than(const UnreachableSurface& surface, double max_share) {
        return surface.share > max_share && surface.mm2 > surface.allowed_mm2;
    }

    StopRules rules_;
    std::function<double(const Piece&)> priority_;
    bool is_size_first_;
    PieceChecks checks_;
    std::vector<PieceRule> piece_rules_;  // the rules on single pieces without max_unreachable, which is asked last
    std::map<const TriangleMesh*, Verdict> verdicts_;
};

// Whether a box of one size fits in a box of another, in some order of its axes.
bool fits_in(Vec3 size, Vec3 limit);

}  // namespace qchopper
