// The passphrase of a private key, from the terminal or from a file descriptor; never from an argument or the
// environment, which other programs can read.
//
// Passphrases have at most 1023 bytes, and their memory is wiped.

#pragma once

#include <optional>
#include <string>

#include "devices/keys/private_key_file.h"

namespace qchopper {

class Passphrase {
 public:
    Passphrase() { text_.reserve(capacity); }
    ~Passphrase();
    Passphrase(Passphrase&& other) noexcept : text_(std::move(other.text_)) {}
    Passphrase& operator=(const Passphrase&) = delete;
    const std::string& text() const { return text_; }
    // False: it is full.
    bool add(char c);

 private:
    static constexpr std::size_t capacity = 1024;
    std::string text_;
};

// For a new key: one line from the descriptor, or asked twice at the terminal, without an echo. Throws InputError
// (use): no such descriptor, no terminal, too long, empty, two that differ; and Cancelled.
Passphrase new_passphrase(const std::optional<int>& fd, const std::string& name);

// Opens the private key: one try with a descriptor, at most three questions at a terminal, a second for each that is
// wrong. Throws what read_own_key throws; InputError (use): no such descriptor, no terminal, too long, wrong;
// Cancelled.
Ed25519PrivateKey open_own_key(const std::string& key, const std::optional<int>& passphrase_fd);

}  // namespace qchopper
