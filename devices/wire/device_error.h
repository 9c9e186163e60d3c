// The error of a cell that cannot be used: what failed, why, and what to do.
//
// The counterpart of InputError, also caught in main. Thrown only while it is certain that this hand-off has started no
// job. That the cell refuses a job ("no consent", "hash mismatch") is not an error but a JobOutcome.

#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include "base/sentence.h"

namespace qchopper {

enum class DeviceFault {
    unreachable,  // nothing listens, the host name cannot be resolved, or no answer in time
    protocol,     // what answers has no STATUS of this register map: magic, version, checksum, order of registers
    busy,         // another dispatcher owns the cell, or it is not idle: try again later
    refused       // another cell than ordered, or it refused CLAIM
};

class DeviceError : public std::runtime_error {
 public:
    // `what_failed` names the cell and the reason; `to_do_next` is one sentence, or empty.
    DeviceError(DeviceFault fault_kind, const std::string& what_failed, Sentence to_do_next = {})
        : std::runtime_error(what_failed), fault(fault_kind), to_do(std::move(to_do_next)) {}

    DeviceFault fault;
    Sentence to_do;
};

}  // namespace qchopper
