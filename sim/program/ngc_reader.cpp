// The main program is executed line by line; a call of a chunk executes the chunk's lines at its place. O(bytes), and a
// search among the files for each call.

#include "sim/program/ngc_reader.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "base/text.h"
#include "sim/program/program_execution.h"
#include "sim/program/program_file.h"
#include "sim/program/program_line.h"

namespace qchopper {
namespace {

constexpr std::size_t max_files = 20'000;
constexpr std::size_t longest_name = 32;
constexpr double per_minute = 60;  // s

struct NgcSource {
    const std::string* name = nullptr;
    std::vector<std::string_view> lines;
    std::uint32_t number = 0;  // in ParsedProgram::files
    bool is_executed = false;
};

// The words of one line: codes of G and M, and the other letters with their values.
struct NgcBlock {
    std::array<double, 8> codes{};  // G as they are, M as -1 - code
    std::size_t count = 0;
    std::array<double, 26> value{};
    std::uint32_t given = 0;  // a bit for each letter
    bool has(char letter) const { return (given >> static_cast<unsigned>(letter - 'a') & 1U) != 0; }
    double operator[](char letter) const { return value[static_cast<std::size_t>(letter - 'a')]; }
};

constexpr double m(int code) {
    return -1 - code;
}

constexpr std::uint32_t bits_of(std::string_view letters) {
    std::uint32_t bits = 0;
    for (const char letter : letters) bits |= 1U << static_cast<unsigned>(letter - 'a');
    return bits;
}

constexpr std::array<double, 4> modes{90, 17, 94, 40};  // that every file states

struct OfFile {
    bool has_units = false;
    std::array<bool, modes.size()> has_mode{};
    bool has_offset = false;     // G54
    bool has_length = false;     // G43
    bool has_path_mode = false;  // G61, G64
    bool has_feed = false;
    bool has_moved = false;
};

class NgcExecution : private ProgramExecution {
 public:
    NgcExecution(std::span<const ProgramFile> files, std::string_view main, const std::vector<std::string>& calls);
    ParsedProgram run();

 private:
    using Line = ProgramLine;
    void execute(NgcSource& source, bool is_main);
    void execute_line(const NgcSource& source, std::size_t at, bool is_main);
    static NgcBlock read_block(Line& line);
    void take_block(const NgcBlock& block, Line& line, const NgcSource& source, std::size_t at);
    bool take_mode(const NgcBlock& block, const Line& line);
    bool take_setting(const NgcBlock& block, const Line& line);
    bool take_machine(const NgcBlock& block, const Line& line, const NgcSource& source, std::size_t at);
    void take_rapid(const NgcBlock& block, const Line& line);
    void take_line(const NgcBlock& block, const Line& line);
    void take_tool(const NgcBlock& block, const Line& line);
    void check_before_move(const Line& line) const;
    void read_call(const std::string& name, Line& line, bool is_main);
    void refuse_rounded() const;
    void take_halt(const Line& line, const NgcSource& source, std::size_t at);

