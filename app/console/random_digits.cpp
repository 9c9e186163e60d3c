#include "app/console/random_digits.h"

#include <cstdint>
#include <random>
#include <vector>

#include "base/hex.h"

namespace qchopper {

std::string random_digits(std::size_t bytes) {
    std::random_device device;
    std::vector<std::uint8_t> random(bytes);
    for (std::uint8_t& byte : random) byte = static_cast<std::uint8_t>(device());
    return to_hex(random);
}

}  // namespace qchopper
