// The error for a fault that the operator can remove: what failed, why, and what to do.
//
// Thrown where the fault is found and caught once, in main, which turns its kind into an exit code
// (app/cli/exit_code.h). Internal errors are asserts; an answer such as "the plane misses the mesh" is a return value.

#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "base/sentence.h"

namespace qchopper {

enum class InputFault {
    use,      // an option or a value is not valid
    mesh,     // the content of an input is wrong: an open scan, no faces, NaN, a damaged job file
    missing,  // an input file does not exist or cannot be read
    create,   // an output cannot be created
    io,       // reading or writing failed (disk full)
    busy,     // another process holds the lock: try again later
    config    // the cell file or another settings file is wrong
};

class InputError : public std::runtime_error {
 public:
    // `what_failed` names the file or the piece and the reason; `to_do_next` is one sentence on the remedy, or empty:
    // with a key where the remedy is an option of the command line.
    InputError(InputFault fault_kind, const std::string& what_failed, Sentence to_do_next = {})
        : std::runtime_error(what_failed), fault(fault_kind), to_do(std::move(to_do_next)) {}

    InputFault fault;
    Sentence to_do;
};

}  // namespace qchopper
