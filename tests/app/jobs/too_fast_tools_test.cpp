// Which tools get less feed because of what the proofs found.

#include <gtest/gtest.h>

#include "app/jobs/piece_program.h"

namespace qchopper {
namespace {

ProvenProgram part_with(std::vector<ProofFinding> findings) {
    ProvenProgram part;
    JobChunk first;
    first.file = "qc_1_001.src";
    first.tool = 1;
    JobChunk second;
    second.file = "qc_1_002.src";
    second.tool = 4;
    part.input.program.chunks = {first, second};
    part.proof.findings = std::move(findings);
    return part;
}

const ProofFinding too_fast_1{"removal_rate", "qc_1_001.src", 7, "foam is removed at 30 cm3/s, tool 1 may remove 24"};
const ProofFinding too_fast_4{"removal_rate", "qc_1_002.src", 9, "foam is removed at 1.7 cm3/s, tool 4 may remove 1.5"};
const ProofFinding gouge{"gouge", "qc_1_002.src", 9, "the tool is 0.4 mm in the piece"};

TEST(TooFastTools, AreThoseOfTheChunksThatAreNamed) {
    using Numbers = std::set<std::uint16_t>;
    EXPECT_EQ(too_fast_tools({}), Numbers());
    EXPECT_EQ(too_fast_tools({part_with({})}), Numbers());
    EXPECT_EQ(too_fast_tools({part_with({too_fast_4, too_fast_4})}), Numbers({4}));
    EXPECT_EQ(too_fast_tools({part_with({too_fast_4}), part_with({}), part_with({too_fast_1})}), Numbers({1, 4}));
}

TEST(TooFastTools, AreNoneWhereLessFeedIsNoRemedy) {
    EXPECT_TRUE(too_fast_tools({part_with({too_fast_4, gouge})}).empty());
    EXPECT_TRUE(too_fast_tools({part_with({gouge}), part_with({too_fast_1})}).empty());
}

}  // namespace
}  // namespace qchopper
