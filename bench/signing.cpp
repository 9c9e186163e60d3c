// What signatures cost: to sign and to check a job of 3 MB, beside hashing it.
//
//   bench_signing [RUNS]
//
// Hashing is one SHA-256 over the job. To sign and check the job is that, Ed25519 over its signature file, and the
// check of it; for the ticket likewise. By turns, CPU time of this thread, the least of RUNS (200).

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "base/files/file.h"
#include "bench/clock.h"
#include "devices/keys/job_signature.h"
#include "devices/wire/codec.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper::bench {
namespace {

constexpr std::size_t job_bytes = 3'000'000;
constexpr std::uint64_t now_ms = 1'700'000'000'000;

Bytes make_job() {
    Bytes job(job_bytes);
    std::uint32_t state = 1;
    for (std::uint8_t& byte : job) {
        state = state * 1664525U + 1013904223U;
        byte = static_cast<std::uint8_t>(state >> 24U);
    }
    return job;
}

struct Rig {
    Bytes job = make_job();
    Ed25519PrivateKey key = Ed25519PrivateKey::make();
    TrustedKeys trusted;
};

// Whether the signature file is right.
bool sign_and_check_job(const Rig& rig) {
    const Sha256 digest = sha256(rig.job);
    return fault_of(sign_job(rig.key, digest, 7, now_ms), digest, 7, rig.trusted, now_ms).empty();
}

// Whether the signature of the ticket is right.
bool sign_and_check_ticket(const Rig& rig) {
    WireTicket ticket;
    ticket.file_sha256 = sha256(rig.job);
    ticket.key_id = key_id_of(rig.key.public_key());
    const Registers block = encode(ticket);
    const Registers signature = sign_ticket(rig.key, block);
    return is_signed_by(rig.key.public_key(), signed_bytes(block), decode<TicketSignature>(signature).value.signature);
}

int run(int runs) {
    Rig rig;
    trust(rig.trusted, "bench", rig.key.public_key(), now_ms);
    double hashing_s = 1e9;
    double job_s = 1e9;
    double ticket_s = 1e9;
    bool is_right = true;
    for (int i = 0; i < runs; ++i) {
        hashing_s = std::min(hashing_s, best_of(1, cpu_s, [&] { return sha256(rig.job); }));
        job_s = std::min(job_s, best_of(1, cpu_s, [&] { return is_right &= sign_and_check_job(rig); }));
        ticket_s = std::min(ticket_s, best_of(1, cpu_s, [&] { return is_right &= sign_and_check_ticket(rig); }));
    }
    std::printf("hashing %zu bytes: %.3f ms\n", job_bytes, 1e3 * hashing_s);
    std::printf("with the signature file, signed and checked: %.3f ms, %.3f times that (at most 1.2)\n", 1e3 * job_s,
                job_s / hashing_s);
    std::printf("with the ticket, signed and checked: %.3f ms, %.3f times that (at most 1.2)\n", 1e3 * ticket_s,
                ticket_s / hashing_s);
    std::printf("with both: %.3f times that\n", (job_s + ticket_s - hashing_s) / hashing_s);
    return is_right ? 0 : 1;
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    const int runs = argc > 1 ? std::atoi(argv[1]) : 200;
    return runs > 0 ? qchopper::bench::run(runs) : 64;
}
