// One table of fields per object of the JSON. O(keys) for each search.

#include "devices/keys/trusted_keys.h"

#include <algorithm>
#include <cstdio>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json_fields.h"
#include "base/text.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {

template <class V, Of<TrustedKey> T>
void fields(V& v, T& key) {
    v("name", key.name);
    v.converted(
        "public_key", key.key, [](const Ed25519PublicKey& given) { return to_hex(given.bytes); },
        [](const std::string& digits) {
            const auto bytes = from_hex<32>(digits);
            if (!bytes) throw json_values::wrong("public_key", "is not 64 hexadecimal digits");
            return Ed25519PublicKey{*bytes};
        });
    v.derived(
        "key_id", [&] { return key_id_text(key_id_of(key.key)); }, "is not that of the public key");
    v("trusted_ms", key.trusted_ms);
    v("revoked_ms", key.revoked_ms);
}

template <class V, Of<TrustedKeys> T>
void fields(V& v, T& list) {
    v.constant("format", "qchopper trusted keys", "is not a list of trusted keys of qchopper");
    v.version("schema", 1);
    v("keys", list.keys);
}

namespace {

[[noreturn]] void refuse(const std::string& what, const Sentence& to_do) {
    throw InputError(InputFault::use, what, to_do);
}

}  // namespace

std::string key_id_text(std::uint32_t id) {
    char text[9];
    std::snprintf(text, sizeof text, "%08x", id);
    return text;
}

const TrustedKey* find_key(const TrustedKeys& list, std::uint32_t key_id) {
    const auto found = std::ranges::find_if(list.keys, [&](const TrustedKey& k) { return key_id_of(k.key) == key_id; });
    return found == list.keys.end() ? nullptr : &*found;
}

void trust(TrustedKeys& list, const std::string& name, const Ed25519PublicKey& key, std::uint64_t now_ms) {
    const std::string id = key_id_text(key_id_of(key));
    if (const TrustedKey* const known = find_key(list, key_id_of(key))) {
        if (known->key != key) {
            refuse("the list has another key with the id " + id + ", of " + known->name, "make another key");
        }
        if (known->revoked_ms) {
            refuse("the key " + id + " of " + known->name + " was revoked, and that is final", "make another key");
        }
        return;
    }
    if (std::ranges::any_of(list.keys, [&](const TrustedKey& k) { return k.name == name; })) {
        refuse("the list has another key with the name " + name,
               Sentence::with_key("name_key", {}, "give this one another name"));
    }
    list.keys.push_back({name, key, now_ms, std::nullopt});
}

const TrustedKey& revoke(TrustedKeys& list, std::string_view key, std::uint64_t now_ms) {
    const auto found = std::ranges::find_if(
        list.keys, [&](const TrustedKey& k) { return k.name == key || key_id_text(key_id_of(k.key)) == key; });
    if (found == list.keys.end()) {
        refuse("the list has no key with the name or the id " + std::string(key),
               "see the list by: qchopper keys show; to revoke a key that is not in it, trust it first");
    }
    if (!found->revoked_ms) found->revoked_ms = now_ms;
    return *found;
}

std::string to_json(const TrustedKeys& list) {
    return json_values::to_document(list);
}

TrustedKeys trusted_keys_from_json(std::string_view text, const std::string& source) {
    TrustedKeys list;
    try {
        json_values::from_document(text, list);
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::config, source + " is not a list of trusted keys: " + error.what(),
                         "restore it from a copy; without it no signature is taken");
    }
    return list;
}

TrustedKeys read_trusted_keys(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::not_found) return {};
    const Bytes bytes = read_file(file, settings_limit);
    return trusted_keys_from_json({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file.string());
}

void write_trusted_keys(const std::filesystem::path& file, const TrustedKeys& list) {
    write_file(file, to_json(list));
}

}  // namespace qchopper
