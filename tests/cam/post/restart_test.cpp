// Main programs that begin with a later chunk.

#include <gtest/gtest.h>

#include <algorithm>

#include "cam/post/post.h"
#include "tests/cam/program/hand_made.h"

namespace qchopper {
namespace {

using test_programs::Job;
using test_programs::job_in;
using test_programs::program_of;
using test_programs::ready_cell;

std::vector<KeptChunk> kept(const ProgramPart& part, std::size_t first) {
    std::vector<KeptChunk> chunks;
    for (std::size_t i = first; i < part.chunks.size(); ++i) {
        const PostedChunk& chunk = part.chunks[i];
        const std::size_t bytes = std::ranges::find(part.files, chunk.name, &ProgramText::name)->text.size();
        chunks.push_back({chunk.name.substr(0, chunk.name.find('.')), chunk.tool_number, chunk.orientation, bytes});
    }
    return chunks;
}

Job job_of(const std::string& cell) {
    const bool is_gantry = cell == "gantry-3axis.toml";
    Job job = job_in(ready_cell(cell), {250, 200, 150}, is_gantry ? 0 : 25, is_gantry ? 0 : 200);
    if (is_gantry) job.toolpath.operations.pop_back();
    job.cell.machine->program.lines_per_chunk = 250;
    return job;
}

std::size_t place_of(const std::string& text, const std::string& what) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what << " in\n" << text;
    return at;
}

TEST(PostRestart, GoesOnAsTheProgramDoesAfterAQuestionAndWithItsTool) {
    for (const char* cell :
         {"kr60-ha.toml", "kr120-r2500-pro-rotary.toml", "irb6640-185-2.8.toml", "gantry-3axis.toml"}) {
        const Job job = job_of(cell);
        const ProgramPart whole = post_program(program_of(job), job.cell, {7}).at(0);
        ASSERT_GE(whole.chunks.size(), 3U) << cell;
        for (std::size_t first = 1; first < whole.chunks.size(); ++first) {
            const std::vector<KeptChunk> chunks = kept(whole, first);
            const std::vector<ProgramText> files = post_restart(chunks, job.setup, job.cell, {7}, "qc_7_r", 1, 1);
            EXPECT_TRUE(files.at(0).name.starts_with("qc_7_r.")) << cell;
            const std::string& text = files[0].text;
            const std::string& of_whole = whole.files[0].text;
            const bool is_rapid = job.cell.machine->program.dialect == Dialect::rapid;
            const bool is_ngc = job.cell.machine->program.dialect == Dialect::ngc;
            const std::string call = is_rapid ? chunks[0].name + "_run;"
                                     : is_ngc ? "o<" + chunks[0].name + "> call"
                                              : chunks[0].name + "( )";
            EXPECT_EQ(text.substr(place_of(text, call)), of_whole.substr(place_of(of_whole, call))) << cell;
            const bool is_krl = job.cell.machine->program.dialect == Dialect::krl;
            const std::string of_tool = is_krl ? "\"Put tool " : "ASK tool ";
            const std::size_t asked = place_of(text, "the chunks before " + chunks[0].name + " have ended");
            const std::size_t tool = place_of(text, of_tool + std::to_string(chunks[0].tool_number) + " ");
            EXPECT_LT(asked, tool) << cell;
            EXPECT_LT(tool, place_of(text, call)) << cell;
            EXPECT_EQ(text.find(of_tool), tool) << "no tool before that of the chunk";
        }
    }
}

}  // namespace
}  // namespace qchopper
