// One pass over the lines.

#include "sim/program/program_file.h"
#include "sim/program/rapid_parts.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 32;

class ModuleCut {
 public:
    explicit ModuleCut(const ProgramFile& file) {
        const std::string lower = lower_case(file.name);
        cut_.name = &file.name;
        cut_.stem = lower.substr(0, lower.find('.'));
        if (lower != cut_.stem + ".mod" || !is_program_name(cut_.stem, longest_name)) {
            refuse_line(file.name, 1, "this is no name of a RAPID module");
        }
        cut_.lines = program_lines_of(file);
    }

    RapidModule run() {
        for (const char* head : {"%%%", "  version:1", "  language:english", "%%%"}) {
            if (at_ >= cut_.lines.size() || lower_case(cut_.lines[at_]) != head) {
                refuse_line(*cut_.name, at_ + 1, "the head \"" + std::string(head) + "\" is missing");
            }
            ++at_;
        }
        if (name_behind("module") != cut_.stem) refuse("the name is not that of the file");
        cut_.data = at_;
        while (!begins("proc")) need_more("PROC");
        cut_.procedure = name_behind("proc", true);
        cut_.first = at_;
        cut_.end = find("endproc");
        pass_comments();
        if (begins("trap")) {
            cut_.trap = name_behind("trap");
            cut_.trap_first = at_;
            cut_.trap_end = find("endtrap");
            pass_comments();
        }
        if (!is_word("endmodule")) refuse("ENDMODULE is missing");
        for (++at_; at_ < cut_.lines.size(); ++at_) {
            if (!cut_.lines[at_].empty()) refuse("nothing may stand behind ENDMODULE");
        }
        return std::move(cut_);
    }

 private:
    [[noreturn]] void refuse(const std::string& why) const {
        refuse_line(*cut_.name, std::min(at_, cut_.lines.size()) + 1, why);
    }
    bool begins(std::string_view word) const {
        return at_ < cut_.lines.size() && ProgramLine(cut_.lines[at_], *cut_.name, at_ + 1).takes_word(word);
    }
    bool is_word(std::string_view word) const { return at_ < cut_.lines.size() && lower_case(cut_.lines[at_]) == word; }
    void need_more(const std::string& what) {
        if (++at_ >= cut_.lines.size()) refuse(what + " is missing");
    }
    void pass_comments() {
        while (at_ < cut_.lines.size() && is_rapid_comment(cut_.lines[at_])) ++at_;
    }
    // The name in the line, which is passed.
    std::string name_behind(std::string_view word, bool has_brackets = false) {
        if (at_ >= cut_.lines.size()) refuse(std::string(word) + " is missing");
        ProgramLine line(cut_.lines[at_], *cut_.name, at_ + 1);
        line.need_word(word);
        std::string name = line.word();
        if (!is_program_name(name, longest_name)) line.refuse("a name of at most 32 characters is missing");
        if (has_brackets) line.need('('), line.need(')');
        line.need_end();
        ++at_;
        return name;
    }
    // The line that holds this word alone; the line behind it is next.
    std::size_t find(const char* word) {
        while (!is_word(word)) need_more(word);
        return at_++;
    }

    RapidModule cut_;
    std::size_t at_ = 0;
};

}  // namespace

bool is_rapid_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(' ');
    return first == std::string_view::npos || line[first] == '!';
}

RapidModule read_rapid_module(const ProgramFile& file) {
    return ModuleCut(file).run();
}

}  // namespace qchopper
