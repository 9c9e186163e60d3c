// The signature file beside a job: who answers for these bytes on this cell, before there is a ticket.
//
// NAME.signature.json beside NAME.qjob. Signed are the head "QCHOPPER-JOB-1", the SHA-256 of the job file (32 bytes),
// CELL_ID (2), KEY_ID (4) and the time in ms (8), high bytes first, so that nothing in the file can be changed
// (tests/devices/keys/job_signature_test.cpp). docs/developer/formats/signature.md holds the grammar.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/sha256.h"
#include "devices/keys/trusted_keys.h"
#include "devices/wire/ed25519.h"

namespace qchopper {

constexpr std::string_view job_signature_head = "QCHOPPER-JOB-1";
constexpr std::uint64_t most_ahead_ms = 300'000;  // by which a signature may be younger than now

struct JobSignature {
    Sha256 job_sha256;
    std::uint16_t cell_id = 0;
    std::uint32_t key_id = 0;
    std::uint64_t signed_ms = 0;  // since 1970 (UTC), by the clock of the signer
    Ed25519Signature signature;
    bool operator==(const JobSignature&) const = default;
};

JobSignature sign_job(const Ed25519PrivateKey& key, const Sha256& job_sha256, std::uint16_t cell_id,
                      std::uint64_t now_ms);

// Why the signature is not one over this job for this cell by a trusted key, as a clause: "it is signed by the key
// 0123abcd, which is not trusted". Empty: it is. A signature more than most_ahead_ms in the future shows a wrong clock.
std::string fault_of(const JobSignature& signature, const Sha256& job_sha256, std::uint16_t cell_id,
                     const TrustedKeys& trusted, std::uint64_t now_ms);

std::string to_json(const JobSignature& signature);

// jobs/B.signature.json for jobs/B.qjob.
std::filesystem::path signature_file(const std::filesystem::path& job);
// Throws what write_file throws.
void write_signature(const std::filesystem::path& job, const JobSignature& signature);

// The file beside a job, read once: nothing of both if there is none.
struct FoundSignature {
    std::optional<JobSignature> signature;
    std::string fault;  // why what is there is no signature; else empty
};
FoundSignature read_signature(const std::filesystem::path& job);

// fault_of for what was found. Without a signature file "it is not signed" if the cell requires a signature, else
// empty.
std::string fault_of(const FoundSignature& found, const Sha256& job_sha256, std::uint16_t cell_id,
                     bool require_signature, const TrustedKeys& trusted, std::uint64_t now_ms);

}  // namespace qchopper
