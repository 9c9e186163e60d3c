// What `qchopper keys` shows: text for people, one JSON document for programs.

#pragma once

#include <string>
#include <vector>

#include "app/dispatch/signing.h"
#include "app/report/document.h"

namespace qchopper {

// A private key in the folder of keys.
struct OwnKey {
    std::string file;
    std::string key_id;  // empty: it is not used, because of `fault`
    bool is_encrypted = false;
    std::string fault;
};

struct KeysReport {
    std::string list;  // its file
    TrustedKeys trusted;
    std::vector<OwnKey> own;
};
std::vector<std::string> lines(const KeysReport& report);
// The document qchopper-keys-1.
Document document(const KeysReport& report);

// A key that was made, trusted or revoked.
struct ChangedKey {
    std::string action;  // "made", "trusted", "revoked"
    std::string name;
    std::string key_id;
    std::vector<std::string> files;  // written
    std::string next;                // what to do now; may be empty
};
std::vector<std::string> lines(const ChangedKey& changed);
// The document qchopper-key-1.
Document document(const ChangedKey& changed);

std::vector<std::string> lines(const std::vector<SignedJob>& jobs);
// The document qchopper-signed-1.
Document document(const std::vector<SignedJob>& jobs);

bool is_all_right(const std::vector<CheckedSignature>& jobs);
std::vector<std::string> lines(const std::vector<CheckedSignature>& jobs);
// The document qchopper-signatures-1.
Document document(const std::vector<CheckedSignature>& jobs);

}  // namespace qchopper
