// Comparisons of numbers. O(1).

#include "devices/hand_off/seen_store.h"

#include <algorithm>

#include "devices/hand_off/first_contact.h"

namespace qchopper {

SeenStore seen_store(const Status& status, const Uuid& store_id) {
    return {store_id, status.version, status.boot_count, status.epoch_held, status.starts_total};
}

SeenStore seen_store(const Identity& i) {
    return {i.store_id, i.version, i.boot_count, i.epoch_held, i.starts_total};
}

std::string loss_between(const SeenStore& before, const SeenStore& now) {
    const auto fell = [](const char* counter, std::uint32_t from, std::uint32_t to) {
        return std::string(counter) + " went back from " + std::to_string(from) + " to " + std::to_string(to);
    };
    if (before.store_id != Uuid{} && before.store_id != now.store_id) {
        return "its STORE_ID is " + to_text(now.store_id) + " and was " + to_text(before.store_id);
    }
    if (now.boot_count < before.boot_count) return fell("BOOT_COUNT", before.boot_count, now.boot_count);
    if (now.epoch_held < before.epoch_held) return fell("EPOCH_HELD", before.epoch_held, now.epoch_held);
    if (now.starts_total < before.starts_total) return fell("STARTS_TOTAL", before.starts_total, now.starts_total);
    return {};
}

std::optional<SeenStore> read_store(RegisterBus& bus) {
    const HandOffInput input = read_identity_block(bus);
    if (!input.identity) return std::nullopt;
    return seen_store(*input.identity);
}

std::uint32_t number_after(const Status& status, std::uint32_t owner, std::uint32_t last_known) {
    return status.ack_owner == owner ? std::max(last_known, status.ack_seq) : last_known;
}

bool has_refused_number(std::uint16_t bad_frames_before, const Status& now) {
    return now.bad_frames != bad_frames_before && now.bad_reason == AckResult::stale_seq;
}

bool is_answer_to_claim(const Status& status, std::uint32_t epoch) {
    if (status.ack_command != CellCommand::claim) return false;
    const bool is_granted = status.ack_result == AckResult::ok || status.ack_result == AckResult::already;
    return !is_granted || status.epoch_held >= epoch;
}

}  // namespace qchopper
