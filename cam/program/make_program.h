// From a toolpath to a program: how the arm holds every section, and how it comes there and away.
//
// Deterministic for any number of threads. tests/cam/program/make_program_test.cpp asks every pose of the result of the
// arm again.

#pragma once

#include <string>
#include <utility>

#include "base/context.h"
#include "base/error.h"
#include "cam/cell/cell.h"
#include "cam/program/program.h"
#include "cam/setup/placement/work_envelope.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/toolpath.h"

namespace qchopper {

// Thrown where the machine cannot carve a toolpath: what refuses which pose, and by how much.
class ProgramRefused : public InputError {
 public:
    explicit ProgramRefused(const std::string& why, std::string to_do_next = {})
        : InputError(InputFault::use, why, std::move(to_do_next)) {}
};

// Of every operation the hold of the arm that carries all its runs, or few holds that carry them one after the other; a
// run that none carries is divided, and up to a fiftieth of an operation's cuts is left out where no hold
// carries it (make_program.cpp says why). Runs that would not fit in a chunk
// (ProgramSettings::lines_per_chunk) are divided too, and sections that would fill more than a quarter of
// ProgramSettings::memory_bytes. Preconditions: the cell has a machine, the envelope is of this setup (its regions are
// tried first; it may have none). Throws ProgramRefused; InputError (use) as check_toolpath() does; Cancelled.
// O(length / 10 mm + moves).
Program make_program(const Toolpath& toolpath, const Setup& setup, const WorkEnvelope& envelope, const Cell& cell,
                     const Context& context = {});

}  // namespace qchopper
