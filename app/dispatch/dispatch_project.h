// Hands the jobs of a project to a cell, after all that speaks against it was looked at.
//
// The checks in their order; with the first that is not passed nothing is sent (tests/app/cli/dispatch_jobs_test.cpp):
//   0. The job that is named by its bytes is one of the project. A restart is made of a proven job, and proven.
//   1. No job has a negative verdict, or one of other bytes (proven_jobs.h).
//      No signature of a job is wrong, and none is missing where the cell file requires it; the key that signs the
//      tickets is trusted then, and never a revoked one (signing.h).
//   2. No job leaves more surface out of reach than its limit, unless that is accepted.
//   3. Every piece is held, unless that is accepted, beforehand or by the operator who is asked.
//   4. An address is known, and a drop folder that is there, unless files are sent in chunks.
//   5. STATUS of the cell is read: a real cell is never taken for a simulated one, and is what the request expects.
//   6. At a real cell: the cell file states everything for certain (cell_check.h), every job has a program and a
//   positive
//      verdict, and the operator confirms, beforehand or when asked.
// Jobs without a program or a verdict go to a simulated cell, with a warning.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"
#include "app/dispatch/operator.h"
#include "app/dispatch/restart_dispatch.h"
#include "app/store/project_context.h"
#include "base/sha256.h"

namespace qchopper {

// context.saved() of an error before any job of this dispatch could start begins with it.
constexpr const char* nothing_started = "The project is unchanged, and this dispatch started no job.";

struct DispatchRequest {
    std::filesystem::path project;
    std::optional<std::string> piece;           // nothing: all
    std::optional<Sha256> job;                  // only the job file of these bytes
    std::optional<std::uint32_t> from_chunk;    // a restart of the named piece from there (restart_dispatch.h)
    std::string program_version;                // for the verdict on a restart
    std::optional<bool> expects_simulated;      // whether the cell has to be; nothing: any
    std::optional<std::string> to;              // HOST:PORT; nothing: as the cell file says
    std::optional<std::filesystem::path> drop;  // drop folder of the cell; nothing: as the cell file says
    bool chunks = false;                        // files are sent over the link, without a drop folder
    bool is_confirmed = false;                  // a real cell may be set in motion without a question
    bool accept_unreachable = false;
    bool accept_workholding = false;
    bool again = false;     // also a file that the cell has milled before
    bool rehearse = false;  // REHEARSE before PREPARE
    std::uint32_t takeover_code = 0;
    std::optional<Ed25519PrivateKey> signing_key;  // signs the tickets; nothing: they are not signed
    std::optional<std::filesystem::path> trusted;  // list of trusted keys; nothing: that of the user
};

struct DispatchAnswer {
    std::vector<DispatchedJob> handed;
    std::size_t wanted = 0;         // jobs to be handed over
    bool is_simulated = false;      // the cell; false if none was asked
    std::vector<Sentence> refused;  // why no job was sent; empty: they were
    std::optional<MadeRestart> restart;
};

// What speaks against a job is an answer. Throws what jobs_of, put_restart_in_place, dispatch_jobs and `person` throw;
// InputError: (use) a restart of no named piece, no address or drop folder is known, (create) the drop folder is not
// there, (config) the cell file is not certain; DeviceError: the cell does not answer. context.saved() says what an
// earlier dispatch left open, where the cell could not be asked.
DispatchAnswer dispatch_project(const DispatchRequest& request, const Operator& person, const ProjectContext& context);

}  // namespace qchopper
