// Hands one job to a cell and follows it to its end, over any bus of registers.
//
// Seconds. The report is one of three words and never a guess: STARTED only if the cell has started the job, NOT
// STARTED only if it never can start it any more, UNKNOWN otherwise (tests/sim/hand_off_over_tcp_test.cpp). What to do
// next is decided by the pure state machine of hand_off.h; this drives it.

#pragma once

#include "base/context.h"
#include "base/file.h"
#include "cam/job/ticket.h"
#include "devices/bus.h"
#include "devices/dispatch_options.h"
#include "devices/job_outcome.h"

namespace qchopper {

// Throws DeviceError while nothing was started: unreachable, not a cell of ours, another cell, busy; InputError if
// `file`, the bytes of the job file, does not match the ticket or cannot be put into the drop folder. Refusals of the
// job and everything after START are a JobOutcome. With context.cancelled this returns within leave_s: before START the
// job is cancelled and the cell given back, confirmed if the cell answers in time; afterwards it is left to run by
// itself.
JobOutcome dispatch_job(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, const DispatchOptions& options,
                        const Context& context);

}  // namespace qchopper
