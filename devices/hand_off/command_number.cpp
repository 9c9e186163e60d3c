// Comparisons of numbers. O(1).

#include "devices/hand_off/command_number.h"

#include <algorithm>

namespace qchopper {

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
