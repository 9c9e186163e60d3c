// How pieces are carved in a cell. Each piece is computed once, for the stop rule and again for the jobs.
//
// Lengths in mm. Not for several threads at once.

#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "base/context.h"
#include "base/parallel.h"
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

    // Computes those of all pieces, on several threads. Reports progress in pieces. Throws Cancelled.
    void compute(std::span<const Piece> pieces, const Context& context) {
        std::vector<const Piece*> missing;
        for (const Piece& piece : pieces) {
            if (!carvings_.contains(piece.mesh.get())) missing.push_back(&piece);
        }
        std::mutex changing;
        std::size_t done = 0;
        parallel_for(0, missing.size(), [&](std::size_t i) {
            context.check_cancelled();
            Carving carving = carving_of(*missing[i]);
            const std::lock_guard lock(changing);
            carvings_[missing[i]->mesh.get()] = std::move(carving);
            context.progress("setups chosen", ++done, missing.size());
        });
    }

    // Valid while this object lives. Pieces are identified by their mesh.
    const Carving& of(const Piece& piece) {
        const auto [it, is_new] = carvings_.try_emplace(piece.mesh.get());
        if (is_new) it->second = carving_of(piece);
        return it->second;
    }

 private:
    Carving carving_of(const Piece& piece) const {
        Carving carving{choose_setup(piece, cell_).setups.front(), {}, piece.mesh};
        carving.envelope = check_envelope(carving.setup, cell_);
        return carving;
    }

    Cell cell_;
    std::map<const TriangleMesh*, Carving> carvings_;
};

}  // namespace qchopper
