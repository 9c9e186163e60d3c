// What proof and replay of a job's program are given: the contents of the job file, and the scene that they describe.

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "cam/cell/cell.h"
#include "cam/job/job.h"

namespace qchopper {

struct EnteredValues;
struct ParsedProgram;
struct ReplayScene;
struct StockRecord;

struct ProofInput {
    const Cell& cell;
    const Setup& setup;                               // as in the manifest
    std::vector<Pose> setup_in_cell;                  // of a rotary table one per direction, else one
    const TriangleMesh& mesh;                         // of piece.stl, welded: setup coordinates
    const JobProgram& program;                        // see is_stated
    const std::map<std::string, std::string>& texts;  // of all its files
    const Bytes* stock = nullptr;                     // stock.bin, where the program has_stock()
    std::vector<JobHole> holes = {};                  // of all caps
    std::vector<HalfSpace> half_spaces = {};          // of the piece, in its coordinates; empty: not known
    double replay_cell = 0.25;                        // mm; that of the stock
    // The figures of the chunks stand in the manifest, and are compared with what is read.
    bool is_stated = true;
    // What a person enters at the controller in place of the planned values (app/jobs/entered/entered_values.h), which
    // difference_from_plan() took; nullptr: nothing. It must outlive this.
    const EnteredValues* entered = nullptr;
};

// The mesh of piece.stl, its corners welded where they are equal. Throws InputError (mesh) naming `source`.
TriangleMesh job_mesh(const Bytes& piece_stl, const std::string& source);

// Of a job that parse_job took and that holds a program. It must outlive this.
class JobContents {
 public:
    // Throws InputError (mesh) naming `source` for a mesh that is none.
    JobContents(const ReadJob& job, const std::string& source);

    // Refers to this and to the cell.
    ProofInput input(const Cell& cell) const;
    const TriangleMesh& mesh() const { return mesh_; }

 private:
    const ReadJob& job_;
    TriangleMesh mesh_;
    std::map<std::string, std::string> texts_;
};

// The texts of the job. Throws LineRefused (sim/program/program_line.h). Precondition: the program is in the language
// of the cell.
ParsedProgram program_read_back(const ProofInput& input);

// Without the stock before. The input must outlive it. Precondition: the cell has a machine.
ReplayScene scene_of(const ProofInput& input);

// What the part before, or the chunks before a restart, left (sim/replay/stock/stock_record.h); nothing where the
// program begins in the block. Throws InputError (mesh).
std::optional<StockRecord> stock_before(const ProofInput& input);

}  // namespace qchopper
