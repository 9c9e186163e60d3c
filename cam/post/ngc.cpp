// RS-274/NGC, as LinuxCNC reads it, for a gantry: one file for the main program, one subprogram for each chunk.
//
// Whole coordinates and feeds. Rapids go along z alone or at the height of home. O(moves).

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "cam/post/chunk_lines.h"
#include "cam/post/dialect_post.h"
#include "cam/post/post_signals.h"

namespace qchopper {
namespace {

constexpr double speed_unit = 0.1;        // mm/s
constexpr double per_minute = 60;         // s
constexpr double largest_feed = 1e6;      // mm/min
constexpr double deviation_unit = 0.001;  // mm, of P
constexpr double no_corner = 0.003;       // mm: so little of a corner needs no bound
constexpr double spindle_ramp_s = 5;      // in which every spindle has its speed

class NgcText : public ProgramLines {
 public:
    NgcText() : ProgramLines("(", ")") {}
    // A comment holds no parentheses: they become brackets.
    void comment(std::string_view words) {
        std::string plain(words);
        std::replace(plain.begin(), plain.end(), '(', '[');
        std::replace(plain.begin(), plain.end(), ')', ']');
        ProgramLines::comment(plain);
    }
};

std::string position(Vec3 tip) {
    return "X" + written_mm("X", tip.x) + " Y" + written_mm("Y", tip.y) + " Z" + written_mm("Z", tip.z);
}

// P of G64 so that the corner is left at most `rounding` before it; infinite where any P does that.
double largest_deviation(Vec3 from, const WrittenMove& at, Vec3 to) {
    const double before = norm(at.tip - from);
    const double behind = norm(to - at.tip);
    const double half = 0.5 * std::min(before, behind);
    if (!(half > 0)) return 0;
    // Of the angle between the moves, halved: round_corner() of the facts on programs.
    const double cosine = 0.5 * norm((1 / behind) * (to - at.tip) - (1 / before) * (at.tip - from));
    const bool is_free = at.rounding >= half || 0.5 * half * cosine < no_corner;
    return is_free ? std::numeric_limits<double>::infinity() : 0.5 * at.rounding * cosine;
}

class NgcPost : public DialectPost {
 public:
    NgcPost(const Program& program, const Cell& cell)
        : program_(program), machine_(*cell.machine), home_(apply_inverse(program.base, cell.machine->start.tip)) {
        check_program();
        check_cell();
    }

    const char* ending() const override { return ".ngc"; }

    ProgramLines run(const ProgramOperation& operation, const ProgramRun& run) const override {
        Stated stated;
        return run_text(operation, run, stated);
    }

    ProgramLines chunk(const RunRange& range, const std::string& name, std::size_t order,
                       std::size_t total) const override;
    std::vector<ProgramText> main(const MainProgram& main) const override;

 private:
    // What is stated until another line changes it; 0: not stated.
    struct Stated {
        double speed = 0;
        double deviation = 0;
        bool is_exact = true;
    };

    void check_program() const;
    void check_cell() const;
    void add_units(NgcText& text) const;
    void add_home(NgcText& text) const;
    void add_rise(NgcText& text) const { text.line("G0 Z" + written_mm("Z", home_.z)); }
    void add_tool(std::size_t tool, NgcText& text) const;
    void add_feed(const std::string& position, double speed, Stated& stated, NgcText& text) const;
    void add_corner(const WrittenMove& move, double deviation, Stated& stated, NgcText& text) const;
    NgcText run_text(const ProgramOperation& operation, const ProgramRun& run, Stated& stated) const;
    void switch_extraction(const std::optional<Signal>& signal, bool is_on, NgcText& text) const;
    void stop(NgcText& text) const;

