// How pieces are milled in a cell, worked out as far as is asked: on samples for the stop rules, by height fields to
// compare cuts, and placed on the table for jobs.
//
// Lengths in mm. Each stage of a piece is computed once while the piece, known by its mesh, is kept. Not for several
// threads at once.

#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/store/decisions.h"
#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/stock_fit.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// The setup of a piece by height fields (choose_setup.h): where its block stands is not known.
struct MappedSetup {
    SetupChoice choice;
    StockFit stock_fit;  // of the setup
    const Setup& setup() const { return choice.setups.front(); }
};

// The setup that a job is made of: with the place of the block, and another base or other directions where the machine
// does not hold every pose of the mapped one (reachable_setup.h). In a cell without a machine it is the mapped one.
struct PlacedSetup : MappedSetup {
    MachineReachability machine_reachability;  // of the setup
    bool fits() const { return stock_fit.fits() && machine_reachability.holds(); }
};

// The same where the block stands elsewhere: nothing if the machine does not hold every pose of the setup there. The
// cell has the tools of the setup. Precondition: the cell has a machine.
std::optional<PlacedSetup> placed_at(const PlacedSetup& known, const Piece& piece, const Cell& cell,
                                     const BlockPlacement& place);

using ToolNumbers = std::vector<std::uint16_t>;  // empty: all of the cell

class Setups {
 public:
    explicit Setups(Cell cell);

    const Cell& cell() const { return cell_; }
    // The same with the tools of set_tools() alone.
    const Cell& planned() const { return planned_; }
    // planned() with the shortest of the tools that are there in several stick-outs.
    Cell with_shortest_tools() const;

    // What the operator decided, in place of what was decided before. A change forgets all that is known of pieces.
    void set_orders(std::vector<SetupOrder> orders);
    // Where the blocks of pieces, by their names, stand for their programs; as far as that holds their setups. A change
    // forgets what is known of these pieces.
    void set_places(std::map<std::string, BlockPlacement> places);
    // Numbers of the tools that may be used where a piece has no other order; empty: all. Throws what with_tools()
    // (cam/cell/job_tools.h) throws.
    void set_tools(ToolNumbers tools);
    // Whether surface that is too narrow for the smallest tool counts as out of reach.
    void set_count_narrow(bool count_narrow);
    bool counts_narrow() const { return count_narrow_; }

    // Valid until a piece's mesh is freed, the piece is not kept, or what was decided changes.
    const MappedSetup& mapped(const Piece& piece);
    const PlacedSetup& placed(const Piece& piece);
    // The same of several pieces, on several threads. Preconditions: their meshes are different. Report progress in
    // pieces. Throw Cancelled.
    void map(std::span<const Piece> pieces, const Context& context);
    void place(std::span<const Piece> pieces, const Context& context);

    // Takes a setup that was worked out before. Precondition: it is what placed() would make of the piece.
    void know(const Piece& piece, PlacedSetup setup);

    // Forgets the setups of all other pieces.
    void keep_only(std::span<const Piece> pieces);

    // For the stop rules, cheaper than setups: whether block and extreme poses of milling from above are possible; and
    // on samples of the surface from the best base, with the cell's tools or by a tool without holder that takes every
    // direction within the cell's tilt.
    bool fits(const Piece& piece);
    UnreachableSurface unreachable(const Piece& piece);
    UnreachableSurface unreachable_without_holder(const Piece& piece);
    // For the stop rules as well, by placed(): whether the machine holds every pose of the setup, and the block is no
    // higher than the longest tool, or hardly any more of the surface is out of reach than without holder. A piece that
    // is shorter than that tool always is, because cutting it further is no remedy. True in a cell without a machine.
    bool is_machinable(const Piece& piece);
    // What the stop rules will ask of several pieces, on several threads. Precondition: their meshes are different.
    void work_out(std::span<const Piece> pieces, const AskedOfPieces& asked, Timings* timings);
    // From now on it is not, because the arm does not follow the toolpath of a piece that only long tools reach (the
    // shortest set of tools is not that of its setup). False where that is known, and for any other piece.
    bool refuse_with_long_tools(const Piece& piece);
    // By the setup that its job is made of, placed().
    UnreachableSurface left_by_setup(const Piece& piece);
    // Of cuts that make surface reachable: a square of two diameters of the finest tool, within which it cannot tell
    // what it reaches from what its own radius leaves.
    double min_gain_mm2() const;

 private:
    // How far a piece is worked out; each stage is empty until it is asked for.
    struct Stages {
        std::optional<bool> fits;
        std::optional<UnreachableSurface> sampled;
        std::optional<UnreachableSurface> without_holder;
        std::optional<MappedSetup> mapped;
        std::optional<PlacedSetup> placed;
        std::string name;  // of the piece
        std::optional<bool> is_machinable;
        std::shared_ptr<const std::vector<PieceBase>> bases;  // null: not asked yet
    };
    Stages& stages_of(const Piece& piece);
    // With its bases.
    Stages& known_stages_of(const Piece& piece);
    // Null where they are not known.
    std::shared_ptr<const std::vector<PieceBase>> known_bases(const Piece& piece) const;
    template <class Stage, class Make>
    void compute(std::optional<Stage> Stages::*stage, const std::string& what, std::span<const Piece> pieces,
                 const Context& context, const Make& make);
    const SetupOrder* order_for(const Piece& piece) const;
    SetupOptions options_for(const Piece& piece) const;
    // The sets of tools that a piece may be milled with, the shortest first.
    std::vector<ToolNumbers> tool_sets_for(const Piece& piece) const;
    bool is_good(const Setup& setup) const;
    // Whether other tools are taken in place of those of `setup`: if their block alone fits, or they leave less out of
    // reach by min_gain_mm2().
    bool is_worth(const Setup& other, bool other_fits, const Setup& setup, bool fits) const;
    MappedSetup mapped_with(const ToolNumbers& tools, const Piece& piece) const;
    MappedSetup mapped_of(const Piece& piece) const;
    PlacedSetup placed_with(const MappedSetup& mapped, const Piece& piece, const Context& context) const;
    PlacedSetup placed_of(const Piece& piece, const MappedSetup& mapped, const Context& context) const;
    UnreachableSurface sampled_of(const Piece& piece) const;
    bool find_whether_fits(const Piece& piece) const;
    bool find_whether_machinable(const Piece& piece);

    Cell cell_;
    ToolNumbers tools_;
    Cell planned_;
    std::vector<ToolNumbers> tool_sets_;  // of planned_
    std::vector<SetupOrder> orders_;
    std::map<std::string, BlockPlacement> places_;
    bool count_narrow_ = false;
    // By the owner of the mesh, which is never another one's, as an address could be.
    std::map<std::weak_ptr<const TriangleMesh>, Stages, std::owner_less<>> stages_;
};

}  // namespace qchopper
