// What keys shows of trusted, revoked and refused keys.

#include "app/report/cell/keys_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "devices/wire/ticket_signature.h"

namespace qchopper {
namespace {

KeysReport report_of(const Ed25519PublicKey& anna, const Ed25519PublicKey& otto) {
    KeysReport report{
        "trusted.json",
        {},
        {{"/keys/anna.key", key_id_text(key_id_of(anna)), true, {}}, {"/keys/b.key", {}, false, "it is empty"}}};
    trust(report.trusted, "anna", anna, 1'700'000'000'000);
    trust(report.trusted, "otto", otto, 1'700'000'000'000);
    revoke(report.trusted, "otto", 1'700'000'100'000);
    return report;
}

TEST(KeysReport, SaysWhichKeysAreTrustedRevokedAndRefused) {
    const Ed25519PublicKey anna = Ed25519PrivateKey::make().public_key();
    const Ed25519PublicKey otto = Ed25519PrivateKey::make().public_key();
    const KeysReport report = report_of(anna, otto);
    std::string text;
    for (const std::string& line : lines(report)) text += line + "\n";
    EXPECT_NE(text.find(key_id_text(key_id_of(anna)) + "  anna: trusted since 2023-11-14"), std::string::npos) << text;
    EXPECT_NE(text.find("otto: REVOKED on 2023-11-14"), std::string::npos) << text;
    EXPECT_NE(text.find("/keys/b.key: REFUSED: it is empty"), std::string::npos) << text;
    const nlohmann::ordered_json json = *document(report).json;
    EXPECT_EQ(json["trusted"][0]["key_id"], key_id_text(key_id_of(anna)));
    EXPECT_TRUE(json["trusted"][0]["revoked_ms"].is_null());
    EXPECT_EQ(json["trusted"][1]["revoked_ms"], 1'700'000'100'000);
    EXPECT_EQ(json["own"][0]["encrypted"], true);
}

TEST(KeysReport, OneWrongSignatureIsNotAllRight) {
    EXPECT_TRUE(is_all_right({{"A.qjob", ""}}));
    EXPECT_FALSE(is_all_right({{"A.qjob", ""}, {"B.qjob", "it is not signed"}}));
}

}  // namespace
}  // namespace qchopper
