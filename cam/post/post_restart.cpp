// The chunks need no program, only what a main program says between them. O(chunks).

#include <algorithm>
#include <cassert>

#include "cam/post/dialect_post.h"
#include "cam/post/post.h"
#include "cam/post/post_signals.h"
#include "cam/program/make_program.h"

namespace qchopper {

std::vector<ProgramText> post_restart(const std::vector<KeptChunk>& chunks, const Setup& setup, const Cell& cell,
                                      const ProgramName& name, const std::string& main, std::size_t part,
                                      std::size_t parts) {
    assert(!chunks.empty());
    const std::vector<CuttingTool>& tools = cell.machine->tools;
    std::vector<OutlinedOperation> operations;
    MainProgram called{main, part - 1, parts, {}, restart_question(chunks.front().name)};
    for (const KeptChunk& chunk : chunks) {
        const auto tool = std::ranges::find(tools, chunk.tool_number, &CuttingTool::number);
        assert(tool != tools.end());
        called.chunks.push_back({chunk.name, {operations.size(), 0, 0}, chunk.bytes});
        operations.push_back({static_cast<std::size_t>(tool - tools.begin()), chunk.orientation});
    }
    const Program program = outlined_program(operations, setup, cell);
    return post_in_dialect(program, cell, piece_name(name))->main(called);
}

}  // namespace qchopper
