// O(bytes of the jobs) to sign them, O(keys) to check a signature.

#include "app/dispatch/signing.h"

#include "app/dispatch/proven_jobs.h"
#include "app/dispatch/state_folder.h"
#include "app/jobs/ordered_job.h"
#include "app/store/project_folder.h"
#include "base/error.h"
#include "cam/job/read_job.h"
#include "devices/keys/job_signature.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

SignedJob signed_beside(const fs::path& job, const JobSignature& signature) {
    write_signature(job, signature);
    return {job, signature_file(job)};
}

}  // namespace

fs::path keys_folder() {
    return state_folder() / "keys";
}

fs::path trusted_keys_file(const std::optional<fs::path>& named) {
    return named ? *named : keys_folder() / "trusted.json";
}

fs::path private_key_path(const std::string& key) {
    return key.find('/') != std::string::npos ? fs::path(key) : keys_folder() / (key + ".key");
}

void refuse_in_project(const fs::path& file) {
    std::error_code error;
    fs::path folder = fs::weakly_canonical(fs::absolute(file), error).parent_path();
    for (; !folder.empty(); folder = folder.parent_path()) {
        if (fs::exists(folder / "project.json", error)) {
            throw InputError(InputFault::config,
                             "the private key " + file.string() + " lies in the project " + folder.string() +
                                 ", which is copied and sent",
                             "keep keys outside of projects: qchopper keys make NAME");
        }
        if (folder == folder.root_path()) return;
    }
}

PrivateKeyFile read_own_key(const std::string& key) {
    const fs::path path = private_key_path(key);
    refuse_in_project(path);
    return read_private_key(path);
}

std::optional<Sentence> why_not_signed_by(const std::optional<Ed25519PrivateKey>& key, const Cell& cell,
                                          const TrustedKeys& trusted) {
    if (!key) {
        if (!cell.require_signature) return std::nullopt;
        return Sentence::with_key("sign_ticket", {},
                                  "the cell requires signed tickets; name the private key that signs them");
    }
    const std::string id = key_id_text(key_id_of(key->public_key()));
    const TrustedKey* const known = find_key(trusted, key_id_of(key->public_key()));
    if (known != nullptr && known->revoked_ms) {
        return Sentence("the key " + id + " of " + known->name + ", which is to sign the tickets, is revoked");
    }
    if (cell.require_signature && (known == nullptr || known->key != key->public_key())) {
        return Sentence("the cell requires signed tickets, and the key " + id +
                        ", which is to sign them, is not trusted here");
    }
    return std::nullopt;
}

std::function<std::vector<CellKey>()> cell_keys(const fs::path& list, std::function<void(const std::string&)> report) {
    return [list, report = std::move(report)] {
        std::vector<CellKey> keys;
        try {
            for (const TrustedKey& key : read_trusted_keys(list).keys) {
                keys.push_back({key.key, key.revoked_ms.has_value()});
            }
        } catch (const InputError& error) {
            if (report) report(std::string("no key is trusted: ") + error.what());
        }
        return keys;
    };
}

std::string clock_difference(std::uint64_t cell_ms, std::uint64_t here_ms) {
    const std::uint64_t apart_ms = cell_ms > here_ms ? cell_ms - here_ms : here_ms - cell_ms;
    if (cell_ms == 0 || apart_ms <= most_ahead_ms) return {};
    return "the clock of the cell is " + std::to_string(apart_ms / 60'000) + " minutes " +
           (cell_ms > here_ms ? "ahead of" : "behind") +
           " that of this computer: set the one that is wrong, because signatures and the journal state times";
}

std::vector<SignedJob> sign_jobs(const fs::path& input, const Ed25519PrivateKey& key, const ProjectContext& context) {
    if (!is_project_folder(input)) {
        const ReadJob job = parse_job(read_job(input), input.string());
        return {signed_beside(input, sign_job(key, job.file_sha256, job.cell_id, unix_ms()))};
    }
    const ProjectJobs ordered = jobs_of(without_slash(input), std::nullopt, context);
    for (const std::string& sentence : unproven_jobs(ordered, true)) context.warn(sentence);
    std::vector<SignedJob> all;
    for (const PieceJob& job : ordered.jobs) {
        const fs::path file = ordered.folder / "jobs" / job_file_name(job.piece, job.part);
        all.push_back(signed_beside(file, sign_job(key, job.ticket.file_sha256, ordered.cell.id, unix_ms())));
    }
    return all;
}

std::vector<CheckedSignature> check_signatures(const std::vector<fs::path>& jobs,
                                               const std::optional<std::uint16_t>& cell_id,
                                               const TrustedKeys& trusted) {
    std::vector<CheckedSignature> all;
    for (const fs::path& file : jobs) {
        const ReadJob job = parse_job(read_job(file), file.string());
        all.push_back({file, fault_of(read_signature(file), job.file_sha256, cell_id.value_or(job.cell_id), true,
                                      trusted, unix_ms())});
    }
    return all;
}

}  // namespace qchopper
