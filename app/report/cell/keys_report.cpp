// Text and JSON from values. O(keys + jobs).

#include "app/report/cell/keys_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/report/report_json.h"
#include "base/printable.h"
#include "base/text.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {

namespace {

// A trusted key for programs.
struct ListedKey {
    TrustedKey key;
};

std::vector<ListedKey> listed(const std::vector<TrustedKey>& keys) {
    std::vector<ListedKey> all;
    all.reserve(keys.size());
    for (const TrustedKey& key : keys) all.push_back({key});
    return all;
}

struct SignedFiles {
    const std::vector<SignedJob>& jobs;
};

struct CheckedFiles {
    const std::vector<CheckedSignature>& jobs;
};

template <class V, Of<ListedKey> T>
void fields(V& v, T& listed) {
    v("name", listed.key.name);
    v.written("key_id", [&] { return key_id_text(key_id_of(listed.key.key)); });
    v("trusted_ms", listed.key.trusted_ms);
    v("revoked_ms", listed.key.revoked_ms);
}

template <class V, Of<SignedFiles> T>
void fields(V& v, T& files) {
    v.constant("schema", "qchopper-signed-1", "");
    v("jobs", files.jobs);
}

template <class V, Of<CheckedFiles> T>
void fields(V& v, T& files) {
    v.constant("schema", "qchopper-signatures-1", "");
    v("jobs", files.jobs);
}

}  // namespace

template <class V, Of<OwnKey> T>
void fields(V& v, T& key) {
    v("file", key.file);
    v("key_id", key.key_id);
    v("encrypted", key.is_encrypted);
    v("fault", key.fault);
}

template <class V, Of<KeysReport> T>
void fields(V& v, T& report) {
    v.constant("schema", "qchopper-keys-1", "");
    v("list", report.list);
    v.written("trusted", [&] { return listed(report.trusted.keys); });
    v("own", report.own);
}

template <class V, Of<ChangedKey> T>
void fields(V& v, T& changed) {
    v.constant("schema", "qchopper-key-1", "");
    v("action", changed.action);
    v("name", changed.name);
    v("key_id", changed.key_id);
    v("files", changed.files);
}

template <class V, Of<SignedJob> T>
void fields(V& v, T& job) {
    v("job", job.job);
    v("signature", job.signature);
}

template <class V, Of<CheckedSignature> T>
void fields(V& v, T& checked) {
    v("job", checked.job);
    v("signature_fault", checked.fault);
}

namespace {

std::string word(const TrustedKey& key) {
    const std::string head = "  " + key_id_text(key_id_of(key.key)) + "  " + printable(key.name);
    if (key.revoked_ms) return head + ": REVOKED on " + utc_text(*key.revoked_ms);
    return head + ": trusted since " + utc_text(key.trusted_ms);
}

std::string word(const OwnKey& key) {
    if (!key.fault.empty()) return "  " + printable(key.file) + ": REFUSED: " + printable(key.fault);
    return "  " + key.key_id + "  " + printable(key.file) + (key.is_encrypted ? "" : ": without a passphrase");
}

}  // namespace

std::vector<std::string> lines(const KeysReport& report) {
    std::vector<std::string> text{"trusted keys, " + printable(report.list) +
                                  (report.trusted.keys.empty() ? ": none" : ":")};
    for (const TrustedKey& key : report.trusted.keys) text.push_back(word(key));
    text.emplace_back(report.own.empty() ? "private keys of this user: none" : "private keys of this user:");
    for (const OwnKey& key : report.own) text.push_back(word(key));
    return text;
}

Document document(const KeysReport& report) {
    return compose(json_of(report));
}

std::vector<std::string> lines(const ChangedKey& changed) {
    std::vector<std::string> text{"key " + changed.key_id + " of " + printable(changed.name) + " is " + changed.action};
    for (const std::string& file : changed.files) text.push_back("  " + printable(file));
    if (!changed.next.empty()) text.push_back(changed.next);
    return text;
}

Document document(const ChangedKey& changed) {
    return compose(json_of(changed));
}

std::vector<std::string> lines(const std::vector<SignedJob>& jobs) {
    std::vector<std::string> text;
    text.reserve(jobs.size());
    for (const SignedJob& job : jobs) text.push_back("signed: " + printable(job.signature.string()));
    return text;
}

Document document(const std::vector<SignedJob>& jobs) {
    return compose(json_of(SignedFiles{jobs}));
}

bool is_all_right(const std::vector<CheckedSignature>& jobs) {
    return std::ranges::all_of(jobs, [](const CheckedSignature& job) { return job.fault.empty(); });
}

std::vector<std::string> lines(const std::vector<CheckedSignature>& jobs) {
    std::vector<std::string> text;
    text.reserve(jobs.size());
    for (const CheckedSignature& job : jobs) {
        text.push_back(printable(job.job.string()) +
                       (job.fault.empty() ? ": signed by a trusted key" : ": REFUSED: " + printable(job.fault)));
    }
    return text;
}

Document document(const std::vector<CheckedSignature>& jobs) {
    return compose(json_of(CheckedFiles{jobs}));
}

}  // namespace qchopper
