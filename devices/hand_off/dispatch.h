// Hands one job to a cell and follows it to its end, over any bus of registers.
//
// The verdict is STARTED only if the cell has started the job, NOT STARTED only if it has not and no longer can, and
// UNKNOWN otherwise (tests/sim/cell/hand_off_over_tcp_test.cpp, tests/sim/cell/hand_off_faults_test.cpp). The pure
// state machine of hand_off.h decides each action; this performs them.

#pragma once

#include "base/context.h"
#include "base/files/file.h"
#include "cam/job/ticket.h"
#include "devices/hand_off/dispatch_options.h"
#include "devices/journal/job_outcome.h"
#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"

namespace qchopper {

// `file` holds the bytes of the job file. Throws DeviceError while nothing was started: unreachable, no cell of this
// register map, another cell, busy. Throws InputError if `file` does not match the ticket's size and SHA-256, or if the
// ticket cannot be encoded. If options.journal throws an InputError before START, the job is cancelled and the error
// passed on. Refusals of the job, a drop folder that cannot be written to, and everything after START are a JobOutcome.
//
// Once context.cancelled is set this returns within timings.leave_s. Before START the job is cancelled and the lease
// released, and the outcome states whether the cell has confirmed that. After START the job runs on by itself, unless
// options.stop_when_cancelled: then Stop is sent, and this returns within timings.answer_s.
JobOutcome dispatch_job(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, const DispatchOptions& options,
                        const Context& context);

// Takes up a job of an earlier dispatcher, named by its ticket: claims the cell, queries the job, and follows it to its
// end if it has started; otherwise cancels it, which makes its START void. options.past is what the journal knows. The
// same errors and the same end on request, except that UNKNOWN may stand before an error: then the job stays open in
// the journal.
JobOutcome adopt_job(RegisterBus& bus, const WireTicket& ticket, const DispatchOptions& options,
                     const Context& context);

}  // namespace qchopper
