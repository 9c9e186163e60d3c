// The private key of a person in a file of its own: made once, opened by its passphrase.
//
// The file is PEM: the private key (PKCS#8), encrypted unless it was made without a passphrase, then the public key. It
// belongs to the user, nobody else may read or write it (mode 0600), and it is no symbolic link; any other file is
// refused (tests/devices/keys/private_key_file_test.cpp).

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "devices/wire/ed25519.h"

namespace qchopper {

struct PrivateKeyFile {
    std::filesystem::path path;
    Ed25519PublicKey public_key;
    bool is_encrypted = false;
    std::string pem;
};

// Writes the file under another name, then links it to `path`: it appears whole or not at all. Throws InputError
// (create) if there is something at `path` already, which is never replaced, or if it cannot be written.
void write_private_key(const std::filesystem::path& path, const Ed25519PrivateKey& key, std::string_view passphrase);

// All checks but that of the passphrase. Throws InputError: missing if it is not there or not readable; config if it is
// a symbolic link, belongs to another user, may be read by others, is empty, cut short, or a key of another kind.
PrivateKeyFile read_private_key(const std::filesystem::path& path);

// Nothing: the passphrase is wrong; that takes a second, however it is found. Throws InputError (config) if the private
// key is damaged, or not that of the public key in the file.
std::optional<Ed25519PrivateKey> open_private_key(const PrivateKeyFile& file, std::string_view passphrase);

}  // namespace qchopper
