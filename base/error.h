// What a person can mend: an error that says what failed, why, what is unchanged and what to do.
//
// Thrown where the fault is seen and caught once, in main, which turns the kind into an exit code
// (app/cli/exit_code.h). Our own mistakes are asserts; an answer such as "the plane misses" is a return value.

#pragma once

#include <stdexcept>
#include <string>

namespace qchopper {

enum class InputFault {
    use,      // an option or value that makes no sense
    mesh,     // the scan itself is wrong: open, no faces, NaN
    missing,  // an input file is not there or cannot be read
    create,   // an output cannot be created
    io,       // reading or writing broke off (disk full)
    busy,     // somebody else holds the lock: try again later
    config    // the cell file or another settings file is wrong
};

class InputError : public std::runtime_error {
 public:
    // `what_failed` names the file or the piece and says why; `to_do` is one sentence on what helps.
    InputError(InputFault fault_kind, const std::string& what_failed, std::string to_do_next = {})
        : std::runtime_error(what_failed), fault(fault_kind), to_do(std::move(to_do_next)) {}

    InputFault fault;
    std::string to_do;
};

}  // namespace qchopper
