// The main program is executed line by line; a call of a chunk executes the chunk's lines at its place. O(bytes), and a
// search among the files for each call.

#include "sim/program/krl_reader.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/error.h"
#include "sim/program/krl_parts.h"
#include "sim/program/program_execution.h"

namespace qchopper {
namespace {

constexpr std::size_t max_files = 20'000;
constexpr std::uint32_t max_outputs = 8192;
constexpr int look_ahead_restored = 3;
constexpr std::size_t longest_message = 80;

struct Source {
    KrlFile file;
    std::uint32_t number = 0;  // in ParsedProgram::files
    bool is_executed = false;
};

// Of a comment that begins its line.
std::string_view words_of(std::string_view comment) {
    return comment.starts_with(';') ? comment.substr(1) : std::string_view();
}

class KrlExecution : private ProgramExecution {
 public:
    KrlExecution(std::span<const ProgramFile> files, std::string_view main, const std::vector<std::string>& calls);
    ParsedProgram run();

 private:
    void check_data(const KrlFile& file) const;
    void read_module(const KrlFile& data);
    void read_interrupt(ProgramLine& line);
    void read_message(const KrlRoutine& routine, ProgramLine& line);
    void check_stops(const ProgramLine& line) const;
    void check_routines() const;
    void execute(Source& source, bool is_main);
    void execute_line(const Source& source, std::size_t at, bool is_main);
    void take_external(const ProgramLine& line, const KrlAggregate& target);
    void read_ptp(ProgramLine& line);
    void read_lin(ProgramLine& line);
    bool read_signal(const std::string& name, ProgramLine& line);
    void read_wait(ProgramLine& line);
    void read_init(ProgramLine& line, bool is_main);
    void read_halt(const Source& source, std::size_t at, ProgramLine& line);
    void read_call(const std::string& name, ProgramLine& line, bool is_main);
    void check_before_ptp(const ProgramLine& line) const;
    void refuse_rounded() const;
    void check_before_lin(const ProgramLine& line, const KrlAggregate& target) const;
    void check_end() const;
    void begin(bool is_main);

