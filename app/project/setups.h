// How pieces would be carved in a cell, each found out once; asked by the stop rule and again for the jobs.

#pragma once

#include <map>
#include <memory>

#include "cam/cell/cell.h"
#include "cam/setup/envelope.h"
#include "cam/setup/setup.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

// How a piece is carved.
struct Carving {
    Setup setup;
    EnvelopeReport envelope;
    std::shared_ptr<const TriangleMesh> keeps_alive;
};

class Setups {
 public:
    explicit Setups(Cell cell) : cell_(std::move(cell)) {}

    const Cell& cell() const { return cell_; }

    const Carving& of(const Piece& piece) {
        const auto [it, is_new] = known_.try_emplace(piece.mesh.get());
        if (is_new) {
            it->second.setup = choose_setup(piece, cell_);
            it->second.envelope = check_envelope(it->second.setup, cell_);
            it->second.keeps_alive = piece.mesh;
        }
        return it->second;
    }

 private:
    Cell cell_;
    std::map<const TriangleMesh*, Carving> known_;
};

}  // namespace qchopper
