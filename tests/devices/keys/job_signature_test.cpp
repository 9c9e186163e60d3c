#include "devices/keys/job_signature.h"

#include <gtest/gtest.h>

#include <fstream>

#include "base/files/file.h"
#include "devices/wire/ticket_signature.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

constexpr std::uint64_t now = 1'700'000'000'000;
constexpr std::uint64_t hour_ms = 3'600'000;

struct JobSignatureTest : testing::Test {
    JobSignatureTest() { trust(trusted, "anna", key.public_key(), now); }
    std::string fault(const JobSignature& s) const { return fault_of(s, job, 7, trusted, now); }
    static bool says(const std::string& fault, const char* words) { return fault.find(words) != std::string::npos; }

    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    TrustedKeys trusted;
    const Sha256 job = sha256(Bytes{1, 2, 3});
};

TEST_F(JobSignatureTest, IsTakenForTheJobTheCellAndATrustedKey) {
    EXPECT_EQ(fault(sign_job(key, job, 7, now)), "");
}

TEST_F(JobSignatureTest, EachFaultIsSaid) {
    EXPECT_TRUE(says(fault(sign_job(Ed25519PrivateKey::make(), job, 7, now)), "not trusted"));
    EXPECT_TRUE(says(fault(sign_job(key, sha256(Bytes{1, 2, 4}), 7, now)), "changed after signing"));
    EXPECT_TRUE(says(fault(sign_job(key, job, 8, now)), "signed for cell 8, and this is cell 7"));
    JobSignature stranger = sign_job(Ed25519PrivateKey::make(), job, 7, now);
    stranger.key_id = key_id_of(key.public_key());
    EXPECT_TRUE(says(fault(stranger), "not one of the key"));
    revoke(trusted, "anna", now);
    EXPECT_TRUE(says(fault(sign_job(key, job, 7, now)), "was revoked on"));
}

TEST_F(JobSignatureTest, AClockAnHourOffIsSaid) {
    EXPECT_TRUE(says(fault(sign_job(key, job, 7, now + hour_ms)), "60 minutes in the future"));
    EXPECT_EQ(fault(sign_job(key, job, 7, now + most_ahead_ms)), "");
    EXPECT_EQ(fault(sign_job(key, job, 7, now - hour_ms)), "");
}

TEST_F(JobSignatureTest, NoFieldCanBeChanged) {
    const JobSignature good = sign_job(key, job, 7, now);
    JobSignature other = good;
    other.cell_id = 8;
    EXPECT_TRUE(says(fault_of(other, job, 8, trusted, now), "changed after signing"));
    other = good;
    other.job_sha256 = sha256(Bytes{4});
    EXPECT_TRUE(says(fault_of(other, other.job_sha256, 7, trusted, now), "changed after signing"));
    other = good;
    other.signed_ms -= 1;
    EXPECT_TRUE(says(fault(other), "changed after signing"));
}

TEST_F(JobSignatureTest, ATicketSignatureIsNoneOfAJob) {
    JobSignature other = sign_job(key, job, 7, now);
    other.signature = key.sign(signed_bytes(Registers(100, 1)));
    EXPECT_FALSE(fault(other).empty());
}

TEST_F(JobSignatureTest, TheFileComesBackAndCutShortItIsRefused) {
    const Folder folder;
    const auto file = folder.path / "A.qjob";
    EXPECT_EQ(fault_of(read_signature(file), job, 7, false, trusted, now), "");
    EXPECT_TRUE(says(fault_of(read_signature(file), job, 7, true, trusted, now), "not signed"));
    const JobSignature good = sign_job(key, job, 7, now);
    write_signature(file, good);
    EXPECT_EQ(signature_file(file).filename(), "A.signature.json");
    ASSERT_TRUE(read_signature(file).signature);
    EXPECT_EQ(*read_signature(file).signature, good);
    const std::string text = to_json(good);
    for (std::size_t size = 0; size < text.size(); ++size) {
        std::ofstream(signature_file(file), std::ios::binary) << text.substr(0, size);
        const std::string why = fault_of(read_signature(file), job, 7, false, trusted, now);
        EXPECT_FALSE(why.empty()) << size;
        EXPECT_TRUE(says(why, size == 0 ? "is empty" : size + 1 < text.size() ? "cut short" : "form")) << why;
    }
}

TEST_F(JobSignatureTest, ASignatureThatIsCutOffIsSaid) {
    const Folder folder;
    const auto file = folder.path / "A.qjob";
    std::string text = to_json(sign_job(key, job, 7, now));
    text.erase(text.find("signature\": \"") + 13, 68);
    std::ofstream(signature_file(file), std::ios::binary) << text;
    EXPECT_TRUE(says(read_signature(file).fault, "signature is cut off: it has 60 of 128 digits"))
        << read_signature(file).fault;
}

}  // namespace
}  // namespace qchopper
