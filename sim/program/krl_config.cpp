// The routines of messages are compared line by line with those of the page; those that switch off are read. O(bytes).

#include <algorithm>
#include <array>
#include <span>

#include "sim/program/krl_parts.h"

namespace qchopper {
namespace {

constexpr std::uint32_t max_outputs = 8192;
constexpr double least_retract = 5;  // mm
constexpr double largest_retract = 300;

// Without spaces, in lower case.
constexpr auto lines_of_ask =
    std::to_array<std::string_view>({"declcharasked[]",
                                     "declkrlmsg_tmsg",
                                     "declkrlmsgpar_tpar[3]",
                                     "declkrlmsgdlgsk_tkey[7]",
                                     "declkrlmsgopt_topt",
                                     "declintdialog,answer,i",
                                     R"(msg={modul[]"qchopper",nr1,msg_txt[]""})",
                                     "msg.msg_txt[]=asked[]",
                                     "fori=1to3",
                                     "par[i]={par_type#empty}",
                                     "endfor",
                                     "fori=2to7",
                                     "key[i]={sk_type#empty}",
                                     "endfor",
                                     R"(key[1]={sk_type#value,sk_txt[]"done"})",
                                     "opt={vl_stoptrue,clear_p_resettrue,clear_p_sawfalse,log_to_dbtrue}",
                                     "dialog=set_krldlg(msg,par[],key[],opt)",
                                     "ifdialog<=0then",
                                     "halt",
                                     "endif",
                                     "while(dialog>0)andexists_krldlg(dialog,answer)",
                                     "waitsec0.1",
                                     "endwhile"});

constexpr auto lines_of_say = std::to_array<std::string_view>(
    {"declcharsaid[]", "declkrlmsg_tmsg", "declkrlmsgpar_tpar[3]", "declkrlmsgopt_topt", "declintmessage,i",
     R"(msg={modul[]"qchopper",nr2,msg_txt[]""})", "msg.msg_txt[]=said[]", "fori=1to3", "par[i]={par_type#empty}",
     "endfor", "opt={vl_stopfalse,clear_p_resettrue,clear_p_sawfalse,log_to_dbfalse}",
     "message=set_krlmsg(#notify,msg,par[],opt)"});

std::string without_spaces(std::string_view line) {
    std::string text = lower_case(line);
    std::erase(text, ' ');
    return text;
}

class ModuleReader {
 public:
    ModuleReader(const KrlFile& source, const KrlFile& data, const std::vector<std::string>& calls)
        : source_(source), data_(data), calls_(calls) {
        module_.source = *source.name;
    }

    KrlModule read() {
        read_data();
        read_source();
        return std::move(module_);
    }

 private:
    // A routine: its lines from first to end - 1, without comments.
    struct Body {
        std::vector<std::size_t> lines;  // from 0
        std::size_t end = 0;             // with END, from 0
    };

    ProgramLine line_at(std::size_t at) const { return {source_.lines[at], *source_.name, at + 1}; }

    void read_data() {
        for (std::size_t i = data_.first; i < data_.end; ++i) {
            if (is_krl_comment(data_.lines[i])) continue;
            ProgramLine line(data_.lines[i], *data_.name, i + 1);
            line.need_word("decl");
            line.need_word("global");
            const bool is_frame = line.takes_word("frame");
            if (!is_frame) line.need_word("load");
            const std::string name = line.word();
            if (name.empty() || name.front() == '$') line.refuse("a name is missing");
            if (module_.frames.contains(name) || module_.loads.contains(name)) line.refuse("the name is there twice");
            line.need('=');
            if (is_frame) module_.frames[name] = read_frame(line);
            if (!is_frame) module_.loads[name] = read_load(line);
            line.need_end();
        }
    }

    // The lines from `at` to the next END, or to the last one of the file.
    Body body_from(std::size_t at) const {
        Body body;
        for (; at < source_.end && without_spaces(source_.lines[at]) != "end"; ++at) {
            if (!is_krl_comment(source_.lines[at])) body.lines.push_back(at);
        }
        body.end = at;
        return body;
    }

    void read_source() {
        Body body = body_from(source_.first);
        if (!body.lines.empty()) line_at(body.lines.front()).refuse("a module does nothing when it is started alone");
        while (body.end < source_.end) {
            std::size_t at = body.end + 1;
            while (at < source_.end && is_krl_comment(source_.lines[at])) ++at;
            if (at >= source_.end) line_at(at).refuse("a routine is missing");
            body = body_from(at + 1);
            read_routine(line_at(at), body);
        }
    }

