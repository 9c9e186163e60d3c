// KRL, the language of KUKA's controllers: main programs.

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/text.h"
#include "base/units.h"
#include "cam/post/dialect_post.h"
#include "cam/post/krl_chunk.h"
#include "cam/post/krl_config.h"
#include "cam/post/krl_signals.h"
#include "cam/post/krl_text.h"
#include "cam/post/post_signals.h"

namespace qchopper {
namespace {

class KrlPost : public DialectPost {
 public:
    KrlPost(const Program& program, const Cell& cell, const std::string& piece)
        : program_(program), machine_(*cell.machine), chunks_(program, cell, piece) {
        check_signals(machine_);
    }

    const char* ending() const override { return ".src"; }

    ProgramLines run(const ProgramOperation& operation, const ProgramRun& run) const override {
        KrlChunks::Stated stated;
        return chunks_.run(operation, run, true, stated);
    }

    ProgramLines chunk(const RunRange& range, const std::string& name, std::size_t order,
                       std::size_t total) const override {
        return chunks_.chunk(range, name, order, total);
    }

    std::vector<ProgramText> main(const MainProgram& main) const override {
        std::vector<ProgramText> files{{main.name + ".src", source(main).bytes()},
                                       {main.name + ".dat", data(main).bytes()}};
        std::ranges::move(krl_config(program_, machine_, names()), std::back_inserter(files));
        return files;
    }

 private:
    const KrlNames& names() const { return chunks_.names(); }

    KrlText source(const MainProgram& main) const {
        KrlText text;
        krl::begin_program(main.name, text);
        text.comment("program " + names().piece);
        text.comment("part " + std::to_string(main.part + 1) + " of " + std::to_string(main.parts));
        krl::watch_stops(names(), text);
        text.line("BAS(#INITMOV,0)");
        text.line("$ADVANCE = 5");
        chunks_.add_axis_speeds(text);
        double angle = 0;
        std::optional<std::size_t> tool;
        for (const CalledChunk& chunk : main.chunks) {
            const ProgramOperation& operation = program_.operations[chunk.range.operation];
            if (!tool) begin(main.question, operation, text);
            if (tool && *tool != operation.tool) stop(text);
            if (tool && *tool != operation.tool) chunks_.add_joint_move(program_.home, angle, text);
            if (!tool || *tool != operation.tool) change_tool(operation.tool, text);
            tool = operation.tool;
            if (operation.table_angle != angle) turn_table(operation.table_angle, text);
            angle = operation.table_angle;
            text.line(chunk.name + "( )");
        }
        end(angle, text);
        return text;
    }

    static KrlText data(const MainProgram& main) {
        KrlText text;
        text.line("&ACCESS RVP");
        text.line("&REL 1");
        text.line("DEFDAT " + main.name);
        text.line("ENDDAT");
        return text;
    }

    void begin(const std::string& question, const ProgramOperation& operation, KrlText& text) const {
        chunks_.add_tool(operation.tool, text);
        if (!question.empty()) krl::ask(names(), {question}, text);
        chunks_.add_joint_move(program_.home, 0, text);
    }

    void change_tool(std::size_t tool, KrlText& text) const {
        if (machine_.program.tool_change_call) {
            text.line(*machine_.program.tool_change_call + "(" + std::to_string(machine_.tools[tool].number) + ")");
        } else {
            krl::ask(names(), krl_tool_questions(machine_.tools[tool]), text);
        }
        chunks_.add_tool(tool, text);
    }

    void turn_table(double angle, KrlText& text) const {
        krl::say(names(), "The table turns to " + fixed(degrees_per_radian * angle, 1) + " degrees.", text);
        chunks_.add_joint_move(program_.home, angle, text);
    }

    void stop(KrlText& text) const {
        stop_spindle(machine_, text);
        stop_extraction(machine_, text);
    }

    void end(double angle, KrlText& text) const {
        stop(text);
        chunks_.add_joint_move(program_.home, angle, text);
        if (angle != 0) chunks_.add_joint_move(program_.home, 0, text);
        text.line("$APO.CDIS = 0.000");
        text.line("$ADVANCE = 3");
        text.line("END");
    }

    const Program& program_;
    const CellMachine& machine_;
    KrlChunks chunks_;
};

}  // namespace

std::unique_ptr<DialectPost> krl_post(const Program& program, const Cell& cell, const std::string& piece) {
    return std::make_unique<KrlPost>(program, cell, piece);
}

}  // namespace qchopper
