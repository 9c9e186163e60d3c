// How a job is handed to a cell: the choices of the caller and the time limits of the hand-off.
//
// Times in seconds.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cam/job/ticket.h"
#include "devices/journal/journal_event.h"
#include "devices/wire/codes.h"
#include "devices/wire/ed25519.h"

namespace qchopper {

struct HandOffTimings {
    double poll_s = 0.5;          // between two reads of STATUS
    double heartbeat_s = 0.5;     // between two heartbeats; the cell's watchdog expires at 2.5
    double answer_s = 10;         // for a command without consent (VERIFY and REHEARSE: 10 times this)
    double resend_s = 1;          // until a command without acknowledgement is sent again
    double consent_s = 600;       // for the operator at the cell
    double link_patience_s = 30;  // for a lost link, and for a frozen cell before the start
    double frozen_s = 2.5;        // without a change of the cell's heartbeat: the cell counts as frozen
    double leave_s = 2;           // from the request to stop to the end of the hand-off, whatever the cell does
};

// How a command to a cell ended.
enum class CommandEnd {
    done,     // the cell acknowledged it: OK, or ALREADY
    refused,  // by the cell, or here because the cell would refuse: no effect
    unknown   // sent, and no acknowledgement came: ask the cell
};

// What became of a command that another program asked a dispatcher to pass on.
struct RequestAnswer {
    CommandEnd end = CommandEnd::unknown;
    std::string why;  // one line; empty after `done`
    bool operator==(const RequestAnswer&) const = default;
};

// What the journal says of the memory of the cell, and of the last dispatcher that claimed it.
struct CellPast {
    std::optional<SeenStore> store;  // as the cell showed it last, or as it was accepted
    bool store_is_lost = false;      // and nobody has accepted the new one
    std::uint32_t epoch = 0;         // the highest one used in CLAIM
    std::uint32_t grant = 0;         // of the last CLAIM that was granted
    std::uint32_t owner = 0;         // of the last CLAIM
    std::uint32_t secret = 0;
    std::uint32_t seq = 0;  // the last CMD_SEQ of that owner
    bool operator==(const CellPast&) const = default;
};

// What is known of a job.
struct JobPast {
    bool is_stored = false;   // STORE may have arrived
    bool start_sent = false;  // START may have arrived
    bool is_started = false;
    std::uint32_t start_boots = 0;  // BOOT_COUNT before its START
    bool operator==(const JobPast&) const = default;
};

// The owner goes on while its lease may live; owner 0: draw a new one. The job is one that is taken up.
struct HandOffPast : CellPast, JobPast {};

// The time of a hand-off, in seconds from any moment; it never goes back. Empty: the clock of the computer.
struct HandOffClock {
    std::function<double()> now_s;
    std::function<void(double seconds)> sleep;  // both or none
};

struct DispatchOptions {
    std::uint16_t cell_id = 0xFFFF;     // any other cell is refused
    bool want_simulated = true;         // a cell whose FLAGS differ from this is refused
    std::filesystem::path drop_folder;  // where the cell fetches job files; empty: sent in chunks over the bus
    LinkLoss on_link_loss = LinkLoss::go_on;
    bool rehearse = false;             // REHEARSE before PREPARE
    bool stop_when_cancelled = false;  // a request to stop while the job runs also stops the machine
    HandOffTimings timings;
    bool again = false;               // also a file that the cell has milled before
    std::uint32_t takeover_code = 0;  // given at the cell's panel: ends the lease of another dispatcher
    std::string address;              // HOST:PORT for the commands that the operator is told to run; may be empty
    std::uint32_t owner_held = 0;     // OWNER_HELD of the first STATUS, if that was read before
    std::optional<Ed25519PrivateKey> signing_key;  // signs the ticket; empty: it is not signed
    std::optional<Uuid> job_id;                    // empty: a new random one
    HandOffPast past;
    HandOffClock clock;  // for tests that count time instead of waiting for it
    // Draws job id, owner and secret; empty: the operating system does. For tests that repeat a course of events.
    std::function<std::uint32_t()> random;
    // Keeps an event before the action that follows from it; if it throws, the action is not done. May be empty.
    std::function<void(const JournalEvent& event)> journal;
    // Asked for a command that another program wants to be passed to the cell, none if there is none; and told how it
    // ended. May be empty.
    std::function<CellCommand()> request;
    std::function<void(const RequestAnswer& answer)> answer_request;
    // Told the name of each point in the course of a dispatch, for tests that end the process there. May be empty.
    std::function<void(const std::string& point)> at_point;
};

}  // namespace qchopper
