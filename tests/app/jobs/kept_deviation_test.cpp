#include "app/jobs/kept_deviation.h"

#include <gtest/gtest.h>

#include "tests/folder.h"

namespace qchopper {
namespace {

Sha256 hash_of(std::uint8_t byte) {
    Sha256 hash{};
    hash.bytes.fill(byte);
    return hash;
}

JobProof some_proof() {
    JobProof proof;
    proof.deviation = {0.25F, -1.5F, 0};
    proof.is_given_up = {false, true, false};
    return proof;
}

TEST(KeptDeviation, IsThatOfTheSameJobAndCell) {
    const Folder folder;
    const JobProof proof = some_proof();
    keep_deviation(folder.path, hash_of(1), hash_of(2), proof);
    EXPECT_EQ(kept_deviation(folder.path, hash_of(1), hash_of(2)), (JobDeviation{proof.deviation, proof.is_given_up}));
    EXPECT_EQ(kept_deviation(folder.path, hash_of(3), hash_of(2)), std::nullopt);
    EXPECT_EQ(kept_deviation(folder.path, hash_of(1), hash_of(3)), std::nullopt);
    EXPECT_EQ(kept_deviation(folder.path / "none", hash_of(1), hash_of(2)), std::nullopt);
}

TEST(KeptDeviation, OfAProofThatCouldNotReplayThereIsNone) {
    const Folder folder;
    keep_deviation(folder.path, hash_of(1), hash_of(2), {});
    EXPECT_EQ(kept_deviation(folder.path, hash_of(1), hash_of(2)), std::nullopt);
}

TEST(KeptDeviation, ADamagedFileIsIgnored) {
    const Folder folder;
    keep_deviation(folder.path, hash_of(1), hash_of(2), some_proof());
    const std::filesystem::path file = std::filesystem::directory_iterator(folder.path)->path();
    EXPECT_EQ(file.extension(), deviations_ending);
    Bytes bytes = read_file(file);
    bytes[bytes.size() / 2] ^= 1;
    write_file(file, bytes);
    EXPECT_EQ(kept_deviation(folder.path, hash_of(1), hash_of(2)), std::nullopt);
}

}  // namespace
}  // namespace qchopper
