// A cell that is not there: the machine of machine.h behind a Modbus TCP server, with a drop folder and a store.
//
// Bit 9 of FLAGS says "simulated" and nothing can switch it off. Used as a program of its own (`qchopper cell-sim`)
// and inside `qchopper dry-run`.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "devices/codec.h"
#include "sim/machine.h"

namespace qchopper {

struct CellSimOptions {
    std::string listen_host = "127.0.0.1";  // another than loopback needs an allow-list
    std::uint16_t port = 0;                 // 0: a free one, see CellSim::port()
    std::vector<std::string> allow;         // numeric addresses of peers
    std::filesystem::path drop_folder;      // where job files arrive; empty: only chunks
    std::filesystem::path store_folder;  // memory that outlives the program; empty: none (a folder of its own, removed)
    std::uint64_t most_store_bytes = std::uint64_t{8} << 30;  // of all copies of job files together
    CellLimits limits;  // cell id, consent, speed, reach, stock, tools: see machine.h
    // Asks a person (Consent::ask): true is consent. Runs in a thread of its own and may take for ever.
    std::function<bool(const std::string& question)> ask;
    std::function<void(const std::string& line)> on_message;  // what happens, for a log; called from the cell's threads
};

class CellSim {
 public:
    explicit CellSim(CellSimOptions options);
    ~CellSim();  // stops
    CellSim(const CellSim&) = delete;
    CellSim& operator=(const CellSim&) = delete;

    // Throws InputError: address in use or not allowed, folder missing, store unreadable or held by another program.
    void start();
    std::uint16_t port() const;  // the real one, after start()
    void stop();                 // safe to call twice

    Status status() const;  // what a client would read now

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace qchopper
