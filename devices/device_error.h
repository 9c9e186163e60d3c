// What goes wrong with the cell or on the way to it, in words for the operator.
//
// The sibling of InputError. Only thrown while it is certain that no job was started by us; an answer of the cell to
// a job ("no consent", "hash mismatch") is not an error but part of JobOutcome (devices/dispatch.h).

#pragma once

#include <stdexcept>
#include <string>

namespace qchopper {

enum class DeviceFault {
    unreachable,  // nothing listens there, no name, no answer in time
    protocol,     // somebody answers who is not a cell of ours: magic, version, checksum, word order
    busy,         // another dispatcher owns the cell, or it runs another job: try again later
    refused       // the cell is not the one that was asked for, or a job cannot be put in its words
};

class DeviceError : public std::runtime_error {
 public:
    // `what_failed` names the cell and says why; `to_do` is one sentence on what helps.
    DeviceError(DeviceFault fault_kind, const std::string& what_failed, std::string to_do_next = {})
        : std::runtime_error(what_failed), fault(fault_kind), to_do(std::move(to_do_next)) {}

    DeviceFault fault;
    std::string to_do;
};

}  // namespace qchopper
