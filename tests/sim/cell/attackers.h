// Hostile clients of a Modbus server, for tests and for bench/link: one thread drives many sockets as fast as it can.

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "base/files/file.h"

namespace qchopper::rig {

enum class AttackKind {
    slow_senders,       // a byte of a request each 0.1 s
    garbage,            // random bytes
    wrong_headers,      // requests with a wrong length or protocol id
    pipelining,         // right requests to read, one behind the other without waiting for answers
    never_reading,      // the same, and no answer is read
    idle,               // connections on which nothing is sent
    connect_and_reset,  // connections that are reset at once
    garbage_writes      // right requests that write random registers into every block
};

struct AttackName {
    AttackKind kind;
    const char* name;
};
constexpr std::array<AttackName, 8> all_attacks = {{
    {AttackKind::slow_senders, "slow senders"},
    {AttackKind::garbage, "garbage"},
    {AttackKind::wrong_headers, "wrong headers"},
    {AttackKind::pipelining, "pipelining"},
    {AttackKind::never_reading, "never reading"},
    {AttackKind::idle, "idle"},
    {AttackKind::connect_and_reset, "connect and reset"},
    {AttackKind::garbage_writes, "writes of garbage"},
}};

// An attacker that is disconnected connects again at once.
class Attackers {
 public:
    // `count` of them, each from an address of its own, 127.0.0.2 and up; or all from 127.0.0.1.
    Attackers(AttackKind kind, std::uint16_t port, int count, bool from_one_address = false);
    ~Attackers();
    Attackers(const Attackers&) = delete;
    Attackers& operator=(const Attackers&) = delete;

    std::uint64_t connections() const { return connections_; }  // opened so far
    std::uint64_t bytes() const { return bytes_; }              // sent so far

 private:
    struct Attacker {
        std::string address;
        int fd = -1;
        Bytes pending;  // a request that is sent in part
        double next_s = 0;
    };
    void run();
    bool step(Attacker& one);  // false: nothing could be done
    bool open(Attacker& one);
    void drop(Attacker& one);
    bool send_some(Attacker& one, std::size_t most);
    Bytes next_bytes();

    AttackKind kind_;
    std::uint16_t port_;
    std::vector<Attacker> attackers_;
    std::mt19937 random_{20260101};
    std::atomic<std::uint64_t> connections_ = 0;
    std::atomic<std::uint64_t> bytes_ = 0;
    std::atomic<bool> ends_ = false;
    std::thread thread_;
};

}  // namespace qchopper::rig
