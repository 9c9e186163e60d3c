// From a toolpath to a program: how the arm takes every operation, and how it comes there and away.
//
// Deterministic for any number of threads. tests/cam/program/make_program_test.cpp asks every pose of the result of the
// arm again.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/context.h"
#include "base/error.h"
#include "cam/cell/cell.h"
#include "cam/program/program.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// Of an operation along a direction of the setup.
struct RefusedRun {
    std::size_t orientation = 0;
    PathRun run;
};

// Thrown where the machine cannot mill a toolpath: what refuses which pose, and by how much.
class ProgramRefused : public InputError {
 public:
    explicit ProgramRefused(const std::string& why, std::string to_do_next = {}, std::optional<RefusedRun> run = {})
        : InputError(InputFault::use, why, std::move(to_do_next)), run_(std::move(run)) {}

    // That no arm posture takes, or the part of it; nothing if something else is refused.
    const std::optional<RefusedRun>& run() const { return run_; }

 private:
    std::optional<RefusedRun> run_;
};

// Of every operation the arm configuration that carries all its runs, or few postures that carry them one after the
// other; a run that none takes is divided, and up to a fiftieth of an operation's cuts is left out where no
// configuration takes it (make_program.cpp says why). Runs that would not fit in a chunk
// (ProgramSettings::lines_per_chunk) are divided too, and operations that would fill more than a quarter of
// ProgramSettings::memory_bytes. Preconditions: the cell has a machine, the envelope is of this setup (its regions are
// tried first; it may have none). Throws ProgramRefused; InputError (use) as check_toolpath() does; Cancelled.
// O(length / 10 mm + moves).
Program make_program(const Toolpath& toolpath, const Setup& setup, const MachineReachability& reachability,
                     const Cell& cell, const Context& context = {});

// Throws ProgramRefused, as make_program() would of a toolpath in which it is operation `number`, from 1 on, if no arm
// postures carry an operation. Ways to it and from it are not asked. O(its length / 10 mm + its moves).
void check_operation(const Operation& operation, std::size_t number, const Setup& setup,
                     const MachineReachability& reachability, const Cell& cell, const Context& context = {});

// An operation as a main program sees it.
struct OutlinedOperation {
    std::size_t tool = 0;         // index in CellMachine::tools
    std::size_t orientation = 0;  // index in SurfaceAccess::orientations, with those of drilling behind them
};

// What of a program does not depend on its moves: home, frames, tools, and of each operation tool, orientation and
// angle of the table, without runs. Preconditions: the cell has a machine with these tools, the setup has these
// orientations. O(operations + tools).
Program outlined_program(const std::vector<OutlinedOperation>& operations, const Setup& setup, const Cell& cell);

}  // namespace qchopper
