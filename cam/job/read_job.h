// Reads the job file of one piece: all that the cell and the workshop need, in one ZIP named <piece>.qjob.
//
// Checked are the form, the schema, and every size and SHA-256 (tests/cam/job/job_file_test.cpp).
// docs/developer/formats/job-folder.md holds the grammar; write_job.h writes it. Needs neither rays nor pictures.

#pragma once

#include <filesystem>
#include <string>

#include "base/files/file.h"
#include "cam/job/job.h"

namespace qchopper {

// "<piece>.qjob", of part 2 and on "<piece>.p2.qjob"; of a restart "<piece>.r5.qjob" or "<piece>.p2.r5.qjob", where
// chunks count from 1 over all parts (0: no restart). Throws InputError (use) if the name does not fit the wire
// (is_portable_name).
std::string job_file_name(const std::string& piece, std::uint16_t part = 1, std::uint32_t from_chunk = 0);

// The bytes of a job file (job_limit). Throws InputError: missing if it cannot be read, mesh if it is too large.
Bytes read_job(const std::filesystem::path& path);

// Throws InputError (mesh) naming `source` if the bytes are not exactly what job_file writes for a job of this schema.
ReadJob parse_job(const Bytes& bytes, const std::string& source);

// The template of a job bound to its file, which will have this name at the cell. Throws InputError (use) if the name
// does not fit the wire (is_portable_name).
JobTicket job_ticket(const ReadJob& job, const std::string& file_name);

}  // namespace qchopper