    std::map<std::string, NgcSource> sources_;  // by stem
    std::string main_;
    std::vector<std::string> calls_;
    OfFile own_;
    std::array<double, 6> position_{};
    std::uint8_t known_ = 0;  // bits of X, Y, Z that some move has stated
    bool is_rounded_mode_ = false;
    bool has_ended_ = false;  // M2
    std::optional<SourcePlace> rounded_;
};

NgcExecution::NgcExecution(std::span<const ProgramFile> files, std::string_view main,
                           const std::vector<std::string>& calls)
    : main_(lower_case(main)) {
    if (files.size() > max_files) refuse_line(main_, 1, "there are more than 20,000 files");
    for (const std::string& name : calls) calls_.push_back(lower_case(name));
    for (const ProgramFile& file : files) {
        const std::string lower = lower_case(file.name);
        const std::string stem = lower.substr(0, lower.find('.'));
        if (lower != stem + ".ngc" || !is_program_name(stem, longest_name)) {
            refuse_line(file.name, 1, "this is no name of an NGC program");
        }
        NgcSource source{&file.name, program_lines_of(file), static_cast<std::uint32_t>(program_.files.size()), false};
        while (!source.lines.empty() && source.lines.back().empty()) source.lines.pop_back();
        if (!sources_.insert({stem, std::move(source)}).second) refuse_line(file.name, 1, "the file is there twice");
        program_.files.push_back(file.name);
    }
    if (!sources_.contains(main_)) refuse_line(main_ + ".ngc", 1, "the main program is missing");
}

ParsedProgram NgcExecution::run() {
    execute(sources_.at(main_), true);
    for (const auto& [stem, source] : sources_) {
        if (!source.is_executed) refuse_line(*source.name, 1, "the program is never called");
    }
    return std::move(program_);
}

void NgcExecution::execute(NgcSource& source, bool is_main) {
    source.is_executed = true;
    own_ = {};
    place_ = {source.number, 1};
    end_line_ = static_cast<std::uint32_t>(source.lines.size());
    begin_chunk(is_main);
    std::size_t first = 0;
    std::size_t end = source.lines.size();
    if (!is_main) {
        const std::string stem = lower_case(source.name->substr(0, source.name->find('.')));
        const auto is = [&](std::size_t i, const char* word) {
            return i < source.lines.size() && lower_case(source.lines[i]) == "o<" + stem + "> " + word;
        };
        if (!is(0, "sub")) refuse_line(*source.name, 1, "o<" + stem + "> sub is missing");
        if (end < 2 || !is(--end, "endsub"))
            refuse_line(*source.name, source.lines.size(), "the file does not end with endsub");
        first = 1;
    }
    for (std::size_t i = first; i < end; ++i) {
        place_ = {source.number, static_cast<std::uint32_t>(i + 1)};
        if (has_ended_) refuse_line(*source.name, i + 1, "nothing may stand behind M2");
        execute_line(source, i, is_main);
    }
    place_ = {source.number, std::max(1U, end_line_)};
    if (is_main && !has_ended_) refuse_line(*source.name, place_.line, "the file does not end with M2");
    if (!is_main && has_ended_) refuse_line(*source.name, place_.line, "M2 stands in a subprogram");
    if (!is_main && !own_.has_moved) refuse_line(*source.name, place_.line, "the chunk has no move");
    refuse_rounded();
    end_chunk();
}

void NgcExecution::execute_line(const NgcSource& source, std::size_t at, bool is_main) {
    const std::string_view text = source.lines[at];
    if (text.empty()) return;
    if (text.front() == '(') {
        if (text.find(')') != text.size() - 1 || text.find('(', 1) != std::string_view::npos) {
            refuse_line(*source.name, at + 1, "a comment is a line of its own, in one pair of parentheses");
        }
        return take_comment(text.substr(1, text.size() - 2));
    }
    Line line(text, *source.name, at + 1);
    if (line.takes_text("o<")) {
        const std::string name = line.word();
        line.need('>');
        line.need_word("call");
        return read_call(name, line, is_main);
    }
    const NgcBlock block = read_block(line);
    take_block(block, line, source, at);
}

NgcBlock NgcExecution::read_block(Line& line) {
    NgcBlock block;
    while (const char letter = line.letter()) {
        if (letter == 'g' || letter == 'm') {
            if (block.count == block.codes.size()) line.refuse("too many codes stand in one line");
            const double code = line.number(0, 999);
            block.codes[block.count++] = letter == 'g' ? code : -1 - code;
            continue;
        }
        const std::uint32_t bit = bits_of({&letter, 1});
        if ((block.given & bit) != 0) line.refuse(std::string("\"") + letter + "\" stands twice");
        block.given |= bit;
        block.value[static_cast<std::size_t>(letter - 'a')] = line.number(-1e6, 1e6);
    }
    line.need_end();
    if (block.count == 0) line.refuse("this is no line of a program (docs/developer/formats/programs.md)");
    return block;
}

void NgcExecution::take_block(const NgcBlock& block, Line& line, const NgcSource& source, std::size_t at) {
    if (take_mode(block, line)) return;
    if (block.count != 1) {
        if (block.count == 2) line.refuse("these codes do not stand in one line");
        line.refuse("more than one code stands in the line");
    }
    if (block.codes[0] == 0) return take_rapid(block, line);
    if (block.codes[0] == 1) return take_line(block, line);
    if (take_setting(block, line) || take_machine(block, line, source, at)) return;
    const double code = block.codes[0];
    line.refuse((code < 0 ? "M" + significant(-1 - code, 4) : "G" + significant(code, 4)) + " is not known");
}

// G90, G17, G94 and G40, some or all of them.
bool NgcExecution::take_mode(const NgcBlock& block, const Line& line) {
    std::array<bool, modes.size()> found{};
    for (std::size_t i = 0; i < block.count; ++i) {
        const auto mode = std::find(modes.begin(), modes.end(), block.codes[i]);
        if (mode == modes.end()) return false;
        found[static_cast<std::size_t>(mode - modes.begin())] = true;
    }
    if (block.given != 0) line.refuse("modes stand on a line of their own");
    for (std::size_t i = 0; i < modes.size(); ++i) own_.has_mode[i] |= found[i];
    return true;
}

bool NgcExecution::take_setting(const NgcBlock& block, const Line& line) {
    const auto needs = [&](std::string_view letters) {
        if (block.given != bits_of(letters)) line.refuse("other words than these belong to the code");
    };
    const double code = block.codes[0];
    if (code == 21) {
        needs("");
        own_.has_units = true;
    } else if (code == 54) {
        needs("");
        own_.has_offset = true;
    } else if (code == 49) {
        needs("");
        state_.length_register = 0;
        own_.has_length = false;
    } else if (code == 43) {
        needs("h");
        const double tool = block['h'];
        if (!(tool >= 1 && tool <= 9999 && tool == static_cast<std::uint32_t>(tool)))
            line.refuse("H must be 1 to 9999");
        state_.length_register = static_cast<std::uint32_t>(tool);
        own_.has_length = true;
    } else if (code == 61) {
        needs("");
        is_rounded_mode_ = false;
        own_.has_path_mode = true;
    } else if (code == 64) {
        needs("p");
        if (!(block['p'] > 0 && block['p'] <= 10)) line.refuse("P must be above 0 and at most 10 mm");
        is_rounded_mode_ = true;
        state_.rounding = block['p'];
        own_.has_path_mode = true;
    } else if (code == 4) {
        needs("p");
        if (!(block['p'] >= 0 && block['p'] <= 600)) line.refuse("P must be 0 to 600 s");
        add(StepKind::dwell).value = block['p'];
    } else {
        return false;
    }
    return true;
}

bool NgcExecution::take_machine(const NgcBlock& block, const Line& line, const NgcSource& source, std::size_t at) {
    const auto needs = [&](std::string_view letters) {
        if (block.given != bits_of(letters)) line.refuse("other words than these belong to the code");
    };
    const double code = block.codes[0];
    if (code == m(0)) {
        needs("");
        take_halt(line, source, at);
    } else if (code == m(2)) {
        needs("");
        has_ended_ = true;
    } else if (code == m(3)) {
        needs("s");
        if (!(block['s'] > 0 && block['s'] <= 100'000)) line.refuse("S must be above 0 and at most 100,000");
        add(StepKind::spindle).value = block['s'];
    } else if (code == m(5)) {
        needs("");
        add(StepKind::spindle).value = 0;
    } else if (code == m(6)) {
        needs("t");
        take_tool(block, line);
    } else if (code == m(64) || code == m(65)) {
        needs("p");
        if (!(block['p'] >= 0 && block['p'] <= 8192 && block['p'] == static_cast<std::uint32_t>(block['p']))) {
            line.refuse("P must be the number of an output");
        }
        add_named(StepKind::output, std::to_string(static_cast<std::uint32_t>(block['p']))).value =
            code == m(64) ? 1 : 0;
    } else {
        return false;
    }
    return true;
}

void NgcExecution::take_tool(const NgcBlock& block, const Line& line) {
    const double tool = block['t'];
    if (!(tool >= 1 && tool <= 9999 && tool == static_cast<std::uint32_t>(tool))) line.refuse("T must be 1 to 9999");
    state_.tool_number = static_cast<std::uint32_t>(tool);
    state_.length_register = 0;
    own_.has_length = false;
    refuse_rounded();
    add(StepKind::tool_change).number = state_.tool_number;
}

// A comment cannot hold parentheses: brackets stand for them.
void NgcExecution::take_halt(const Line& line, const NgcSource& source, std::size_t at) {
    constexpr std::string_view asks = "(msg, ask ";
    const std::string_view before = at > 0 ? source.lines[at - 1] : std::string_view();
    if (!lower_case(before.substr(0, asks.size())).starts_with(asks) || before.size() < asks.size() + 2) {
        line.refuse("what the operator is asked must stand on the line before: (MSG, ASK text)");
    }
    std::string words(before.substr(asks.size(), before.size() - asks.size() - 1));
    std::replace(words.begin(), words.end(), '[', '(');
    std::replace(words.begin(), words.end(), ']', ')');
    add_named(StepKind::halt, words);
}

void NgcExecution::check_before_move(const Line& line) const {
    if (!own_.has_units) line.refuse("G21 was not stated in this file");
    for (std::size_t i = 0; i < modes.size(); ++i) {
        if (!own_.has_mode[i])
            line.refuse("G" + std::to_string(static_cast<int>(modes[i])) + " was not stated in this file");
    }
    if (!own_.has_offset) line.refuse("G54 was not stated in this file");
    if (!own_.has_length || state_.length_register == 0) {
        line.refuse("G43 H was not stated in this file, or not behind the tool change");
    }
}

void NgcExecution::refuse_rounded() const {
    if (!rounded_) return;
    refuse_line(program_.files[rounded_->file], rounded_->line, "G64 is active where the next move is no G1");
}

// Along Z alone, or along X and Y: a rapid need not be straight.
void NgcExecution::take_rapid(const NgcBlock& block, const Line& line) {
    constexpr double farthest = 5000;
    const bool is_up = block.given == bits_of("z");
    if (!is_up && block.given != bits_of("xy")) line.refuse("G0 moves Z alone, or X and Y");
    check_before_move(line);
    refuse_rounded();
    for (std::size_t i = 0; i < 3; ++i) {
        if ((i == 2) != is_up) continue;
        position_[i] = block["xyz"[i]];
        if (!(position_[i] >= -farthest && position_[i] <= farthest)) line.refuse("a coordinate is beyond 5 m");
        known_ = static_cast<std::uint8_t>(known_ | 1U << i);
    }
    ProgramStep& step = add(StepKind::rapid_move);
    step.values = position_;
    step.given = known_;
    own_.has_moved = true;
}

void NgcExecution::take_line(const NgcBlock& block, const Line& line) {
    constexpr double farthest = 5000;
    constexpr double fastest = 180'000;  // mm/min
    if ((block.given & ~bits_of("f")) != bits_of("xyz"))
        line.refuse("G1 needs X, Y and Z, perhaps F, and nothing else");
    check_before_move(line);
    if (!own_.has_moved) line.refuse("the first move must be a G0");
    if (block.has('f')) {
        if (!(block['f'] > 0 && block['f'] <= fastest)) line.refuse("F must be above 0 and at most 180,000 mm/min");
        state_.feed = block['f'] / per_minute;
        own_.has_feed = true;
    }
    if (!own_.has_feed) line.refuse("F was not stated in this file");
    if (!own_.has_path_mode) line.refuse("G61 or G64 P was not stated in this file");
    for (std::size_t i = 0; i < 3; ++i) {
        position_[i] = block["xyz"[i]];
        if (!(position_[i] >= -farthest && position_[i] <= farthest)) line.refuse("a coordinate is beyond 5 m");
    }
    known_ = 0b111;
    rounded_ = is_rounded_mode_ ? std::optional(place_) : std::nullopt;
    ProgramStep& step = add(StepKind::linear_move);
    step.values = position_;
    step.is_rounded = is_rounded_mode_;
}

void NgcExecution::read_call(const std::string& name, Line& line, bool is_main) {
    const bool has_argument = line.takes('[');
    const double argument = has_argument ? line.number(-1e6, 1e6) : 0;
    if (has_argument) line.need(']');
    line.need_end();
    const auto found = sources_.find(name);
    if (found == sources_.end()) {
        if (std::find(calls_.begin(), calls_.end(), name) == calls_.end()) {
            line.refuse("the program \"" + name + "\" is neither in the job nor named by the cell");
        }
        ProgramStep& step = add_named(StepKind::call, name);
        step.has_argument = has_argument;
        step.value = argument;
        return;
    }
    if (!is_main || has_argument) line.refuse("only the main program calls chunks, and without arguments");
    if (found->second.is_executed) line.refuse("the program \"" + name + "\" is called twice");
    const SourcePlace back = place_;
    const std::uint32_t end_line = end_line_;
    const OfFile own = own_;
    end_chunk();
    refuse_rounded();
    execute(found->second, false);
    own_ = own;
    place_ = back;
    end_line_ = end_line;
    begin_chunk(true);
}

}  // namespace

ParsedProgram read_ngc(std::span<const ProgramFile> files, std::string_view main,
                       const std::vector<std::string>& calls) {
    return NgcExecution(files, main, calls).run();
}

}  // namespace qchopper
