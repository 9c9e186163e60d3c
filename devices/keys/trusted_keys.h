// The list of public keys whose signatures a computer takes, in a JSON file.
//
// A revoked key stays in the list, so that it is refused by that name. No two keys of a list have the same KEY_ID or
// name (tests/devices/keys/trusted_keys_test.cpp). Times in ms since 1970 (UTC); nothing is decided by them.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "devices/wire/ed25519.h"

namespace qchopper {

struct TrustedKey {
    std::string name;
    Ed25519PublicKey key;
    std::uint64_t trusted_ms = 0;
    std::optional<std::uint64_t> revoked_ms;
    bool operator==(const TrustedKey&) const = default;
};

struct TrustedKeys {
    std::vector<TrustedKey> keys;
    bool operator==(const TrustedKeys&) const = default;
};

// KEY_ID as people see it: eight hexadecimal digits.
std::string key_id_text(std::uint32_t id);

// nullptr: it is not in the list.
const TrustedKey* find_key(const TrustedKeys& list, std::uint32_t key_id);

// Adds a key. Throws InputError (use) if the list has another key of this id or name, or if this key is revoked in it:
// that is final. A key that is trusted already stays as it is.
void trust(TrustedKeys& list, const std::string& name, const Ed25519PublicKey& key, std::uint64_t now_ms);

// By name or KEY_ID. Throws InputError (use) if the list has no such key. Of a key that is revoked nothing changes.
const TrustedKey& revoke(TrustedKeys& list, std::string_view key, std::uint64_t now_ms);

// JSON text, and its inverse, which throws InputError (config) naming `source`.
std::string to_json(const TrustedKeys& list);
TrustedKeys trusted_keys_from_json(std::string_view text, const std::string& source);

// An empty list if there is no file. Throws InputError (missing, config) for a file that is no such list: it must not
// count as empty, because a revoked key would be an unknown one.
TrustedKeys read_trusted_keys(const std::filesystem::path& file);
// Throws what write_file throws.
void write_trusted_keys(const std::filesystem::path& file, const TrustedKeys& list);

}  // namespace qchopper