    void read_routine(ProgramLine head, const Body& body) {
        head.need_word("global");
        head.need_word("def");
        const std::string name = head.word();
        if (name.empty() || name.front() == '$') head.refuse("a name is missing");
        if (module_.routines.contains(name)) head.refuse("the routine is there twice");
        head.need('(');
        KrlRoutine routine;
        const std::string argument = head.word();
        if (argument.empty()) {
            routine = read_switching(body);
        } else {
            if (argument != "asked" && argument != "said") head.refuse("no argument of a message");
            routine.kind = argument == "asked" ? KrlRoutineKind::ask : KrlRoutineKind::say;
            for (const char c : {'[', ']', ':'}) head.need(c);
            head.need_word("out");
            compare(body, routine.kind == KrlRoutineKind::ask ? std::span<const std::string_view>(lines_of_ask)
                                                              : lines_of_say);
        }
        head.need(')');
        head.need_end();
        routine.line = body.end + 1;
        module_.routines[name] = std::move(routine);
    }

    void compare(const Body& body, std::span<const std::string_view> wanted) const {
        for (std::size_t i = 0; i < std::max(body.lines.size(), wanted.size()); ++i) {
            const std::size_t at = i < body.lines.size() ? body.lines[i] : body.end;
            if (i < body.lines.size() && i < wanted.size() && without_spaces(source_.lines[at]) == wanted[i]) continue;
            line_at(at).refuse("this is no line of a message (docs/developer/formats/programs.md)");
        }
    }

    KrlRoutine read_switching(const Body& body) const {
        KrlRoutine routine;
        std::size_t at = 0;
        const auto is_next = [&](std::string_view words) {
            return at < body.lines.size() && without_spaces(source_.lines[body.lines[at]]) == words;
        };
        if (is_next("brake")) {
            routine.kind = KrlRoutineKind::fallen;
            ++at;
        }
        for (; at < body.lines.size(); ++at) {
            ProgramLine line = line_at(body.lines[at]);
            const std::string word = line.word();
            if (word == "lin_rel" || word == "loop") break;
            if (word == "$out") {
                const KrlOutput output = read_output(line);
                if (output.is_on) line.refuse("a routine switches off");
                routine.switched_off.insert(std::to_string(output.number));
            } else {
                if (std::ranges::find(calls_, word) == calls_.end()) line.refuse("this is no line of a routine");
                line.need('(');
                line.need(')');
                routine.switched_off.insert(word);
            }
            line.need_end();
        }
        if (routine.kind == KrlRoutineKind::fallen && at < body.lines.size()) {
            read_retract(line_at(body.lines[at]), body.lines[at], routine);
            ++at;
        }
        for (const char* words : {"loop", "halt", "endloop"}) {
            if (!is_next(words)) {
                line_at(at < body.lines.size() ? body.lines[at] : body.end)
                    .refuse("the program must stop here for good: LOOP, HALT, ENDLOOP");
            }
            ++at;
        }
        if (at < body.lines.size()) line_at(body.lines[at]).refuse("this is no line of a routine");
        return routine;
    }

    // {X -50.00} #TOOL
    static void read_retract(ProgramLine line, std::size_t at, KrlRoutine& routine) {
        line.need_word("lin_rel");
        line.need('{');
        const std::string axis = line.word();
        if (axis != "x" && axis != "z") line.refuse("the tool is retracted along X or Z of its frame");
        const double way = line.number(-largest_retract, -least_retract);
        routine.retract = axis == "x" ? Vec3{way, 0, 0} : Vec3{0, 0, way};
        routine.retract_line = at + 1;
        line.need('}');
        line.need('#');
        line.need_word("tool");
        line.need_end();
    }

    const KrlFile& source_;
    const KrlFile& data_;
    const std::vector<std::string>& calls_;
    KrlModule module_;
};

// The name of what the module states; empty: the values stand here.
template <typename Value>
const Value* named(ProgramLine& line, const std::map<std::string, Value>& values) {
    const std::string name = line.word();
    if (name.empty()) return nullptr;
    const auto found = values.find(name);
    if (found == values.end()) line.refuse("\"" + name + "\" is not in the configuration module");
    return &found->second;
}

}  // namespace

KrlModule read_krl_module(const KrlFile& source, const KrlFile& data, const std::vector<std::string>& calls) {
    return ModuleReader(source, data, calls).read();
}

ProgramFrame read_frame(ProgramLine& line, const KrlModule& module) {
    const ProgramFrame* const found = named(line, module.frames);
    return found != nullptr ? *found : read_frame(line);
}

ProgramLoad read_load(ProgramLine& line, const KrlModule& module) {
    const ProgramLoad* const found = named(line, module.loads);
    return found != nullptr ? *found : read_load(line);
}

KrlOutput read_output(ProgramLine& line) {
    KrlOutput output;
    output.number = line.index(1, max_outputs);
    line.need('=');
    const std::string word = line.word();
    if (word != "true" && word != "false") line.refuse("an output is TRUE or FALSE");
    output.is_on = word == "true";
    return output;
}

}  // namespace qchopper
