// Job ids and a ticket that the simulated cell accepts, shared by its tests and its fuzzer.

#pragma once

#include "devices/wire/blocks.h"
#include "devices/wire/codes.h"

namespace qchopper::bench {

constexpr Uuid job_a{0xA, 1, 2, 3};
constexpr Uuid any_job{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

inline Sha256 good_digest() {
    Sha256 digest{};
    digest.bytes.fill(0x5A);
    return digest;
}

// Of 100 s, stored as piece-1.qjob.
inline WireTicket good_ticket(const Uuid& id = job_a) {
    WireTicket ticket;
    ticket.job_id = id;
    ticket.file_sha256 = good_digest();
    ticket.file_size = 1000;
    ticket.file_name = "piece-1.qjob";
    ticket.box_min = {-1000, -1000, 0};
    ticket.box_max = {1000, 1000, 2000};
    ticket.stock = {3000, 3000, 3000};
    ticket.tool_no = 3;
    ticket.tool_diameter_um = 12000;
    ticket.estimated_time_s = 100;
    ticket.piece_no = 1;
    ticket.piece_count = 1;
    ticket.cell_id = any_cell_id;
    ticket.made_for = 1;
    return ticket;
}

}  // namespace qchopper::bench
