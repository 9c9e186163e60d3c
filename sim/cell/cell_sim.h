// A simulated cell: the machine of machine.h behind a Modbus TCP server, with a drop folder and a store.
//
// Bit 9 of FLAGS, "simulated", is always set. Used by `qchopper cell-sim`, a program of its own, and inside
// `qchopper dry-run`. start() and stop() are to be called from one thread; status() may be called from any.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devices/wire/codec.h"
#include "sim/cell/link/modbus_listener.h"
#include "sim/cell/machine.h"
#include "sim/cell/script.h"

namespace qchopper {

struct CellSimOptions : ListenAt {
    std::filesystem::path drop_folder;   // where job files arrive; empty: only chunks
    std::filesystem::path store_folder;  // of a memory that outlives the program; empty: a temporary one
    std::uint64_t max_store_bytes = std::uint64_t{8} << 30;  // of all copies of job files together
    double peer_rate =
        0;              // requests per second of the clients at one address without the lease; 0: as the server has it
    CellLimits limits;  // cell id, consent, speed > 0, reach, stock, tools: see cell_state.h
    // The keys whose signatures it takes, as they are now; called from the cell's threads. Empty: it has no list.
    std::function<std::vector<CellKey>()> trusted_keys;
    // Reads the program of a job file that has come; it is then executed. Empty: jobs go on by their estimated time.
    ProgramReader read_program;
    // Asks a person (Consent::ask): true is consent. Called in a thread of its own, for as long as it takes; it may
    // outlive the cell. Without it and on_question nobody consents.
    std::function<bool(const std::string& question)> ask;
    // Shows a question that perform() will answer. Called from the cell's threads.
    std::function<void(const std::string& question)> on_question;
    std::function<void(const std::string& line)> on_message;  // a line for a log; called from the cell's threads
};

// The job that was started last, whatever became of it.
struct CarvedJob {
    std::filesystem::path file;  // in the store
    double run_s = 0;            // of its program, so far
};

class CellSim {
 public:
    explicit CellSim(CellSimOptions options);
    ~CellSim();  // stops
    CellSim(const CellSim&) = delete;
    CellSim& operator=(const CellSim&) = delete;

    // Throws InputError: address in use or not allowed, drop folder missing, speed not above 0, store unreadable or
    // held by another program. A second call has no effect.
    void start();
    std::uint16_t port() const;  // the one in use; 0 while the cell does not run
    void stop();                 // a second call has no effect

    Status status() const;  // STATUS at this moment
    // What has carved the block on the table. Nothing where no job was started, and after stop().
    std::optional<CarvedJob> carved_job() const;

    // The rest may be called from any thread while the cell runs. A cell that lost its power by a fault is on again one
    // second of its clock later.
    // A line of a script that does not wait. False: an answer for which no question is there yet.
    bool perform(const ScriptLine& line);
    bool holds(std::size_t choice) const;  // see panel.h
    bool is_clock_virtual() const;
    std::int64_t steady_ms() const;
    // Precondition: the clock is virtual. Ends early once `is_stopped` says so; it may be empty.
    void pass(double seconds, const std::function<bool()>& is_stopped = {});

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace qchopper
