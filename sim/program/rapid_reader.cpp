// The main procedure is executed line by line; a call of a chunk executes the chunk's lines at its place. O(bytes), and
// a search among the modules for each call.

#include "sim/program/rapid_reader.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "base/units.h"
#include "sim/program/program_execution.h"
#include "sim/program/rapid_parts.h"

namespace qchopper {
namespace {

constexpr std::size_t max_files = 20'000;

struct RapidSource {
    RapidModule module;
    std::uint32_t number = 0;  // in ParsedProgram::files
    bool is_executed = false;
};

template <class T>
struct Named {
    std::string name;
    T value;
};

// What one module has declared and stated itself.
struct OfModule {
    std::optional<Named<RapidSpeed>> speed;
    std::optional<Named<double>> zone;
    std::optional<Named<RapidTarget>> target;
    bool has_configuration = false;  // ConfL\Off
    bool has_override = false;       // VelSet
    bool has_acceleration = false;   // AccSet
    bool has_limit = false;          // PathAccLim
    bool has_speed = false;          // v_tcp
    bool has_zone = false;           // pzone_tcp
    bool has_moved = false;
    bool has_deleted = false;  // IDelete, and no CONNECT behind it
    bool is_bound = false;     // CONNECT stands behind the last IDelete
    std::string waited;        // input of the last WaitDI
};

class RapidExecution : private ProgramExecution {
 public:
    RapidExecution(std::span<const ProgramFile> files, std::string_view main, const std::vector<std::string>& calls);
    ParsedProgram run();

 private:
    using Line = ProgramLine;
    void read_data(const RapidModule& module, bool is_main);
    void read_main_data(const std::string& type, const std::string& name, Line& line);
    void read_chunk_data(const std::string& type, const std::string& name, Line& line);
    void execute(RapidSource& source, bool is_main);
    void execute_line(const std::string& word, Line& line, bool is_main);
    bool read_setting(const std::string& word, Line& line);
    bool read_member(const std::string& word, Line& line);
    bool read_signal(const std::string& word, Line& line);
    bool read_interrupt(const std::string& word, Line& line);
    bool read_message(const std::string& word, Line& line);
    bool read_loading(const std::string& word, Line& line, bool is_main);
    void read_joint_move(Line& line);
    void read_line(Line& line);
    void read_frames(Line& line, const RapidTarget& target);
    void read_call(const std::string& name, Line& line, bool is_main);
    void call_chunk(RapidSource& source);
    void check_trap(const RapidModule& main);
    void refuse_rounded() const;
    std::string name_of(Line& line, const char* what) const;

