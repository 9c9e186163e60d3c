// One simulated cell, PCs that take turns on one virtual clock, and the judge of what really started.
//
// PCs are threads of which one runs at a time: the one whose time comes first. Between two of their steps the cell
// lives on: time passes, bytes arrive, power fails. The judge counts the jobs that the cell's memory shows as started,
// and keeps that count when the cell loses its memory. Times in seconds since the beginning.

#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "devices/wire/codec.h"
#include "sim/cell/machine.h"
#include "tests/sim/cell/fault_proxy.h"

namespace qchopper::schedules {

using rig::FaultProxy;
using rig::Piece;
using rig::Way;

class World {
 public:
    World(std::uint64_t seed, std::filesystem::path drop);

    // Runs each function in a thread of its own, in turns, until all have ended.
    void run(const std::vector<std::function<void()>>& pcs);
    double now_s() const { return static_cast<double>(now_us_) / 1e6; }
    void sleep(double seconds);  // of the PC that calls
    std::uint64_t random() { return next_random_(); }
    bool happens(int per_thousand) { return static_cast<int>(random() % 1000) < per_thousand; }
    void at(double when_s, std::function<void()> event);
    void say(const std::string& line);

    // Connections of the PCs.
    int connect();  // -1: the cell has no power
    void send(int connection, const Bytes& frame);
    void close(int connection);
    Bytes& inbox(int connection) { return links_[connection].inbox; }
    bool is_closed(int connection) { return links_[connection].is_closed; }

    void cut_power(PowerCut::Store store);
    void cut_power_at_event(std::uint64_t events, PowerCut::Store store);
    void end_faults();
    bool store_was_lost() const { return store_was_lost_; }

    // The judge.
    int starts_of(const Uuid& job) const;
    int starts_of(const Sha256& file) const;
    int max_starts_of_a_job() const;
    bool count_is_right() const { return count_is_right_; }  // STARTS_TOTAL always was the number of started jobs

    // From now on the cell takes no job that this key has not signed.
    void require_signature(const Ed25519PublicKey& key);

    CellState& cell() { return cell_; }
    FaultProxy proxy;
    std::vector<std::string> log;
    std::function<void(const std::string&)> on_line;

 private:
    struct Link {
        Bytes inbox;    // bytes for the PC
        Bytes at_cell;  // a frame that is not complete
        bool is_closed = false;
        bool is_cut = false;  // the cell does not know it any more
    };
    std::uint64_t next_random_();
    std::vector<CellKey> keys_;  // empty: no signature is required
    CellTime cell_time() const;
    CellHooks hooks();
    void advance(std::int64_t until_us);
    void step();
    void after_step();
    void power_on_again();
    CellMemory older_copy();
    void check_file();
    void deliver(int connection, Way way, const std::vector<Piece>& pieces);
    void arrive_at_cell(int connection, const Bytes& bytes);
    void count_starts();
    void pass_turn();

    std::uint64_t random_;
    std::filesystem::path drop_;
    std::int64_t now_us_ = 0;
    std::multimap<std::int64_t, std::function<void()>> events_;
    std::map<int, Link> links_;
    int connections_ = 0;
    bool is_off_ = false;
    CellState cell_;
    CellMemory stored_;
    std::vector<CellMemory> copies_;  // all that was ever stored, since the store was lost last
    SaveMarks marks_;
    bool has_marks_ = true;
    std::uint64_t old_copies_ = 1;  // generator of which copy comes back
    std::uint64_t checked_ = 0;
    bool store_was_lost_ = false;

    std::set<Uuid> counted_;  // in the memory that the cell has now
    std::map<Uuid, int> starts_;
    std::map<std::string, int> file_starts_;
    bool count_is_right_ = true;

    std::mutex mutex_;
    std::condition_variable turn_changed_;
    std::vector<std::int64_t> wake_;
    std::size_t turn_ = 0;
};

}  // namespace qchopper::schedules
