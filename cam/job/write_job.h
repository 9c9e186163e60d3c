// Writes the job file of one piece: all that the cell and the workshop need, in one ZIP named <piece>.qjob.
//
// Same input, same bytes: no time and no random number goes in, and no number of threads
// (tests/cam/job/job_file_test.cpp). docs/developer/formats/job-folder.md holds the grammar; read_job.h reads it.

#pragma once

#include "base/files/file.h"
#include "cam/job/job.h"

namespace qchopper {

// The whole file. Throws InputError (use) if the name does not fit the wire, the number of the base's cut does not fit
// the ticket, or the file would exceed job_limit.
Bytes job_file(const JobInput& input);

// The job that goes on with another one by this program, of which program.restart is not empty: the files of `first`,
// but program, stock, picture of the deviation and ticket, which are new. Throws as job_file().
Bytes restart_job_file(const ReadJob& first, const ProgramInput& program, const Cell& cell);

// The template that goes into the job file. Throws InputError (use) if the number of the base's cut does not fit it.
TicketTemplate ticket_template(const JobInput& input);

}  // namespace qchopper
