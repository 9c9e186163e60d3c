// Where the keys of this user lie, and what signs and checks here.
//
// Keys lie in the folder "keys" of the user's state folder (state_folder.h): NAME.key, NAME.pub, and the list of
// trusted keys, trusted.json. A private key inside of a project is refused: projects are copied and sent
// (tests/app/cli/keys_test.py).

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/dispatch_jobs.h"
#include "devices/keys/private_key_file.h"
#include "devices/keys/trusted_keys.h"
#include "sim/cell/cell_state.h"

namespace qchopper {

std::filesystem::path keys_folder();
// The list of this user, or the one that is named.
std::filesystem::path trusted_keys_file(const std::optional<std::filesystem::path>& named);

// A path if it contains a slash, else the name of a key in keys_folder(), whose name ends in .key there.
std::filesystem::path private_key_path(const std::string& key);

// Throws InputError (config) if a folder around the file is a project.
void refuse_in_project(const std::filesystem::path& file);
// Throws what refuse_in_project and read_private_key throw.
PrivateKeyFile read_own_key(const std::string& key);

// Why tickets for this cell must not be signed by the key, or not without one: a sentence without a full stop, by the
// policy of the cell file. Nothing: they may.
std::optional<Sentence> why_not_signed_by(const std::optional<Ed25519PrivateKey>& key, const Cell& cell,
                                          const TrustedKeys& trusted);

// The list as a simulated cell asks for it; read again each time. A list that cannot be read trusts no key, and is
// reported.
std::function<std::vector<CellKey>()> cell_keys(const std::filesystem::path& list,
                                                std::function<void(const std::string&)> report);

// That the clock of the cell and of this computer differ by more than five minutes, as a sentence; empty: they do not,
// or the cell has none.
std::string clock_difference(std::uint64_t cell_ms, std::uint64_t here_ms);

struct SignedJob {
    std::filesystem::path job;
    std::filesystem::path signature;
};
// Writes the signature file beside each job of a project, or beside one job file. Throws what jobs_of, read_job,
// parse_job and write_file throw.
std::vector<SignedJob> sign_jobs(const std::filesystem::path& input, const Ed25519PrivateKey& key,
                                 const ProjectContext& context);

struct CheckedSignature {
    std::filesystem::path job;
    std::string fault;  // empty: it is signed for its cell by a trusted key
};
// Of job files, for the cell that each names, or for `cell_id`. Throws what read_job and parse_job throw.
std::vector<CheckedSignature> check_signatures(const std::vector<std::filesystem::path>& jobs,
                                               const std::optional<std::uint16_t>& cell_id, const TrustedKeys& trusted);

}  // namespace qchopper
