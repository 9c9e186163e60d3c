// The checksum is the beginning of a SHA-256: names that others chose are never taken for ours. O(length).

#include "base/files/temporary_name.h"

#include <unistd.h>

#include <charconv>
#include <cstdint>
#include <random>

#include "base/process.h"
#include "base/sha256.h"

namespace qchopper {
namespace {

constexpr const char* infix = ".tmp.";
constexpr std::size_t digits = 8;  // of the random part and of the checksum

std::string first_digits(const std::string& text) {
    const std::string marked = "qchopper temporary name " + text;
    return to_hex(sha256({reinterpret_cast<const std::uint8_t*>(marked.data()), marked.size()})).substr(0, digits);
}

std::string with_checksum(const std::string& text) {
    return text + "-" + first_digits(text);
}

}  // namespace

std::string temporary_name(const std::string& name) {
    std::random_device random;
    const std::string chance = first_digits(std::to_string(random()) + " " + std::to_string(random()));
    return with_checksum(name + infix + host_name() + "." + std::to_string(::getpid()) + "." + chance);
}

bool is_leftover(const std::string& file_name) {
    const std::size_t checksum = file_name.rfind('-');
    const std::size_t at = file_name.rfind(infix);
    if (at == std::string::npos || checksum == std::string::npos || checksum < at) return false;
    if (with_checksum(file_name.substr(0, checksum)) != file_name) return false;
    const std::string own = host_name() + ".";
    const std::string rest = file_name.substr(at + std::string(infix).size());
    if (!rest.starts_with(own)) return false;
    long process = 0;
    std::from_chars(rest.data() + own.size(), rest.data() + rest.size(), process);
    return process > 0 && has_process_ended(process);
}

}  // namespace qchopper
