// The job file of one piece: everything that the cell and the workshop need, in one ZIP named <piece>.qjob.
//
// Millimetres in setup coordinates. Same input, same bytes: no time and no random id goes in. What is read back is
// checked: schema, every size and SHA-256 (tests/cam/job/job_test.cpp). docs/job-folder.md holds the grammar.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "base/file.h"
#include "cam/cell/cell.h"
#include "cam/job/ticket.h"
#include "cam/setup/envelope.h"
#include "cam/setup/setup.h"
#include "segment/cut/piece.h"

namespace qchopper {

constexpr int job_schema_version = 1;

struct JobInput {
    Piece piece;
    std::uint16_t piece_no = 1;  // 1..piece_count
    std::uint16_t piece_count = 1;
    std::string program_version;  // "0.1.0"
    Uuid project_id{};
    Sha256 scan_sha256{};
    Cell cell;
    Setup setup;
    EnvelopeReport envelope;
    std::vector<std::string> warnings;  // of the project: "scaled by 0.5 on request"
};

// "<piece>.qjob". Throws InputError (use) if the name does not fit the wire (is_job_file_name).
std::string job_file_name(const std::string& piece);

// The whole file. Throws InputError (use) if a number does not fit the ticket.
Bytes job_file(const JobInput& input);

// The template that goes into the job file.
TicketTemplate ticket_template(const JobInput& input);

// The setup sheet: what a person at the cell has to do, as plain text.
std::string setup_sheet(const JobInput& input);

struct JobEntry {
    std::string name;
    std::uint64_t size = 0;
    Sha256 sha256{};
    bool operator==(const JobEntry&) const = default;
};

// A job file that was read and found whole.
struct ReadJob {
    std::string piece;
    std::uint16_t piece_no = 0;
    std::uint16_t piece_count = 0;
    std::string program_version;
    Uuid project_id{};
    Sha256 scan_sha256{};
    std::uint16_t cell_id = 0;
    Setup setup;                // as it was written
    std::string block_name;     // of the stock list
    std::vector<Bound> bounds;  // in piece coordinates
    EnvelopeReport envelope;
    std::uint64_t faces = 0;
    double volume_mm3 = 0;
    TicketTemplate ticket;
    std::vector<JobEntry> entries;       // every file but the manifest
    std::map<std::string, Bytes> files;  // all, the manifest too
    std::uint32_t file_size = 0;         // of the .qjob itself
    Sha256 file_sha256{};
};

// The bytes of a job file (job_limit). Throws InputError: missing if it cannot be read, mesh if it is too large.
Bytes read_job(const std::filesystem::path& path);

// Throws InputError (mesh) naming `source` if the bytes are not exactly what job_file writes for a job of this schema.
ReadJob parse_job(const Bytes& bytes, const std::string& source);

// The template of a job bound to its file, which will have this name at the cell. Throws InputError (use) if the wire
// cannot carry the name.
JobTicket job_ticket(const ReadJob& job, const std::string& file_name);

}  // namespace qchopper
