// How pieces are carved in a cell. Each piece is computed once, for the stop rules and again for the jobs.
//
// Lengths in mm. Not for several threads at once.

#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "app/project/decisions.h"
#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/envelope.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct Carving {
    SetupChoice choice;
    EnvelopeReport envelope;                   // of the setup
    std::shared_ptr<const TriangleMesh> mesh;  // of the piece; while it is held, its address is not used again
    const Setup& setup() const { return choice.setups.front(); }
};

class Setups {
 public:
    explicit Setups(Cell cell) : cell_(std::move(cell)) {}

    const Cell& cell() const { return cell_; }

    // What the operator decided, in place of what was decided before.
    void set_orders(std::vector<SetupOrder> orders);
    // Whether surface that is too narrow for the smallest tool counts as out of reach.
    void set_count_narrow(bool count_narrow);

    // Computes those of all pieces, on several threads. Reports progress in pieces. Throws Cancelled.
    void compute(std::span<const Piece> pieces, const Context& context);
    // Valid while this object lives. Pieces are identified by their mesh.
    const Carving& of(const Piece& piece);

    // Forgets those of all other pieces.
    void keep_only(std::span<const Piece> pieces);

    // For the stop rules, cheaper than of(): by boxes, and on samples of the surface from the best base.
    bool fits(const Piece& piece) const { return fits_cell(piece, cell_); }
    UnreachableSurface unreachable(const Piece& piece);

 private:
    SetupOptions options_for(const Piece& piece) const;
    Carving carving_of(const Piece& piece) const;

    Cell cell_;
    std::vector<SetupOrder> orders_;
    bool count_narrow_ = false;
    std::map<const TriangleMesh*, Carving> carvings_;
};

}  // namespace qchopper
