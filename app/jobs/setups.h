// How pieces are milled in a cell. Each piece is computed once, for the stop rules and again for the jobs.
//
// Lengths in mm. Not for several threads at once.

#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "app/store/decisions.h"
#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/stock_fit.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct PieceSetup {
    SetupChoice choice;
    StockFit stock_fit;                             // of the setup
    std::shared_ptr<const TriangleMesh> mesh;       // of the piece; while it is held, its address is not used again
    MachineReachability machine_reachability = {};  // of the setup; not checked but by held()
    const Setup& setup() const { return choice.setups.front(); }
    bool fits() const { return stock_fit.fits() && machine_reachability.holds(); }
};

class Setups {
 public:
    explicit Setups(Cell cell) : cell_(std::move(cell)), planned_(cell_) {}

    const Cell& cell() const { return cell_; }
    // The same with the tools of set_tools() alone.
    const Cell& planned() const { return planned_; }

    // What the operator decided, in place of what was decided before.
    void set_orders(std::vector<SetupOrder> orders);
    // Numbers of the tools that may be used where a piece has no other order; empty: all. Throws what with_tools() of
    // cam/cell/allowed_tools.h throws.
    void set_tools(std::vector<std::uint16_t> tools);
    // Whether surface that is too narrow for the smallest tool counts as out of reach.
    void set_count_narrow(bool count_narrow);
    bool counts_narrow() const { return count_narrow_; }

    // Computes those of all pieces, on several threads. Reports progress in pieces. Throws Cancelled.
    void compute(std::span<const Piece> pieces, const Context& context);
    // Valid while this object lives. Pieces are identified by their mesh.
    const PieceSetup& of(const Piece& piece);

    // The setups that jobs are made of: with the place of the block, and another base or other directions where the
    // machine does not hold every pose of the best one (reachable_setup.h). The same as compute() and of() in a cell
    // without a machine.
    void compute_held(std::span<const Piece> pieces, const Context& context);
    const PieceSetup& held(const Piece& piece);

    // Forgets those of all other pieces.
    void keep_only(std::span<const Piece> pieces);

    // For the stop rules, cheaper than held() and of(): whether block and extreme poses of milling from above are
    // possible, kept per mesh; and on samples of the surface from the best base.
    bool fits(const Piece& piece);
    // For the stop rules as well, by held(): whether the machine holds every pose of the setup, and the block is no
    // higher than the longest tool, or hardly any more of the surface is out of reach than of a tool without holder
    // that tilts in all directions. A piece that is shorter than that tool always is, because cutting it further is no
    // remedy. True in a cell without a machine.
    bool is_machinable(const Piece& piece);
    UnreachableSurface unreachable(const Piece& piece);
    // By the setup that its job is made of, held().
    UnreachableSurface left_by_setup(const Piece& piece);
    // Of cuts that make surface reachable: a square of two diameters of the finest tool, within which it cannot tell
    // what it reaches from what its own radius leaves.
    double min_gain_mm2() const;

 private:
    using PieceSetups = std::map<const TriangleMesh*, PieceSetup>;
    struct Answer {
        std::weak_ptr<const TriangleMesh> mesh;  // expired: the address may be that of another mesh
        bool is_yes = false;
    };
    using Answers = std::map<const TriangleMesh*, Answer>;
    const SetupOrder* order_for(const Piece& piece) const;
    SetupOptions options_for(const Piece& piece) const;
    const std::vector<std::uint16_t>& tools_for(const Piece& piece) const;
    PieceSetup piece_setup_of(const Piece& piece) const;
    bool find_whether_machinable(const Piece& piece);
    PieceSetup held_of(const Piece& piece, const PieceSetup& best, const Context& context) const;

    Cell cell_;
    std::vector<std::uint16_t> tools_;
    Cell planned_;
    std::vector<SetupOrder> orders_;
    bool count_narrow_ = false;
    PieceSetups piece_setups_;
    PieceSetups held_;
    Answers fits_;
    Answers machinable_;
};

}  // namespace qchopper