    std::map<std::string, RapidSource> sources_;  // by stem
    std::map<std::string, std::string> stem_of_;  // by procedure
    std::string main_;
    std::vector<std::string> calls_;
    std::map<std::string, RapidTool> tools_;
    std::map<std::string, RapidWork> works_;
    std::string interrupt_, number_, trap_;  // declared in the main module; empty: none
    OfModule own_;
    bool is_main_ = false;
    double override_ = 1;       // of speeds
    double largest_speed_ = 0;  // mm/s
    bool is_connected_ = false;
    std::string asked_;   // by the TPWrite lines before
    std::string loaded_;  // module; empty: none
    bool is_loaded_executed_ = false;
    std::set<std::string> switched_off_, trapped_;
    std::optional<SourcePlace> rounded_;
};

RapidExecution::RapidExecution(std::span<const ProgramFile> files, std::string_view main,
                               const std::vector<std::string>& calls)
    : main_(lower_case(main)) {
    if (files.size() > max_files) refuse_line(main_, 1, "there are more than 20,000 files");
    for (const std::string& name : calls) calls_.push_back(lower_case(name));
    for (const ProgramFile& file : files) {
        RapidModule module = read_rapid_module(file);
        const std::string stem = module.stem;
        const std::string procedure = module.procedure;
        const auto number = static_cast<std::uint32_t>(program_.files.size());
        if (!stem_of_.insert({procedure, stem}).second) refuse_line(file.name, 1, "its procedure is there twice");
        if (!sources_.insert({stem, {std::move(module), number, false}}).second) {
            refuse_line(file.name, 1, "the file is there twice");
        }
        program_.files.push_back(file.name);
    }
    if (!sources_.contains(main_)) refuse_line(main_ + ".mod", 1, "the main module is missing");
}

ParsedProgram RapidExecution::run() {
    RapidSource& main = sources_.at(main_);
    if (main.module.procedure != "main") refuse_line(*main.module.name, main.module.first, "PROC main() is missing");
    read_data(main.module, true);
    trap_ = main.module.trap;
    check_trap(main.module);
    execute(main, true);
    for (const auto& [stem, source] : sources_) {
        if (!source.is_executed) refuse_line(*source.module.name, 1, "the module is never called");
    }
    const std::size_t end = main.module.end + 1;
    if (is_connected_) refuse_line(*main.module.name, end, "the interrupt is still connected at the end");
    if (!loaded_.empty()) refuse_line(*main.module.name, end, "a module is still loaded at the end");
    for (const std::string& output : switched_off_) {
        if (trap_.empty() || trapped_.contains(output)) continue;
        refuse_line(*main.module.name, main.module.trap_end + 1, "the trap does not switch off " + output);
    }
    return std::move(program_);
}

std::string RapidExecution::name_of(Line& line, const char* what) const {
    std::string name = line.word();
    if (name.empty()) line.refuse(std::string("the name of ") + what + " is missing");
    return name;
}

// TYPE NAME:=VALUE; behind PERS, VAR, LOCAL VAR or LOCAL CONST.
void RapidExecution::read_data(const RapidModule& module, bool is_main) {
    own_ = {};
    for (std::size_t i = module.data; i + 1 < module.first; ++i) {
        if (is_rapid_comment(module.lines[i])) {
            const std::string_view line = module.lines[i];
            if (!is_main && line.starts_with('!')) take_comment(line.substr(1));
            continue;
        }
        Line line(module.lines[i], *module.name, i + 1);
        line.takes_word("local");
        if (!line.takes_word("pers") && !line.takes_word("const")) line.need_word("var");
        const std::string type = line.word();
        const std::string name = name_of(line, "the data");
        is_main ? read_main_data(type, name, line) : read_chunk_data(type, name, line);
        line.need(';');
        line.need_end();
    }
}

void RapidExecution::read_main_data(const std::string& type, const std::string& name, Line& line) {
    const auto is_new = [&](bool inserted) {
        if (!inserted) line.refuse("\"" + name + "\" is declared twice");
    };
    if (type == "tooldata") {
        need_assignment(line);
        is_new(tools_.insert({name, read_tooldata(line)}).second);
    } else if (type == "wobjdata") {
        need_assignment(line);
        is_new(works_.insert({name, read_wobjdata(line)}).second);
    } else if (type == "intnum") {
        is_new(interrupt_.empty());
        interrupt_ = name;
    } else if (type == "num") {
        is_new(number_.empty());
        number_ = name;
    } else {
        line.refuse("data of the type \"" + type + "\" do not stand in a main module");
    }
}

void RapidExecution::read_chunk_data(const std::string& type, const std::string& name, Line& line) {
    const auto is_new = [&](bool is_there) {
        if (is_there) line.refuse("data of the type \"" + type + "\" stand twice");
    };
    need_assignment(line);
    if (type == "speeddata") {
        is_new(own_.speed.has_value());
        own_.speed = {name, read_speeddata(line)};
    } else if (type == "zonedata") {
        is_new(own_.zone.has_value());
        own_.zone = {name, read_zonedata(line)};
    } else if (type == "robtarget") {
        is_new(own_.target.has_value());
        own_.target = {name, read_robtarget(line)};
    } else {
        line.refuse("data of the type \"" + type + "\" do not stand in a chunk");
    }
}

// The trap stops the arm first, switches off, tells why, and ends the program.
void RapidExecution::check_trap(const RapidModule& main) {
    std::size_t statements = 0;
    bool has_ended = false;
    for (std::size_t i = main.trap_first; i < main.trap_end; ++i) {
        if (is_rapid_comment(main.lines[i])) continue;
        Line line(main.lines[i], *main.name, i + 1);
        const std::string word = line.word();
        if (has_ended) line.refuse("nothing may stand behind EXIT");
        if ((statements++ == 0) != (word == "stopmove")) line.refuse("a trap begins with StopMove, once");
        if (word == "setdo") {
            trapped_.insert(name_of(line, "an output"));
            line.need(',');
            line.integer(0, 0);
        } else if (word == "tpwrite") {
            line.need('"');
            line.until_quote();
        } else if (word == "exit") {
            has_ended = true;
        } else if (word != "stopmove") {
            if (std::find(calls_.begin(), calls_.end(), word) == calls_.end()) line.refuse("no line of a trap");
            trapped_.insert(word);
        }
        line.need(';');
        line.need_end();
    }
    if (!main.trap.empty() && !has_ended) refuse_line(*main.name, main.trap_end + 1, "the trap does not end with EXIT");
}

void RapidExecution::execute(RapidSource& source, bool is_main) {
    const RapidModule& module = source.module;
    source.is_executed = true;
    place_ = {source.number, 0};
    end_line_ = static_cast<std::uint32_t>(module.end + 1);
    begin_chunk(is_main);
    is_main_ = is_main;
    if (!is_main) {
        if (!module.trap.empty()) refuse_line(*module.name, module.trap_first, "a trap stands in the main module only");
        place_.line = static_cast<std::uint32_t>(module.data);
        read_data(module, false);
    }
    for (std::size_t i = module.first; i < module.end; ++i) {
        place_ = {source.number, static_cast<std::uint32_t>(i + 1)};
        const std::string_view text = module.lines[i];
        if (is_rapid_comment(text)) {
            if (text.starts_with('!')) take_comment(text.substr(1));
            continue;
        }
        Line line(text, *module.name, i + 1);
        execute_line(line.word(), line, is_main);
    }
    place_ = {source.number, static_cast<std::uint32_t>(module.end + 1)};
    if (!is_main && !own_.has_moved) refuse_line(*module.name, place_.line, "the chunk has no move");
    refuse_rounded();
    end_chunk();
}

void RapidExecution::execute_line(const std::string& word, Line& line, bool is_main) {
    if (word == "movel") return read_line(line);
    if (read_message(word, line)) return;
    asked_.clear();
    if (word == "moveabsj") return read_joint_move(line);
    if (read_member(word, line) || read_setting(word, line) || read_signal(word, line) || read_interrupt(word, line) ||
        read_loading(word, line, is_main)) {
        line.need(';');
        return line.need_end();
    }
    read_call(word, line, is_main);
}

// v.v_tcp and z.pzone_tcp of the module's own data.
bool RapidExecution::read_member(const std::string& word, Line& line) {
    if (own_.speed && word == own_.speed->name) {
        line.need('.');
        line.need_word("v_tcp");
        need_assignment(line);
        own_.speed->value.tcp = line.number(0.1, 3000);
        own_.has_speed = true;
        return true;
    }
    if (!own_.zone || word != own_.zone->name) return false;
    line.need('.');
    line.need_word("pzone_tcp");
    need_assignment(line);
    own_.zone->value = line.number(0, 1000);
    own_.has_zone = true;
    return true;
}

bool RapidExecution::read_setting(const std::string& word, Line& line) {
    if (word == "confl") {
        line.need('\\');
        line.need_word("off");
        own_.has_configuration = true;
    } else if (word == "velset") {
        override_ = line.number(1, 100) / 100;
        line.need(',');
        largest_speed_ = line.number(1, 5000);
        state_.axis_speed.fill(override_);
        own_.has_override = true;
    } else if (word == "accset") {
        state_.axis_acceleration.fill(line.number(20, 100) / 100);
        line.need(',');
        line.number(10, 100);
        own_.has_acceleration = true;
    } else if (word == "pathacclim") {
        double least = 1e9;
        for (const char* limit : {"accmax", "decelmax"}) {
            if (least < 1e9) line.need(',');
            line.need_word("true");
            line.need('\\');
            line.need_word(limit);
            need_assignment(line);
            const double value = line.number(0.1, 20);
            if (least < 1e9 && value != least) line.refuse("AccMax and DecelMax differ");
            least = value;
        }
        state_.acceleration = 1000 * least;
        own_.has_limit = true;
    } else {
        return false;
    }
    return true;
}

bool RapidExecution::read_signal(const std::string& word, Line& line) {
    if (word != "setdo" && word != "setao" && word != "waitdi") return false;
    const std::string name = name_of(line, "a signal");
    line.need(',');
    if (word == "waitdi") {
        line.integer(1, 1);
        own_.waited = name;
        add_named(StepKind::wait_input, name);
        return true;
    }
    const bool is_analog = word == "setao";
    const double value = is_analog ? line.number(-1e6, 1e6) : line.integer(0, 1);
    if (!is_analog && value == 0) {
        if (is_connected_)
            line.refuse("an output is switched off while the interrupt is connected: IDelete is missing");
        if (is_main_) switched_off_.insert(name);
    }
    add_named(is_analog ? StepKind::analog_output : StepKind::output, name).value = value;
    return true;
}

bool RapidExecution::read_interrupt(const std::string& word, Line& line) {
    if (word != "idelete" && word != "connect" && word != "isignaldi") return false;
    if (trap_.empty() || interrupt_.empty()) line.refuse("the main module declares no interrupt and no trap for it");
    if (word == "isignaldi") {
        line.need('\\');
        line.need_word("single");
        line.need(',');
        if (own_.waited.empty() || line.word() != own_.waited)
            line.refuse("the signal is not that which was waited for");
        line.need(',');
        line.integer(0, 0);
        line.need(',');
    }
    if (line.word() != interrupt_) line.refuse("the interrupt is not that of the main module");
    if (word == "connect") {
        line.need_word("with");
        if (line.word() != trap_) line.refuse("the trap is not that of the main module");
        if (!own_.has_deleted) line.refuse("IDelete must stand before CONNECT");
    }
    if (word == "isignaldi" && !own_.is_bound) line.refuse("CONNECT must stand before ISignalDI");
    if (word == "idelete") own_.has_deleted = true;
    if (word == "connect") own_.has_deleted = false;
    own_.is_bound = word == "connect";
    is_connected_ = word == "isignaldi";
    return true;
}

bool RapidExecution::read_message(const std::string& word, Line& line) {
    if (word != "tpwrite" && word != "tpreadfk") return false;
    if (word == "tpwrite") {
        line.need('"');
        asked_ += (asked_.empty() ? "" : " ") + std::string(line.until_quote());
    } else {
        if (number_.empty() || line.word() != number_) line.refuse("the answer is no num of the main module");
        line.need(',');
        line.need('"');
        line.until_quote();
        for (int i = 0; i < 4; ++i) line.need(','), line.need_word("stempty");
        line.need(',');
        line.need('"');
        line.until_quote();
        if (!asked_.starts_with("ASK ") || asked_.size() < 5) {
            line.refuse("what the operator is asked must stand on the lines before, in TPWrite, after ASK");
        }
        if (is_connected_) line.refuse("the operator is asked while the interrupt is connected: IDelete is missing");
        add_named(StepKind::halt, asked_.substr(4));
        asked_.clear();
    }
    line.need(';');
    line.need_end();
    return true;
}

bool RapidExecution::read_loading(const std::string& word, Line& line, bool is_main) {
    const bool is_call = word.empty() && line.takes('%');
    if (word != "load" && word != "unload" && !is_call) return false;
    if (!is_main) line.refuse("only the main program loads and calls modules");
    if (word == "load") {
        line.need('\\');
        line.need_word("dynamic");
        line.need(',');
    }
    line.need('"');
    const std::string quoted = lower_case(line.until_quote());
    if (is_call) {
        line.need('%');
        const auto found = stem_of_.find(quoted);
        if (found == stem_of_.end() || found->second != loaded_) line.refuse("\"" + quoted + "\" is not loaded");
        call_chunk(sources_.at(loaded_));
        is_loaded_executed_ = true;
        return true;
    }
    constexpr std::string_view before = "home:/";
    const std::string stem =
        quoted.starts_with(before) ? quoted.substr(before.size(), quoted.find('.') - before.size()) : "";
    if (quoted != std::string(before) + stem + ".mod") line.refuse("a module is \"HOME:/NAME.mod\"");
    if (word == "load") {
        if (!loaded_.empty()) line.refuse("another module is still loaded");
        if (!sources_.contains(stem)) line.refuse("the module \"" + stem + "\" is missing");
        loaded_ = stem;
        is_loaded_executed_ = false;
    } else {
        if (stem != loaded_) line.refuse("the module is not loaded");
        if (!is_loaded_executed_) line.refuse("the module was not called");
        loaded_.clear();
    }
    return true;
}

// \WObj:=NAME; behind the tool.
void RapidExecution::read_frames(Line& line, const RapidTarget& target) {
    const auto tool = tools_.find(name_of(line, "a tool"));
    if (tool == tools_.end()) line.refuse("the tool is not declared in the main module");
    line.need('\\');
    line.need_word("wobj");
    need_assignment(line);
    const auto work = works_.find(name_of(line, "a work object"));
    if (work == works_.end()) line.refuse("the work object is not declared in the main module");
    line.need(';');
    line.need_end();
    if (target.external_axis != work->second.unit) {
        line.refuse("the external axis must be given on a table, it alone, and nowhere else");
    }
    state_.tool = tool->second.frame;
    state_.load = tool->second.load;
    state_.base = work->second.base;
    state_.base_machine = work->second.unit == 0 ? 0 : work->second.unit + 1;
}

void RapidExecution::refuse_rounded() const {
    if (!rounded_) return;
    refuse_line(program_.files[rounded_->file], rounded_->line, "a zone stands where the next move is no MoveL");
}

void RapidExecution::read_joint_move(Line& line) {
    RapidTarget external;
    const std::array<double, 6> joints = read_jointtarget(line, external);
    for (const char* word : {"vmax", "fine"}) line.need(','), line.need_word(word);
    line.need(',');
    read_frames(line, external);
    if (!own_.has_override || !own_.has_acceleration) line.refuse("VelSet or AccSet was not stated in this file");
    if (!own_.has_configuration) line.refuse("ConfL\\Off was not stated in this file");
    refuse_rounded();
    ProgramStep& step = add(StepKind::joint_move);
    step.values = joints;
    if (external.external_axis != 0) step.e1 = external.external;
    own_.has_moved = true;
}

void RapidExecution::read_line(Line& line) {
    asked_.clear();
    if (!own_.target || !own_.speed || !own_.zone)
        line.refuse("robtarget, speeddata or zonedata is missing in this file");
    RapidTarget target = own_.target->value;
    if (line.takes_word("offs")) {
        line.need('(');
        if (line.word() != own_.target->name) line.refuse("the robtarget is not that of this file");
        for (int i = 0; i < 3; ++i) {
            line.need(',');
            target.point[i] += line.number(-5000, 5000);
        }
        line.need(')');
    } else {
        target = read_robtarget(line);
    }
    line.need(',');
    if (line.word() != own_.speed->name) line.refuse("the speeddata is not that of this file");
    line.need(',');
    const std::string zone = line.word();
    if (zone != "fine" && zone != own_.zone->name) line.refuse("the zone is neither fine nor that of this file");
    line.need(',');
    read_frames(line, target);
    if (!own_.has_moved) line.refuse("the first move must be a MoveAbsJ");
    if (!own_.has_speed || !own_.has_limit) line.refuse("v_tcp or PathAccLim was not stated in this file");
    if (zone != "fine" && !own_.has_zone) line.refuse("pzone_tcp was not stated in this file");
    if (!trap_.empty() && !is_connected_) line.refuse("the trap of the main module is not connected");
    rounded_ = zone != "fine" ? std::optional(place_) : std::nullopt;
    state_.feed = std::min(largest_speed_, override_ * own_.speed->value.tcp);
    state_.turn_speed.fill(override_ * own_.speed->value.turn);
    state_.rounding = own_.zone->value;
    ProgramStep& step = add(StepKind::linear_move);
    step.values = {target.point.x, target.point.y, target.point.z, target.abc.x, target.abc.y, target.abc.z};
    if (target.external_axis != 0) step.e1 = target.external;
    step.is_rounded = rounded_.has_value();
}

void RapidExecution::call_chunk(RapidSource& source) {
    if (source.is_executed) refuse_line(program_.files[place_.file], place_.line, "a module is called twice");
    const SourcePlace back = place_;
    const std::uint32_t end_line = end_line_;
    const OfModule own = std::move(own_);
    end_chunk();
    refuse_rounded();
    is_connected_ = false;  // a chunk may be started alone
    execute(source, false);
    own_ = own;
    is_main_ = true;
    place_ = back;
    end_line_ = end_line;
    begin_chunk(true);
}

void RapidExecution::read_call(const std::string& name, Line& line, bool is_main) {
    if (name.empty()) line.refuse("this is no line of a program (docs/developer/formats/programs.md)");
    const bool has_argument = !line.takes(';');
    const auto found = stem_of_.find(name);
    const bool is_known = found != stem_of_.end() || std::find(calls_.begin(), calls_.end(), name) != calls_.end();
    if (!is_known) line.refuse("\"" + name + "\" is neither a word of a program, in the job nor named by the cell");
    const double argument = has_argument ? line.number(-1e6, 1e6) : 0;
    if (has_argument) line.need(';');
    line.need_end();
    if (found != stem_of_.end()) {
        if (!is_main || has_argument || found->second == main_) {
            line.refuse("only the main program calls chunks, and without arguments");
        }
        return call_chunk(sources_.at(found->second));
    }
    ProgramStep& step = add_named(StepKind::call, name);
    step.has_argument = has_argument;
    step.value = argument;
}

}  // namespace

ParsedProgram read_rapid(std::span<const ProgramFile> files, std::string_view main,
                         const std::vector<std::string>& calls) {
    return RapidExecution(files, main, calls).run();
}

}  // namespace qchopper
