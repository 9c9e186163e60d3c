// getrandom(2), which waits until the system has gathered entropy.

#include "devices/hand_off/random.h"

#include <errno.h>
#include <sys/random.h>

#include <array>
#include <cstring>
#include <span>

#include "base/error.h"

namespace qchopper {
namespace {

void fill_random(std::span<std::uint8_t> bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t got = getrandom(bytes.data() + done, bytes.size() - done, 0);
        if (got > 0) done += static_cast<std::size_t>(got);
        if (got < 0 && errno != EINTR) {
            throw InputError(InputFault::io, "the operating system gives no random numbers; nothing was sent", "");
        }
    }
}

}  // namespace

std::uint32_t random_number() {
    std::array<std::uint8_t, 4> bytes{};
    std::uint32_t number = 0;
    while (number == 0) {
        fill_random(bytes);
        std::memcpy(&number, bytes.data(), bytes.size());
    }
    return number;
}

Uuid random_id() {
    Uuid id{};
    fill_random(id);
    id[6] = static_cast<std::uint8_t>((id[6] & 0x0F) | 0x40);
    id[8] = static_cast<std::uint8_t>((id[8] & 0x3F) | 0x80);
    return id;
}

}  // namespace qchopper
