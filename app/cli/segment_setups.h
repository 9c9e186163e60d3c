// How pieces would be carved in a cell, each found out once; asked by the stop rule and again for the jobs.

#pragma once

#include <map>

#include "app/report/prepare_report.h"
#include "segment/search/stop_rules.h"

namespace qchopper {

class Setups {
 public:
    explicit Setups(const Cell& cell) : cell_(cell) {}
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
    const Cell& cell_;
    std::map<const TriangleMesh*, Carving> known_;
};

}  // namespace qchopper
