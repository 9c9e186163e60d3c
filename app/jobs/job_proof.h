// The proof that the program of a job mills its piece: the texts are read back and replayed in a block of foam.
//
// Nothing but what stands in the job file and in the cell file is used; reading and replay are those of sim, which
// knows neither the toolpath nor the post (tests/architecture/includes.py).

#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/files/file.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"

namespace qchopper {

struct ProofInput {
    const Cell& cell;
    const Setup& setup;                               // as in the manifest
    std::vector<Pose> setup_in_cell;                  // of a rotary table one per direction, else one
    const TriangleMesh& mesh;                         // of piece.stl, welded: setup coordinates
    const JobProgram& program;                        // see is_stated
    const std::map<std::string, std::string>& texts;  // of all its files
    const Bytes* stock = nullptr;                     // stock.bin of a part but the first
    std::vector<JobHole> holes = {};                  // of all caps
    std::vector<HalfSpace> half_spaces = {};          // of the piece, in its coordinates; empty: not known
    double replay_cell = 0.25;                        // mm; that of the stock
    // The figures of the chunks stand in the manifest, and are compared with what is read.
    bool is_stated = true;
};

struct JobProof : ProofResult {     // at most max_listed_findings
    std::vector<JobChunk> chunks;   // as read back; none if the texts cannot be read
    std::vector<float> deviation;   // mm, per triangle: positive where foam stays, negative where it is cut into
    std::vector<bool> is_given_up;  // per triangle; empty before the last part
    double time_s = 0;
    double length_mm = 0;
    Bytes stock_left;  // stock.bin for the next part, if there is one and the program could be replayed
};

// Throws Cancelled. Faults of the program are findings.
JobProof prove(const ProofInput& input, const Context& context = {});

// The mesh of piece.stl, its corners welded where they are equal. Throws InputError (mesh) naming `source`.
TriangleMesh job_mesh(const Bytes& piece_stl, const std::string& source);

}  // namespace qchopper