    const Program& program_;
    const CellMachine& machine_;
    Vec3 home_;  // in setup coordinates
};

void NgcPost::check_program() const {
    for (const ProgramOperation& operation : program_.operations) {
        if (norm(operation.tool_axis - Vec3{0, 0, 1}) < 1e-9) continue;
        throw InputError(InputFault::config,
                         "the program mills along orientation " + std::to_string(operation.orientation + 1) +
                             ", which is tilted, and a program in NGC tilts nothing",
                         "turn the piece so that one orientation suffices, or carve it with a robot");
    }
}

void NgcPost::check_cell() const {
    const Spindle& spindle = machine_.spindle;
    if (!spindle.on && !spindle.speed && !spindle.at_speed && !spindle.off) return;
    throw InputError(InputFault::config,
                     "the cell file names signals of the spindle, and NGC switches it by M3, S and M5",
                     "leave spindle.on, speed, at_speed and off out of the cell file");
}

void NgcPost::add_units(NgcText& text) const {
    text.line("G21");
    text.line("G90 G17 G94 G40");
    text.line("G54");
    text.line("G61");
}

void NgcPost::add_home(NgcText& text) const {
    add_rise(text);
    text.line("G0 X" + written_mm("X", home_.x) + " Y" + written_mm("Y", home_.y));
}

// The change itself, and the length of the tool from the table of the controller, by the number of the tool.
void NgcPost::add_tool(std::size_t tool, NgcText& text) const {
    const std::string number = std::to_string(machine_.tools[tool].number);
    if (machine_.program.tool_change_call) {
        text.line("o<" + *machine_.program.tool_change_call + "> call [" + number + "]");
    } else {
        text.comment("MSG, ASK " + tool_question(machine_.tools[tool]));
        text.line("M0");
    }
    text.line("T" + number + " M6");
    text.line("G43 H" + number);
}

void NgcPost::add_feed(const std::string& where, double speed, Stated& stated, NgcText& text) const {
    const double stepped = rounded_down(speed, speed_unit);
    if (!(stepped > 0)) {
        throw InputError(InputFault::use, "a move at " + significant(speed, 3) + " mm/s is too slow for a program");
    }
    std::string line = "G1 " + where;
    if (stepped != stated.speed) line += " F" + written_number("F", per_minute * stepped, 1, largest_feed);
    stated.speed = stepped;
    text.line(line);
}

// As few changes of P as the corners allow: one that is within a half of what may be stays.
void NgcPost::add_corner(const WrittenMove& move, double deviation, Stated& stated, NgcText& text) const {
    const bool is_exact = move.rounding <= 0 || deviation < deviation_unit;
    if (is_exact) {
        if (!stated.is_exact) text.line("G61");
        stated.is_exact = true;
        return;
    }
    const bool is_kept = stated.deviation > 0 && stated.deviation <= deviation &&
                         (std::isinf(deviation) || 2 * stated.deviation >= deviation);
    if (is_kept && !stated.is_exact) return;
    if (!is_kept) stated.deviation = rounded_down(std::min(deviation, 0.5), deviation_unit);
    stated.is_exact = false;
    text.line("G64 P" + written_number("P", stated.deviation, 3, 100));
}

NgcText NgcPost::run_text(const ProgramOperation&, const ProgramRun& run, Stated& stated) const {
    NgcText text;
    if (run.hole > 0) text.comment("hole " + std::to_string(run.hole));
    if (!stated.is_exact) text.line("G61");
    stated.is_exact = true;
    add_feed(position(run.start), run.link_speed, stated, text);
    const std::vector<WrittenMove> moves = written_moves(run, position);
    Vec3 from = run.start;
    for (std::size_t i = 0; i < moves.size(); ++i) {
        const WrittenMove& move = moves[i];
        const bool is_last = i + 1 == moves.size();
        add_corner(move, is_last ? 0 : largest_deviation(from, move, moves[i + 1].tip), stated, text);
        add_feed(move.position, move.speed, stated, text);
        from = move.tip;
    }
    return text;
}

ProgramLines NgcPost::chunk(const RunRange& range, const std::string& name, std::size_t order,
                            std::size_t total) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    NgcText text;
    text.line("o<" + name + "> sub");
    describe_chunk(program_, machine_, range, order, total, text);
    add_units(text);
    text.line("G43 H" + std::to_string(machine_.tools[operation.tool].number));
    if (machine_.extraction) switch_extraction(machine_.extraction->on, true, text);
    text.line("S" + written_number("S", operation.rpm, 1, 1e6) + " M3");
    text.line("G4 P" + fixed(spindle_ramp_s, 1));
    const Vec3 start = operation.runs[range.first].start;
    add_rise(text);
    text.line("G0 X" + written_mm("X", start.x) + " Y" + written_mm("Y", start.y));
    Stated stated;
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        text.append(run_text(operation, operation.runs[r], stated));
    }
    if (!stated.is_exact) text.line("G61");
    add_rise(text);
    text.line("o<" + name + "> endsub");
    return text;
}

void NgcPost::switch_extraction(const std::optional<Signal>& signal, bool is_on, NgcText& text) const {
    if (!signal) return;
    if (signal->kind == SignalKind::call) return text.line("o<" + signal->target + "> call");
    text.line((is_on ? "M64 P" : "M65 P") + signal->target);
}

void NgcPost::stop(NgcText& text) const {
    text.line("M5");
    if (machine_.extraction) switch_extraction(machine_.extraction->off, false, text);
}

std::vector<ProgramText> NgcPost::main(const MainProgram& main) const {
    NgcText text;
    text.comment("part " + std::to_string(main.part + 1) + " of " + std::to_string(main.parts));
    add_units(text);
    text.line("G49");
    std::optional<std::size_t> tool;
    for (const CalledChunk& chunk : main.chunks) {
        const std::size_t own = program_.operations[chunk.range.operation].tool;
        if (!tool && !main.question.empty()) {
            text.comment("MSG, ASK " + main.question);
            text.line("M0");
        }
        if (tool && *tool != own) {
            stop(text);
            add_home(text);
        }
        if (!tool || *tool != own) {
            add_tool(own, text);
            add_home(text);
        }
        tool = own;
        text.line("o<" + chunk.name + "> call");
    }
    stop(text);
    add_home(text);
    text.line("M2");
    return {{main.name + ".ngc", text.bytes()}};
}

}  // namespace

std::unique_ptr<DialectPost> ngc_post(const Program& program, const Cell& cell, const std::string& /*piece*/) {
    return std::make_unique<NgcPost>(program, cell);
}

}  // namespace qchopper
