// How pieces are carved in a cell. Each piece is computed once, for the stop rule and again for the jobs.
//
// Lengths in mm. Not for several threads at once.

#pragma once

#include <map>
#include <memory>

#include "cam/cell/cell.h"
#include "cam/setup/envelope.h"
#include "cam/setup/setup.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

struct Carving {
    Setup setup;
    EnvelopeReport envelope;
    std::shared_ptr<const TriangleMesh> mesh;  // of the piece; while it is held, its address is not used again
};

class Setups {
 public:
    explicit Setups(Cell cell) : cell_(std::move(cell)) {}

    const Cell& cell() const { return cell_; }

    // Valid while this object lives. Pieces are identified by their mesh.
    const Carving& of(const Piece& piece) {
        const auto [it, is_new] = carvings_.try_emplace(piece.mesh.get());
        if (is_new) {
            it->second.setup = choose_setup(piece, cell_);
            it->second.envelope = check_envelope(it->second.setup, cell_);
            it->second.mesh = piece.mesh;
        }
        return it->second;
    }

 private:
    Cell cell_;
    std::map<const TriangleMesh*, Carving> carvings_;
};

}  // namespace qchopper
