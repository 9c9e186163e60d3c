#include "tests/schedules/virtual_link.h"

#include <algorithm>

namespace qchopper::schedules {
namespace {

constexpr double look_s = 0.001;  // between two looks at what has come
constexpr double look_later_s = 0.02;
constexpr double response_s = 1;
constexpr double call_s = 2;

BusAnswer lost(const std::string& why) {
    BusAnswer answer;
    answer.why = why;
    return answer;
}

}  // namespace

BusAnswer VirtualLink::read_input(std::uint16_t address, std::uint16_t count) {
    return call({0, 0, ModbusFunction::read_input, address, count});
}

BusAnswer VirtualLink::read_holding(std::uint16_t address, std::uint16_t count) {
    return call({0, 0, ModbusFunction::read_holding, address, count});
}

BusAnswer VirtualLink::write_holding(std::uint16_t address, std::span<const std::uint16_t> registers) {
    const auto count = static_cast<std::uint16_t>(registers.size());
    return call({0, 0, ModbusFunction::write_holding, address, count, registers});
}

void VirtualLink::leave_when(const std::atomic<bool>* cancelled, double within_s) {
    cancelled_ = cancelled;
    within_s_ = within_s;
    leave_by_s_ = 1e300;
}

double VirtualLink::leaving_for_s() const {
    bounded(1e300);
    return leave_by_s_ > 1e299 ? 0 : within_s_ - (leave_by_s_ - world_.now_s());
}

double VirtualLink::bounded(double deadline_s) const {
    if (cancelled_ != nullptr && cancelled_->load() && leave_by_s_ > 1e299) leave_by_s_ = world_.now_s() + within_s_;
    return std::min(deadline_s, leave_by_s_);
}

BusAnswer VirtualLink::call(ModbusRequest request) {
    if (connection_ < 0) connection_ = world_.connect();
    if (connection_ < 0) {
        world_.sleep(look_s);
        return lost("connection refused");
    }
    request.transaction = ++transaction_;
    request.unit = 1;
    BusAnswer answer = exchange(request);
    if (answer.end == BusEnd::lost) drop();
    return answer;
}

BusAnswer VirtualLink::exchange(const ModbusRequest& request) {
    if (!world_.inbox(connection_).empty()) return lost("the other side sent bytes without a request");
    if (world_.is_closed(connection_)) return lost("the connection was closed by the other side");
    world_.send(connection_, frame_of(request));
    return receive(request);
}

BusAnswer VirtualLink::receive(const ModbusRequest& request) {
    const double began_s = world_.now_s();
    for (;;) {
        Bytes& inbox = world_.inbox(connection_);
        const AnswerSoFar so_far = check_answer(request, inbox);
        if (!so_far.wrong.empty()) {
            BusAnswer alien = lost(so_far.wrong);
            alien.is_alien = true;
            return alien;
        }
        if (inbox.size() >= so_far.wanted) {
            const Bytes bytes(inbox.begin(), inbox.begin() + static_cast<std::ptrdiff_t>(so_far.wanted));
            inbox.erase(inbox.begin(), inbox.begin() + static_cast<std::ptrdiff_t>(so_far.wanted));
            return decode_answer(request, bytes);
        }
        if (world_.is_closed(connection_)) return lost("the connection was closed by the other side");
        const double now_s = world_.now_s();
        if (now_s >= bounded(began_s + (inbox.empty() ? response_s : call_s))) return lost("no answer in time");
        world_.sleep(now_s - began_s < 10 * look_s ? look_s : look_later_s);
    }
}

void VirtualLink::drop() {
    if (connection_ >= 0) world_.close(connection_);
    connection_ = -1;
}

}  // namespace qchopper::schedules
