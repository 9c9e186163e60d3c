#include "tests/schedules/world.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <thread>

#include "base/error.h"
#include "base/sha256.h"
#include "sim/cell/modbus_pdu.h"
#include "sim/cell/panel.h"
#include "sim/cell/random.h"

namespace qchopper::schedules {
namespace {

constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t cell_step_us = 50000;
constexpr std::int64_t off_us = 1000000;
constexpr double world_end_s = 4000;  // a dispatcher that still runs then never ends
constexpr double flight_s = 0.0005;   // of a frame, one way

thread_local std::size_t self = 0;

std::int64_t to_us(double seconds) {
    return static_cast<std::int64_t>(1e6 * seconds) + 1;
}

Bytes answer_frame(const Bytes& request, const Bytes& pdu) {
    const std::size_t length = pdu.size() + 1;
    Bytes frame(7 + pdu.size());
    std::copy_n(request.begin(), 7, frame.begin());
    frame[4] = static_cast<std::uint8_t>(length >> 8U);
    frame[5] = static_cast<std::uint8_t>(length & 0xFFU);
    std::copy(pdu.begin(), pdu.end(), frame.begin() + 7);
    return frame;
}

}  // namespace

World::World(std::uint64_t seed, std::filesystem::path drop)
    : proxy(seed ^ 0x5A5A5A5AU), random_(seed), drop_(std::move(drop)) {
    CellLimits limits;
    limits.speed = 10;
    limits.takeover_code = 4711;
    limits.acting_ms = 20;
    std::uint64_t other_random = seed ^ 0xC3C3C3C3U;
    has_marks_ = next_random(other_random) % 4 != 0;
    old_copies_ = other_random;
    cell_ = boot(limits, {}, next_random_(), cell_time(), hooks());
    cell_.store_free_kib = 1000000;
}

namespace {

// No START is missing from the copy that came under an epoch which the copy knows. One from between CLAIM and START is
// found by a cell with marks only, and not if they come back as well.
bool is_outside_of_starts(const CellMemory& copy, const CellMemory& now) {
    return std::all_of(now.jobs.begin(), now.jobs.end(), [&](const auto& job) {
        const bool is_missing = job.second.starts > 0 && !copy.jobs.contains(job.first);
        return !is_missing || job.second.start_epoch > copy.epoch_held;
    });
}

}  // namespace

// With marks: half of the time the store alone, which may then be any copy. Without: the restart shows.
CellMemory World::older_copy() {
    const bool all = has_marks_ && next_random(old_copies_) % 2 == 0;
    std::vector<CellMemory> fit;
    for (const CellMemory& copy : copies_) {
        // A write that had not come to its end has moved nothing, and the copy before it counts as the last one.
        if (copy.mark != stored_.mark && copy.mark != marks_.last && (!all || is_outside_of_starts(copy, stored_)))
            fit.push_back(copy);
    }
    if (fit.empty()) return stored_;
    const CellMemory copy = fit[next_random(old_copies_) % fit.size()];
    if (all) marks_ = {copy.mark, copy.mark};
    say(std::string(all ? "all that it remembers" : "the store") + " is the copy with EPOCH_HELD " +
        std::to_string(copy.epoch_held) + ", BOOT_COUNT " + std::to_string(copy.boot_count));
    return copy;
}

std::uint64_t World::next_random_() {
    return next_random(random_);
}

CellTime World::cell_time() const {
    return {100000 + now_us_ / 1000, 1700000000000U + static_cast<std::uint64_t>(now_us_ / 1000)};
}

void World::require_signature(const Ed25519PublicKey& key) {
    keys_ = {{key, false}};
    cell_.limits.require_signature = true;
}

CellHooks World::hooks() {
    CellHooks hooks;
    hooks.save = [this](const CellMemory& memory) {
        stored_ = memory;
        copies_.push_back(memory);
        return true;
    };
    if (has_marks_) {
        hooks.read_marks = [this] { return marks_; };
        hooks.write_marks = [this](const SaveMarks& marks) {
            marks_ = marks;
            return true;
        };
    }
    if (!keys_.empty()) hooks.trusted_keys = [this] { return keys_; };
    hooks.log = [this](const std::string& line) { say("cell: " + line); };
    return hooks;
}

void World::say(const std::string& line) {
    log.push_back(std::to_string(now_us_ / 1000) + " ms  " + line);
    if (on_line) on_line(log.back());
}

void World::at(double when_s, std::function<void()> event) {
    events_.emplace(std::max(to_us(when_s), now_us_), std::move(event));
}

void World::run(const std::vector<std::function<void()>>& pcs) {
    wake_.assign(pcs.size(), now_us_);
    turn_ = 0;
    std::vector<std::thread> threads;
    for (std::size_t i = 0; i < pcs.size(); ++i) {
        threads.emplace_back([this, i, &pcs] {
            self = i;
            std::unique_lock lock(mutex_);
            turn_changed_.wait(lock, [&] { return turn_ == i; });
            lock.unlock();
            pcs[i]();
            lock.lock();
            wake_[i] = never;
            pass_turn();
        });
    }
    for (std::thread& thread : threads) thread.join();
}

// To the PC that wakes first; the cell lives until then.
void World::pass_turn() {
    const auto first = std::min_element(wake_.begin(), wake_.end());
    if (*first != never) advance(*first);
    const auto next = static_cast<std::size_t>(first - wake_.begin());
    if (next == turn_) return;
    turn_ = next;
    turn_changed_.notify_all();
}

void World::sleep(double seconds) {
    if (now_s() > world_end_s) throw std::runtime_error("the world has ended");
    std::unique_lock lock(mutex_);
    wake_[self] = now_us_ + to_us(std::max(seconds, 0.0));
    pass_turn();
    turn_changed_.wait(lock, [&] { return turn_ == self; });
}

void World::advance(std::int64_t until_us) {
    while (now_us_ < until_us) {
        std::int64_t next = std::min(until_us, now_us_ + cell_step_us);
        if (!events_.empty()) next = std::min(next, std::max(now_us_, events_.begin()->first));
        now_us_ = next;
        step();
        while (!events_.empty() && events_.begin()->first <= now_us_) {
            const std::function<void()> event = std::move(events_.begin()->second);
            events_.erase(events_.begin());
            event();
            after_step();
        }
    }
}

void World::step() {
    if (is_off_) return;
    pass_time(cell_, cell_time(), hooks());
    check_file();
    after_step();
}

void World::after_step() {
    count_starts();
    if (cell_.power.lost && !is_off_) cut_power(cell_.power.store);
}

void World::check_file() {
    if (!cell_.pending || cell_.pending->waits != Pending::Waits::file || cell_.pending->number == checked_) return;
    checked_ = cell_.pending->number;
    const WireTicket& ticket = cell_.job.ticket;
    FileCheck check;
    Bytes bytes = cell_.job.chunks;
    if (ticket.transfer == Transfer::drop_folder) {
        std::error_code error;
        if (std::filesystem::is_regular_file(drop_ / ticket.file_name, error)) {
            bytes = read_file(drop_ / ticket.file_name, {1U << 20U, InputFault::io});
        }
    }
    if (!bytes.empty()) check = {FileCheck::End::ok, bytes.size(), sha256(bytes)};
    file_checked(cell_, cell_.pending->number, check, cell_time(), hooks());
}

int World::connect() {
    if (is_off_) return -1;
    links_[++connections_];
    return connections_;
}

void World::send(int connection, const Bytes& frame) {
    deliver(connection, Way::to_cell, proxy.pass(connection, Way::to_cell, frame));
}

void World::close(int connection) {
    deliver(connection, Way::to_cell, proxy.close(connection));
    links_[connection].is_closed = true;  // what is on its way to the cell still arrives
}

void World::deliver(int connection, Way way, const std::vector<Piece>& pieces) {
    for (const Piece& piece : pieces) {
        const int link = piece.elsewhere ? ++connections_ : connection;
        at(now_s() + flight_s + piece.after_s, [this, link, way, piece] {
            Link& to = links_[link];
            if (piece.resets) to.is_closed = to.is_cut = true;
            if (way == Way::to_cell) return arrive_at_cell(link, piece.bytes);
            if (!to.is_closed) to.inbox.insert(to.inbox.end(), piece.bytes.begin(), piece.bytes.end());
        });
    }
}

// The server of the cell: frames by the length in their header.
void World::arrive_at_cell(int connection, const Bytes& bytes) {
    Link& link = links_[connection];
    if (is_off_ || link.is_cut) return;
    link.at_cell.insert(link.at_cell.end(), bytes.begin(), bytes.end());
    while (link.at_cell.size() >= 7) {
        const std::size_t length = std::size_t{link.at_cell[4]} << 8U | link.at_cell[5];
        if (link.at_cell[2] != 0 || link.at_cell[3] != 0 || length < 2 || length > 254) {
            link.is_closed = link.is_cut = true;
            return;
        }
        if (link.at_cell.size() < 6 + length) return;
        const Bytes frame(link.at_cell.begin(), link.at_cell.begin() + static_cast<std::ptrdiff_t>(6 + length));
        link.at_cell.erase(link.at_cell.begin(), link.at_cell.begin() + static_cast<std::ptrdiff_t>(6 + length));
        const Bytes pdu = answer_pdu(frame[6], {frame.data() + 7, frame.size() - 7}, cell_, cell_time(), hooks());
        after_step();
        if (is_off_) return;
        deliver(connection, Way::to_pc, proxy.pass(connection, Way::to_pc, answer_frame(frame, pdu)));
    }
}

void World::cut_power(PowerCut::Store store) {
    if (is_off_) return;
    constexpr const char* ends[] = {"the store stays", "the store is lost", "an older store is back", ""};
    say(std::string("POWER CUT, ") + ends[static_cast<std::size_t>(store)]);
    is_off_ = true;
    cell_.power = {};
    for (auto& [number, link] : links_) link.is_closed = link.is_cut = true;
    if (store != PowerCut::Store::stays) {
        store_was_lost_ = true;
        if (store == PowerCut::Store::lost) copies_.clear();
        stored_ = store == PowerCut::Store::lost ? CellMemory{} : older_copy();
        counted_.clear();
        for (const auto& [id, record] : stored_.jobs) {
            if (record.starts > 0) counted_.insert(id);
        }
    }
    events_.emplace(now_us_ + off_us, [this] { power_on_again(); });
}

void World::cut_power_at_event(std::uint64_t events, PowerCut::Store store) {
    if (!is_off_) cell_.power = {cell_.steps + events, store, false};
}

void World::power_on_again() {
    is_off_ = false;
    cell_ = boot(cell_.limits, stored_, next_random_(), cell_time(), hooks());
    cell_.store_free_kib = 1000000;
    checked_ = 0;
    say("power is on");
}

void World::end_faults() {
    say("no more faults");
    proxy.set_odds(0);
    cell_.power = {};
}

void World::count_starts() {
    if (is_off_) return;
    for (const auto& [id, record] : cell_.memory.jobs) {
        if (record.starts == 0 || !counted_.insert(id).second) continue;
        ++starts_[id];
        ++file_starts_[to_hex(record.file_sha256)];
        say("JUDGE: job " + to_text(id) + " started");
    }
    if (cell_.memory.starts_total != counted_.size()) count_is_right_ = false;
}

int World::starts_of(const Uuid& job) const {
    const auto found = starts_.find(job);
    return found == starts_.end() ? 0 : found->second;
}

int World::starts_of(const Sha256& file) const {
    const auto found = file_starts_.find(to_hex(file));
    return found == file_starts_.end() ? 0 : found->second;
}

int World::max_starts_of_a_job() const {
    int most = 0;
    for (const auto& [id, starts] : starts_) most = std::max(most, starts);
    return most;
}

}  // namespace qchopper::schedules
