// What the readers of all languages have in common: steps, texts and chunks are put down in the order of execution.
//
// A reader derives from it. O(1) a step, but for the map of texts (tests/sim/program).

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "sim/program/parsed_program.h"

namespace qchopper {

class ProgramExecution {
 protected:
    ProgramExecution() { program_.states.emplace_back(); }

    // The lines that follow are those of a chunk, or of the main program between two of them; `place_` and `end_line_`
    // are known.
    void begin_chunk(bool is_main);
    void end_chunk() { program_.chunks.back().end = program_.steps.size(); }
    // A step at `place_` with `state_`.
    ProgramStep& add(StepKind kind);
    // Of an output, input or call that has a name.
    ProgramStep& add_named(StepKind kind, const std::string& name);
    std::uint32_t text(const std::string& words);
    // The words of a comment, of which some are for the replay: "operation roughing", "hole 3", "start from home:
    // free". Others say nothing that is needed, and a hole with another number than 1 to 9999 is another comment.
    void take_comment(std::string_view words);

    // NOLINTBEGIN(readability-identifier-naming): named as private members are
    ParsedProgram program_;
    ModalState state_;
    SourcePlace place_;
    // of the file that is executed
    std::uint32_t end_line_ = 0;
    // NOLINTEND(readability-identifier-naming)

 private:
    std::uint32_t hole_ = 0;  // that the lines drill
    std::map<std::string, std::uint32_t> text_numbers_;
};

}  // namespace qchopper