    std::map<std::string, Source> sources_;  // by stem
    std::string main_;
    std::vector<std::string> calls_;
    KrlModule module_;
    // Of the file that is executed: interrupts that it declares, by number, and which of them are on. Of an interrupt
    // by the stop of a program the input is 0.
    std::map<std::uint32_t, std::uint32_t> declared_;
    std::set<std::uint32_t> watched_;        // inputs
    std::set<std::uint32_t> waited_for_;     // inputs
    std::set<std::string> switched_off_;     // outputs, and programs that the main program calls
    std::optional<std::size_t> asked_step_;  // of the dialog on the line before
    StatedHere stated_;
    std::array<double, 6> pose_{};
    std::optional<double> e1_;
    std::optional<SourcePlace> rounded_;  // the LIN with C_DIS behind which no move stands yet
    bool is_initialised_ = false;
    bool is_main_ = false;           // what is executed is the main program
    bool has_moved_ = false;         // in the chunk that is executed
    bool have_moves_ended_ = false;  // by WAIT SEC 0
    std::optional<SourcePlace> chained_, without_e1_, with_e1_;
    std::uint32_t machine_ = 0;        // of MACHINE_DEF to which bases are chained
    std::uint32_t external_axis_ = 0;  // n of En
};

KrlExecution::KrlExecution(std::span<const ProgramFile> files, std::string_view main,
                           const std::vector<std::string>& calls)
    : main_(lower_case(main)) {
    if (files.size() > max_files) refuse_line(main_, 1, "there are more than 20,000 files");
    for (const std::string& name : calls) calls_.push_back(lower_case(name));
    std::vector<std::string> data;
    std::optional<KrlFile> public_data;
    for (const ProgramFile& file : files) {
        const KrlFile read = read_krl_file(file);
        if (read.is_public) {
            if (public_data) refuse_line(file.name, 1, "there are two configuration modules");
            public_data = read;
        } else if (!read.is_source) {
            check_data(read);
            data.push_back(read.stem);
        }
        if (!read.is_source) continue;
        const auto number = static_cast<std::uint32_t>(program_.files.size());
        if (!sources_.insert({read.stem, {read, number, false}}).second)
            refuse_line(file.name, 1, "the file is there twice");
        program_.files.push_back(file.name);
    }
    if (public_data) read_module(*public_data);
    std::sort(data.begin(), data.end());
    for (std::size_t i = 0; i < data.size(); ++i) {
        if (!sources_.contains(data[i])) refuse_line(data[i] + ".dat", 1, "it belongs to no program");
        if (i > 0 && data[i] == data[i - 1]) refuse_line(data[i] + ".dat", 1, "the file is there twice");
    }
    if (!sources_.contains(main_)) refuse_line(main_ + ".src", 1, "the main program is missing");
}

void KrlExecution::check_data(const KrlFile& file) const {
    for (std::size_t i = file.first; i < file.end; ++i) {
        if (!is_krl_comment(file.lines[i])) refuse_line(*file.name, i + 1, "a .dat holds comments alone");
    }
}

// Its source is not executed.
void KrlExecution::read_module(const KrlFile& data) {
    const auto source = sources_.find(data.stem);
    if (source == sources_.end()) refuse_line(*data.name, 1, "its .src is missing");
    if (data.stem == main_) refuse_line(*data.name, 1, "the main program is no configuration module");
    module_ = read_krl_module(source->second.file, data, calls_);
    for (const auto& [name, routine] : module_.routines) {
        if (sources_.contains(name)) refuse_line(module_.source, routine.line, "\"" + name + "\" is a program too");
        if (routine.retract_line == 0) continue;
        program_.retract = routine.retract;
        program_.retract_place = {source->second.number, static_cast<std::uint32_t>(routine.retract_line)};
    }
    sources_.erase(source);
}

// A program with a module stops spindle and extraction wherever it is stopped itself.
void KrlExecution::check_routines() const {
    if (module_.source.empty()) return;
    for (const auto& [name, routine] : module_.routines) {
        if (routine.kind != KrlRoutineKind::stopped && routine.kind != KrlRoutineKind::fallen) continue;
        for (const std::string& signal : switched_off_) {
            if (routine.switched_off.contains(signal)) continue;
            std::string why = "\"" + name + "\" does not switch off ";
            refuse_line(module_.source, routine.line, why.append(signal));
        }
    }
}

ParsedProgram KrlExecution::run() {
    execute(sources_.at(main_), true);
    for (const auto& [stem, source] : sources_) {
        if (!source.is_executed) refuse_line(*source.file.name, 1, "the program is never called");
    }
    check_end();
    check_routines();
    return std::move(program_);
}

void KrlExecution::begin(bool is_main) {
    stated_ = {};
    asked_step_.reset();
    is_main_ = is_main;
    has_moved_ = false;
    begin_chunk(is_main);
}

void KrlExecution::execute(Source& source, bool is_main) {
    source.is_executed = true;
    declared_.clear();
    watched_.clear();
    waited_for_.clear();
    place_ = {source.number, 0};
    end_line_ = static_cast<std::uint32_t>(source.file.end + 1);
    begin(is_main);
    for (std::size_t i = source.file.first; i < source.file.end; ++i) {
        place_ = {source.number, static_cast<std::uint32_t>(i + 1)};
        if (is_krl_comment(source.file.lines[i])) {
            take_comment(words_of(source.file.lines[i]));
        } else {
            execute_line(source, i, is_main);
        }
    }
    place_ = {source.number, static_cast<std::uint32_t>(source.file.end + 1)};
    if (!is_main && !has_moved_) refuse_line(*source.file.name, place_.line, "the chunk has no move");
    refuse_rounded();
    end_chunk();
}

void KrlExecution::execute_line(const Source& source, std::size_t at, bool is_main) {
    ProgramLine line(source.file.lines[at], *source.file.name, at + 1);
    const std::string name = line.word();
    const auto routine = module_.routines.find(name);
    if (routine != module_.routines.end()) return read_message(routine->second, line);
    asked_step_.reset();
    if (name == "interrupt") return read_interrupt(line);
    if (name == "ptp") return read_ptp(line);
    if (name == "lin") return read_lin(line);
    if (name == "bas") return read_init(line, is_main);
    if (name == "wait") return read_wait(line);
    if (name == "halt") return read_halt(source, at, line);
    if (read_assignment(name, line, module_, state_, stated_)) {
        if (name != "$base" || state_.base_machine == 0) return;
        if (chained_ && machine_ != state_.base_machine) line.refuse("bases are chained to two machines");
        chained_ = place_;
        machine_ = state_.base_machine;
        return;
    }
    if (read_signal(name, line)) return;
    read_call(name, line, is_main);
}

// The number is held against MACHINE_DEF at the end, when both are known.
void KrlExecution::take_external(const ProgramLine& line, const KrlAggregate& target) {
    if (!target.has(KrlComponent::external)) return;
    if (external_axis_ != 0 && external_axis_ != target.external_axis) line.refuse("two external axes are named");
    external_axis_ = target.external_axis;
    e1_ = degree * target[KrlComponent::external];
}

void KrlExecution::check_before_ptp(const ProgramLine& line) const {
    if (!is_initialised_) line.refuse("BAS(#INITMOV,0) must stand before the first move");
    for (std::size_t axis = 0; axis < 6; ++axis) {
        const bool is_known = state_.axis_speed[axis] > 0 && state_.axis_acceleration[axis] > 0;
        const bool is_here = stated_.axis_speed[axis] && stated_.axis_acceleration[axis];
        if (is_known && (is_here || is_main_)) continue;
        line.refuse("$VEL_AXIS or $ACC_AXIS of axis " + std::to_string(axis + 1) + " was not stated in this file");
    }
    if (!stated_.load && !is_main_) line.refuse("$LOAD was not stated in this file");
    check_stops(line);
    refuse_rounded();
}

// The controller cannot round the corner of a LIN to anything but a LIN.
void KrlExecution::refuse_rounded() const {
    if (!rounded_) return;
    refuse_line(program_.files[rounded_->file], rounded_->line, "C_DIS stands where the next move is no LIN");
}

void KrlExecution::read_ptp(ProgramLine& line) {
    const KrlAggregate target = read_aggregate(line);
    line.need_end();
    if ((target.given & ~krl_external) != krl_axes) line.refuse("PTP needs A1 to A6, and E1 on a rotary table");
    check_before_ptp(line);
    if (target.has(KrlComponent::external) && !module_.source.empty() && !is_main_ &&
        !(stated_.table_speed && stated_.table_acceleration)) {
        line.refuse("$VEL_EXTAX or $ACC_EXTAX was not stated in this file");
    }
    (target.has(KrlComponent::external) ? with_e1_ : without_e1_) = place_;
    have_moves_ended_ = false;
    ProgramStep& step = add(StepKind::joint_move);
    for (std::size_t axis = 0; axis < 6; ++axis) step.values[axis] = degree * target.value[axis + 6];
    take_external(line, target);
    step.e1 = e1_;
    stated_.pose = false;
    has_moved_ = true;
}

// Of a program with a module.
void KrlExecution::check_stops(const ProgramLine& line) const {
    if (module_.source.empty()) return;
    if (!watched_.contains(0)) line.refuse("the interrupt for $STOPMESS is not on in this file");
    for (const std::uint32_t input : waited_for_) {
        if (watched_.contains(input)) continue;
        line.refuse("no interrupt for $IN[" + std::to_string(input) + "] is on, which was waited for");
    }
}

void KrlExecution::read_interrupt(ProgramLine& line) {
    if (module_.source.empty()) line.refuse("the configuration module is missing");
    const bool is_declared = line.takes_word("decl");
    const bool is_on = !is_declared && line.takes_word("on");
    if (!is_declared && !is_on) line.need_word("off");
    const std::uint32_t number = line.integer(1, 128);
    if (!is_declared) {
        line.need_end();
        const auto declared = declared_.find(number);
        if (declared == declared_.end()) line.refuse("the interrupt is not declared in this file");
        if (!is_on && !have_moves_ended_)
            line.refuse("the look-ahead would switch it off too early: WAIT SEC 0 is missing");
        is_on ? (void)watched_.insert(declared->second) : (void)watched_.erase(declared->second);
        return;
    }
    line.need_word("when");
    const bool is_stop = line.takes_word("$stopmess");
    if (!is_stop) line.need_word("$in");
    const std::uint32_t input = is_stop ? 0 : line.index(1, max_outputs);
    line.need('=');
    line.need('=');
    line.need_word(is_stop ? "true" : "false");
    line.need_word("do");
    const auto routine = module_.routines.find(line.word());
    const KrlRoutineKind wanted = is_stop ? KrlRoutineKind::stopped : KrlRoutineKind::fallen;
    if (routine == module_.routines.end() || routine->second.kind != wanted) {
        line.refuse("the module has no such routine for this interrupt");
    }
    line.need('(');
    line.need(')');
    line.need_end();
    if (!declared_.insert({number, input}).second) line.refuse("the interrupt is declared twice");
}

// Dialogs one behind the other are one question.
void KrlExecution::read_message(const KrlRoutine& routine, ProgramLine& line) {
    const bool asks = routine.kind == KrlRoutineKind::ask;
    if (!asks && routine.kind != KrlRoutineKind::say) line.refuse("this routine is for an interrupt");
    if (asks && !is_main_) line.refuse("only the main program asks");
    line.need('(');
    line.need('"');
    const std::string words(line.until_quote());
    line.need(')');
    line.need_end();
    if (words.empty() || words.size() > longest_message) line.refuse("a message has 1 to 80 characters");
    if (!asks) return asked_step_.reset();
    if (asked_step_) {
        const std::uint32_t both = text(program_.texts[program_.steps[*asked_step_].text] + " " + words);
        program_.steps[*asked_step_].text = both;
        return;
    }
    const std::uint32_t asked = text(words);
    add(StepKind::halt).text = asked;
    asked_step_ = program_.steps.size() - 1;
}

void KrlExecution::check_before_lin(const ProgramLine& line, const KrlAggregate& target) const {
    check_stops(line);
    if (!has_moved_) line.refuse("the first move must be a PTP");
    if (!stated_.tool || !stated_.base) line.refuse("$TOOL or $BASE was not stated in this file");
    if (!stated_.feed || !stated_.acceleration) line.refuse("$VEL.CP or $ACC.CP was not stated in this file");
    if (!stated_.turn_speed[0] || !stated_.turn_speed[1]) {
        line.refuse("$VEL.ORI1 or $VEL.ORI2 was not stated in this file");
    }
    const std::uint32_t given = target.given & ~krl_external;
    if (given != krl_frame && given != krl_position) line.refuse("LIN needs X, Y, Z, or these and A, B, C");
    if (given == krl_position && target.has(KrlComponent::external)) line.refuse("E1 stands with A, B, C only");
    if (stated_.pose) return;
    if (given != krl_frame) line.refuse("A, B, C must be stated here");
    if (target.has(KrlComponent::external) != (state_.base_machine != 0)) {
        line.refuse("E1 must be stated here on a rotary table, and nowhere else");
    }
}

void KrlExecution::read_lin(ProgramLine& line) {
    const KrlAggregate target = read_aggregate(line);
    const bool is_rounded = line.takes_word("c_dis");
    line.need_end();
    check_before_lin(line, target);
    if (is_rounded && !stated_.rounding) line.refuse("$APO.CDIS was not stated in this file");
    rounded_ = is_rounded ? std::optional(place_) : std::nullopt;
    const bool is_full = (target.given & krl_frame) == krl_frame;
    for (std::size_t i = 0; i < 3; ++i) pose_[i] = target.value[i];
    for (std::size_t i = 3; i < 6 && is_full; ++i) pose_[i] = degree * target.value[i];
    take_external(line, target);
    have_moves_ended_ = false;
    ProgramStep& step = add(StepKind::linear_move);
    step.values = pose_;
    step.e1 = state_.base_machine != 0 ? e1_ : std::nullopt;
    step.is_rounded = is_rounded;
    stated_.pose = true;
}

bool KrlExecution::read_signal(const std::string& name, ProgramLine& line) {
    const bool is_analog = name == "$anout";
    if (!is_analog && name != "$out") return false;
    std::uint32_t number = 0;
    double value = 0;
    if (is_analog) {
        number = line.index(1, 32);
        line.need('=');
        value = line.number(-1, 1);
    } else {
        const KrlOutput output = read_output(line);
        number = output.number;
        value = output.is_on ? 1 : 0;
        if (!output.is_on) switched_off_.insert(std::to_string(number));
    }
    line.need_end();
    ProgramStep& step = add(is_analog ? StepKind::analog_output : StepKind::output);
    step.number = number;
    step.value = value;
    return true;
}

// WAIT SEC 0 holds the look-ahead until the moves before it have ended.
void KrlExecution::read_wait(ProgramLine& line) {
    if (line.takes_word("sec")) {
        line.integer(0, 0);
        line.need_end();
        refuse_rounded();
        have_moves_ended_ = true;
        return;
    }
    line.need_word("for");
    line.need_word("$in");
    const std::uint32_t number = line.index(1, max_outputs);
    line.need_end();
    add(StepKind::wait_input).number = number;
    waited_for_.insert(number);
}

void KrlExecution::read_init(ProgramLine& line, bool is_main) {
    line.need('(');
    line.need('#');
    line.need_word("initmov");
    line.need(',');
    line.integer(0, 0);
    line.need(')');
    line.need_end();
    if (!is_main) line.refuse("BAS stands in the main program only");
    if (is_initialised_) line.refuse("BAS stands twice");
    is_initialised_ = true;
}

void KrlExecution::read_halt(const Source& source, std::size_t at, ProgramLine& line) {
    line.need_end();
    const std::string_view before = at > source.file.first ? source.file.lines[at - 1] : std::string_view();
    if (lower_case(before.substr(0, 5)) != ";ask " || before.size() < 6) {
        line.refuse("what the operator is asked must stand on the line before, after ;ASK");
    }
    const std::uint32_t asked = text(std::string(before.substr(5)));
    add(StepKind::halt).text = asked;
}

void KrlExecution::read_call(const std::string& name, ProgramLine& line, bool is_main) {
    if (name.empty() || name.front() == '$')
        line.refuse("this is no line of a program (docs/developer/formats/programs.md)");
    if (!line.takes('(')) line.refuse("\"" + name + "\" is not known");
    const bool has_argument = !line.takes(')');
    const double argument = has_argument ? line.number(-1e6, 1e6) : 0;
    if (has_argument) line.need(')');
    line.need_end();
    const auto found = sources_.find(name);
    if (found == sources_.end()) {
        if (std::find(calls_.begin(), calls_.end(), name) == calls_.end()) {
            line.refuse("the program \"" + name + "\" is neither in the job nor named by the cell");
        }
        const std::uint32_t called = text(name);
        if (is_main && !has_argument) switched_off_.insert(name);
        ProgramStep& step = add(StepKind::call);
        step.text = called;
        step.has_argument = has_argument;
        step.value = argument;
        return;
    }
    if (!is_main || has_argument) line.refuse("only the main program calls chunks, and without arguments");
    if (found->second.is_executed) line.refuse("the program \"" + name + "\" is called twice");
    const SourcePlace back = place_;
    const std::uint32_t end_line = end_line_;
    const auto declared = declared_;
    const auto watched = watched_;
    end_chunk();
    refuse_rounded();
    execute(found->second, false);
    declared_ = declared;
    watched_ = watched;
    waited_for_.clear();
    place_ = back;
    end_line_ = end_line;
    begin(true);
}

void KrlExecution::check_end() const {
    const Source& main = sources_.at(main_);
    const auto refuse = [&](const std::string& why) { refuse_line(*main.file.name, main.file.end + 1, why); };
    if (state_.look_ahead >= 0 && state_.look_ahead != look_ahead_restored) refuse("$ADVANCE is not restored to 3");
    if (state_.rounding != 0) refuse("$APO.CDIS is not restored to 0");
    if (chained_ && without_e1_) {
        refuse_line(program_.files[without_e1_->file], without_e1_->line, "E1 is missing: the table turns");
    }
    if (chained_ && external_axis_ + 1 != machine_) {
        refuse_line(program_.files[chained_->file], chained_->line, "the machine is not that of the external axis");
    }
    if (with_e1_ && !chained_) {
        refuse_line(program_.files[with_e1_->file], with_e1_->line, "E1 is stated, and no base is chained to a table");
    }
}

}  // namespace

ParsedProgram read_krl(std::span<const ProgramFile> files, std::string_view main,
                       const std::vector<std::string>& calls) {
    return KrlExecution(files, main, calls).run();
}

}  // namespace qchopper
