// Jobs from which a tool or a direction was taken out of program and manifest alike: what must be carved stays the
// same. The piece has a groove that only the finest ball enters, and a notch that no tool sees from above.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "segment/search/segmentation.h"
#include "tests/app/jobs/proven_job.h"
#include "tests/segment/objectives/extruded.h"

namespace qchopper {
namespace {

constexpr std::uint16_t finest = 4;  // of the cell

Piece grooved_piece() {
    return uncut(extruded({{-35, 0},
                           {35, 0},
                           {35, 6},
                           {27, 8},
                           {27, 14},
                           {35, 18},
                           {35, 22},
                           {5, 22},
                           {3, 15},
                           {-3, 15},
                           {-5, 22},
                           {-35, 22}},
                          0, 43),
                 0)
        .pieces.front();
}

// Every tool finishes what it reaches better than those before it.
const ProvenJob& grooved() {
    static const ProvenJob job = made_and_proven("kr60-ha", grooved_piece(), {}, FineTools::all);
    return job;
}

std::string kinds_of(const JobVerdict& verdict) {
    std::string kinds;
    for (const ProofFinding& finding : verdict.findings) kinds += finding.kind + ": " + finding.text + "\n";
    return kinds;
}

double figure(const JobVerdict& verdict, const std::string& key) {
    for (const ProofFigure& own : verdict.figures) {
        if (own.key == key) return own.value;
    }
    return -1;
}

// Without the chunks of which `is_lost` is true: their files, their calls, and what the manifest says of them.
ReadJob without(const std::function<bool(const JobChunk&)>& is_lost) {
    const JobProgram& program = *grooved().job.program;
    ProgramFiles files = texts_of(grooved().job);
    for (const JobChunk& chunk : program.chunks) {
        if (!is_lost(chunk)) continue;
        const std::string stem = chunk.file.substr(0, chunk.file.find('.'));
        std::erase_if(files, [&](const ProgramFile& file) { return file.name.substr(0, file.name.find('.')) == stem; });
        for (ProgramFile& file : files) {
            const std::string call = stem + "( )\r\n";
            const std::size_t at = file.text.find(call);
            if (at != std::string::npos) file.text.erase(at, call.size());
        }
    }
    return remade(grooved(), files);
}

TEST(LeftOut, TheJobAsMadeIsProvenAndSaysWhatItLeavesOut) {
    const ProvenJob made = made_and_proven("kr60-ha", grooved_piece());
    EXPECT_TRUE(made.verdict.is_positive) << kinds_of(made.verdict);
    const JobProgram& program = *made.job.program;
    EXPECT_TRUE(std::any_of(program.left_out.begin(), program.left_out.end(), [](const ToolLeftOut& left) {
        return left.tool && !left.orientation && left.because.find("tool 8 roughs") != std::string::npos;
    })) << "a tool that is not worth its change on a piece so small";
    EXPECT_LE(figure(made.verdict, "given_up_percent"), 0.5);
    EXPECT_EQ(made.job.setup.tools, (std::vector<std::uint16_t>{1, 2, 3, 4, 5, 6, 7, 8})) << "long ones reach no more";
    EXPECT_EQ(figure(made.verdict, "not_allowed_percent"), 0);
    EXPECT_TRUE(made.verdict.notes.empty()) << "there was no order";
    ReadJob silent = made.job;
    silent.program->left_out.clear();
    const JobVerdict refused = judged(silent, made.cell);
    ASSERT_FALSE(refused.findings.empty());
    EXPECT_EQ(refused.findings.front().kind, "left_out") << kinds_of(refused);
}

TEST(LeftOut, WithAllToolsTheJobIsProvenToo) {
    EXPECT_TRUE(grooved().verdict.is_positive) << kinds_of(grooved().verdict);
}

TEST(LeftOut, WithoutTheFinestToolTheJobIsRefused) {
    ReadJob job = without([](const JobChunk& chunk) { return chunk.tool == finest; });
    job.program->left_out.push_back({finest, std::nullopt, "it is not needed"});
    const JobVerdict verdict = judged(job, grooved().cell);
    EXPECT_NE(kinds_of(verdict).find("given_up: "), std::string::npos) << kinds_of(verdict);
    EXPECT_NE(kinds_of(verdict).find("tool 4 in orientation"), std::string::npos) << kinds_of(verdict);
    EXPECT_GT(figure(verdict, "given_up_percent"), 0.5);
    EXPECT_EQ(figure(verdict, "reachable_percent"), figure(grooved().verdict, "reachable_percent"))
        << "what is reachable does not depend on the program";
}

TEST(LeftOut, ByOrderOfTheOperatorTheFinestToolMayStayAway) {
    ReadJob job = without([](const JobChunk& chunk) { return chunk.tool == finest; });
    job.setup.tools = {1, 2, 3};
    const JobVerdict verdict = judged(job, grooved().cell);
    EXPECT_TRUE(verdict.is_positive) << kinds_of(verdict);
    EXPECT_GT(figure(verdict, "not_allowed_percent"), 0.5) << "and the verdict says what that costs";
    EXPECT_LT(figure(verdict, "reachable_percent"), figure(grooved().verdict, "reachable_percent"));
    ASSERT_EQ(verdict.notes.size(), 1U);
    EXPECT_NE(verdict.notes[0].find("tools 1, 2 and 3 alone"), std::string::npos);
}

TEST(LeftOut, WithoutADirectionTheJobIsRefused) {
    const std::size_t directions = grooved().job.setup.access.orientations.size();
    ASSERT_GE(directions, 2U);
    std::size_t refused = 0;
    for (std::size_t d = 0; d < directions; ++d) {
        ReadJob job = without([&](const JobChunk& chunk) { return chunk.orientation == d; });
        job.program->left_out.push_back({std::nullopt, d, "it is not needed"});
        const JobVerdict verdict = judged(job, grooved().cell);
        std::printf("without direction %zu: %s", d + 1, verdict.is_positive ? "verified\n" : kinds_of(verdict).c_str());
        if (kinds_of(verdict).find("given_up: ") != std::string::npos) ++refused;
    }
    EXPECT_GE(refused, 1U) << "the notch is seen from one side only";
}

}  // namespace
}  // namespace qchopper
