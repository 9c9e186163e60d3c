#include "tests/sim/cell/fault_proxy.h"

#include <algorithm>
#include <utility>

#include "sim/cell/random.h"

namespace qchopper::rig {
namespace {

constexpr std::size_t header_bytes = 7;
constexpr std::size_t max_recorded = 50;

// Of the data of a read answer or of a written block; other frames stay.
void swap_pairs(Bytes& frame) {
    if (frame.size() <= header_bytes) return;
    const std::uint8_t function = frame[header_bytes];
    const std::size_t begin = function == 16 ? header_bytes + 6 : header_bytes + 2;
    for (std::size_t i = begin; i + 3 < frame.size(); i += 4) {
        std::swap(frame[i], frame[i + 2]);
        std::swap(frame[i + 1], frame[i + 3]);
    }
}

// Milliseconds, bytes or bits that fit the fault.
std::int64_t drawn_number(LinkFault fault, std::size_t size, std::uint64_t random) {
    switch (fault) {
        case LinkFault::delay:
            return static_cast<std::int64_t>(random % 1800);
        case LinkFault::split:
            return static_cast<std::int64_t>(random % 30);
        case LinkFault::drop_after:
            return static_cast<std::int64_t>(random % size);
        case LinkFault::hold:
            return static_cast<std::int64_t>(random % 12000);
        case LinkFault::flip_bit:
            return static_cast<std::int64_t>(random % (8 * size));
        default:
            return 0;
    }
}

double seconds(std::int64_t ms) {
    return static_cast<double>(ms) / 1000;
}

}  // namespace

const char* name(LinkFault fault) {
    constexpr const char* names[] = {"none",      "delay", "split",     "merge",  "drop-after", "reset",
                                     "half-open", "hold",  "duplicate", "replay", "flip-bit",   "swap-words"};
    return names[static_cast<std::size_t>(fault)];
}

Condition is_command(CellCommand command) {
    return [command](const Bytes& frame) {
        constexpr std::size_t registers_at = header_bytes + 6;
        constexpr std::size_t cmd_at = registers_at + 2 * 6;
        if (frame.size() < cmd_at + 2 || frame[header_bytes] != 16) return false;
        if (frame[header_bytes + 1] != 0 || frame[header_bytes + 2] != 0) return false;  // not at the base of COMMAND
        return (frame[cmd_at] << 8 | frame[cmd_at + 1]) == static_cast<int>(command);
    };
}

void FaultProxy::arm(LinkFault fault, Way way, std::int64_t number, Condition when) {
    armed_.push_back({fault, way, number, std::move(when)});
}

FaultProxy::Armed FaultProxy::draw(Way way, const Bytes& frame) {
    for (auto one = armed_.begin(); one != armed_.end(); ++one) {
        if (one->way != way || (one->when && !one->when(frame))) continue;
        const Armed armed = *one;
        armed_.erase(one);
        return armed;
    }
    if (per_thousand_ == 0 || static_cast<int>(next_random(random_) % 1000) >= per_thousand_) return {};
    constexpr auto kinds = static_cast<std::uint64_t>(LinkFault::count) - 1;
    return {static_cast<LinkFault>(1 + next_random(random_) % kinds), way, -1, {}};
}

std::vector<Piece> FaultProxy::pass(int connection, Way way, const Bytes& frame) {
    Lane& lane = lanes_[connection][static_cast<std::size_t>(way)];
    if (way == Way::to_cell) {
        recorded_.push_back(frame);
        if (recorded_.size() > max_recorded) recorded_.pop_front();
    }
    if (lane.is_dead || frame.empty()) return {};
    Armed armed = draw(way, frame);
    if (armed.fault != LinkFault::none) {
        if (armed.number < 0) armed.number = drawn_number(armed.fault, frame.size(), next_random(random_));
        log_.push_back(std::string(name(armed.fault)) + (way == Way::to_cell ? " to the cell " : " to the PC ") +
                       std::to_string(armed.number));
    }
    Bytes bytes = std::exchange(lane.kept, {});
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    std::vector<Piece> pieces = spoil(armed, lane, connection, way, std::move(bytes));
    for (Piece& piece : pieces) piece.after_s += lane.late_s;
    return pieces;
}

std::vector<Piece> FaultProxy::spoil(const Armed& armed, Lane& lane, int connection, Way way, Bytes frame) {
    const std::int64_t number = armed.number;
    switch (armed.fault) {
        case LinkFault::delay:
            return {{seconds(number), frame}};
        case LinkFault::split: {
            std::vector<Piece> pieces;
            for (std::size_t i = 0; i < frame.size(); ++i) {
                pieces.push_back({seconds(number * static_cast<std::int64_t>(i)), {frame[i]}});
            }
            return pieces;
        }
        case LinkFault::merge:
            lane.kept = std::move(frame);
            return {};
        case LinkFault::drop_after:
            lane.is_dead = true;
            frame.resize(std::min(frame.size(), static_cast<std::size_t>(number)));
            return {{0, frame}};
        case LinkFault::reset:
            return {{0, {}, true}};
        case LinkFault::half_open:
            for (Lane& one : lanes_[connection]) one.is_dead = true;
            return {};
        case LinkFault::hold:
            lane.late_s += seconds(number);
            return {{0, frame}};
        case LinkFault::duplicate:
            return {{0, frame}, {0, frame}};
        case LinkFault::replay: {
            if (way != Way::to_cell) return {{0, frame}};
            const Bytes old = recorded_[next_random(random_) % recorded_.size()];
            return {{0, frame}, {0, old, false, true}};
        }
        case LinkFault::flip_bit: {
            const std::size_t bit = static_cast<std::size_t>(number) % (8 * frame.size());
            frame[bit / 8] = static_cast<std::uint8_t>(frame[bit / 8] ^ (1U << (bit % 8)));
            return {{0, frame}};
        }
        case LinkFault::swap_words:
            swap_pairs(frame);
            return {{0, frame}};
        default:
            return {{0, frame}};
    }
}

std::vector<Piece> FaultProxy::close(int connection) {
    const auto found = lanes_.find(connection);
    if (found == lanes_.end()) return {};
    const Lane lane = found->second[static_cast<std::size_t>(Way::to_cell)];
    lanes_.erase(found);
    if (lane.is_dead || lane.kept.empty()) return {};
    return {{lane.late_s, lane.kept}};
}

}  // namespace qchopper::rig
