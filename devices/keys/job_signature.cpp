// Ed25519 over 60 bytes, and one table of fields. O(keys of the list).

#include "devices/keys/job_signature.h"

#include <algorithm>
#include <span>

#include "base/error.h"
#include "base/files/file.h"
#include "base/json_fields.h"
#include "base/text.h"
#include "devices/wire/register_writer.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {
namespace {

// "is cut off: it has 60 of 128 digits", or that it is no hexadecimal number.
template <std::size_t size>
std::array<std::uint8_t, size> bytes_from(const std::string& digits, const char* key) {
    if (const auto bytes = from_hex<size>(digits)) return *bytes;
    if (digits.size() < 2 * size) {
        throw json_values::wrong(
            key, "is cut off: it has " + std::to_string(digits.size()) + " of " + std::to_string(2 * size) + " digits");
    }
    throw json_values::wrong(key, "is not " + std::to_string(2 * size) + " hexadecimal digits");
}

Bytes signed_bytes_of(const JobSignature& s) {
    RegisterWriter writer;
    writer.bytes(s.job_sha256.bytes).u16(s.cell_id).u32(s.key_id).u64(s.signed_ms);
    Bytes bytes(job_signature_head.begin(), job_signature_head.end());
    const Bytes rest = bytes_of(writer.registers());
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
}

std::string minutes_text(std::uint64_t ms) {
    return std::to_string(ms / 60'000) + " minutes";
}

}  // namespace

template <class V, Of<JobSignature> T>
void fields(V& v, T& s) {
    v.constant("format", "qchopper signature", "is not a qchopper signature");
    v.version("schema", 1);
    v("job_sha256", s.job_sha256);
    v("cell_id", s.cell_id);
    v.converted("key_id", s.key_id, key_id_text, [](const std::string& digits) {
        std::uint32_t id = 0;
        for (const std::uint8_t byte : bytes_from<4>(digits, "key_id")) id = id << 8U | byte;
        return id;
    });
    v("signed_ms", s.signed_ms);
    v.written("signed", [&] { return utc_text(s.signed_ms); });
    v.converted(
        "signature", s.signature, [](const Ed25519Signature& given) { return to_hex(given.bytes); },
        [](const std::string& digits) { return Ed25519Signature{bytes_from<64>(digits, "signature")}; });
}

JobSignature sign_job(const Ed25519PrivateKey& key, const Sha256& job_sha256, std::uint16_t cell_id,
                      std::uint64_t now_ms) {
    JobSignature signature{job_sha256, cell_id, key_id_of(key.public_key()), now_ms, {}};
    signature.signature = key.sign(signed_bytes_of(signature));
    return signature;
}

std::string fault_of(const JobSignature& s, const Sha256& job_sha256, std::uint16_t cell_id, const TrustedKeys& trusted,
                     std::uint64_t now_ms) {
    const std::string id = key_id_text(s.key_id);
    const TrustedKey* const key = find_key(trusted, s.key_id);
    if (key == nullptr) return "it is signed by the key " + id + ", which is not trusted here";
    if (key->revoked_ms) {
        return "it is signed by the key " + id + " of " + key->name + ", which was revoked on " +
               utc_text(*key->revoked_ms);
    }
    if (!is_signed_by(key->key, signed_bytes_of(s), s.signature)) {
        return "its signature file was changed after signing: the signature is not one of the key " + id;
    }
    if (s.job_sha256 != job_sha256) return "it was changed after signing, or the signature is that of another job";
    if (s.cell_id != cell_id) {
        return "it is signed for cell " + std::to_string(s.cell_id) + ", and this is cell " + std::to_string(cell_id);
    }
    if (s.signed_ms > now_ms + most_ahead_ms) {
        return "its signature is " + minutes_text(s.signed_ms - now_ms) +
               " in the future: the clock of this computer, or that of the signer, is wrong";
    }
    return {};
}

std::string to_json(const JobSignature& signature) {
    return json_values::to_document(signature);
}

std::filesystem::path signature_file(const std::filesystem::path& job) {
    std::filesystem::path file = job;
    return file.replace_extension(".signature.json");
}

void write_signature(const std::filesystem::path& job, const JobSignature& signature) {
    write_file(signature_file(job), to_json(signature));
}

FoundSignature read_signature(const std::filesystem::path& job) {
    const std::filesystem::path file = signature_file(job);
    std::error_code error;
    if (std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::not_found) return {};
    const std::string name = "its signature " + file.string();
    try {
        const Bytes bytes = read_file(file, settings_limit);
        if (bytes.empty()) return {{}, name + " is empty"};
        JobSignature signature;
        json_values::from_document({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, signature);
        return {signature, {}};
    } catch (const InputError& fault) {
        return {{}, std::string("its signature cannot be read: ") + fault.what()};
    } catch (const json_values::NotJson&) {
        return {{}, name + " is cut short or no JSON"};
    } catch (const std::runtime_error& fault) {
        return {{}, name + " is not used: " + fault.what()};
    }
}

std::string fault_of(const FoundSignature& found, const Sha256& job_sha256, std::uint16_t cell_id,
                     bool require_signature, const TrustedKeys& trusted, std::uint64_t now_ms) {
    if (!found.fault.empty()) return found.fault;
    if (found.signature) return fault_of(*found.signature, job_sha256, cell_id, trusted, now_ms);
    return require_signature ? "it is not signed, and the cell requires a signature" : "";
}

}  // namespace qchopper
