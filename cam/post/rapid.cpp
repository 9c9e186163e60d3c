// RAPID, the language of ABB's controllers: main modules. O(chunks).

#include <optional>

#include "base/text.h"
#include "cam/post/dialect_post.h"
#include "cam/post/post_signals.h"
#include "cam/post/rapid_chunk.h"
#include "cam/post/rapid_text.h"

namespace qchopper {
namespace {

class RapidPost : public DialectPost {
 public:
    RapidPost(const Program& program, const Cell& cell, const std::string& piece)
        : program_(program), machine_(*cell.machine), chunks_(program, cell, piece) {
        check_signals(machine_);
    }

    const char* ending() const override { return ".mod"; }
    bool loads_chunks() const override { return true; }

    ProgramLines run(const ProgramOperation& operation, const ProgramRun& run) const override {
        RapidChunks::Stated stated;
        return chunks_.run(operation, run, stated);
    }

    ProgramLines chunk(const RunRange& range, const std::string& name, std::size_t order,
                       std::size_t total) const override {
        return chunks_.chunk(range, name, order, total);
    }

    std::vector<ProgramText> main(const MainProgram& main) const override {
        RapidText text;
        rapid::begin_module(main.name, text);
        text.comment("part " + std::to_string(main.part + 1) + " of " + std::to_string(main.parts));
        add_data(main, text);
        add_main(main, text);
        if (machine_.spindle.at_speed->kind != SignalKind::call) add_trap(text);
        text.line("ENDMODULE");
        return {{main.name + ".mod", text.bytes()}};
    }

 private:
    const RapidNames& names() const { return chunks_.names(); }

    // Tools and work object stand once: what is measured is entered here.
    void add_data(const MainProgram& main, RapidText& text) const {
        std::vector<bool> is_used(program_.tools.size(), false);
        for (const CalledChunk& chunk : main.chunks) is_used[operation_of(chunk).tool] = true;
        for (std::size_t t = 0; t < is_used.size(); ++t) {
            if (is_used[t]) add_tool(t, text);
        }
        const std::string nowhere = rapid::frame(Pose{});
        const std::string base = rapid::frame(program_.base);
        text.line("PERS wobjdata " + names().work_object() + ":=[FALSE," +
                  (program_.external_axis
                       ? "FALSE,\"STN" + std::to_string(*program_.external_axis) + "\"," + nowhere + "," + base
                       : "TRUE,\"\"," + base + "," + nowhere) +
                  "];");
        text.line("VAR intnum " + names().interrupt() + ";");
        text.line("LOCAL VAR num k;");
    }

    void add_tool(std::size_t tool, RapidText& text) const {
        constexpr double max_kg = 10'000;
        const ProgramTool& own = program_.tools[tool];
        const auto kg = [](double value) { return written_number("load", value, 4, max_kg); };
        const Vec3 inertia = own.load.inertia_kg_m2;
        text.line("PERS tooldata " + names().tool(machine_.tools[tool].number) + ":=[TRUE," +
                  rapid::frame(own.tool_in_flange) + ",[" + kg(own.load.mass_kg) + ",[" +
                  rapid::position(own.load.centre_in_flange.shift, 3) + "]," +
                  rapid::quaternion(own.load.centre_in_flange) + "," + kg(inertia.x) + "," + kg(inertia.y) + "," +
                  kg(inertia.z) + "]];");
    }

    const ProgramOperation& operation_of(const CalledChunk& chunk) const {
        return program_.operations[chunk.range.operation];
    }

    void add_main(const MainProgram& main, RapidText& text) const {
        std::size_t bytes = text.bytes().size();
        for (const CalledChunk& chunk : main.chunks) bytes += chunk.bytes;
        const bool is_loaded = bytes > machine_.program.memory_bytes;
        text.line("PROC main()");
        text.line("ConfL\\Off;");
        chunks_.add_joint_speeds(text);
        double angle = 0;
        std::optional<std::size_t> tool;
        for (const CalledChunk& chunk : main.chunks) {
            const ProgramOperation& operation = operation_of(chunk);
            if (!tool && !main.question.empty()) rapid::ask(main.question, "k", text);
            if (!tool) chunks_.add_joint_move(operation.tool, program_.home, 0, text);
            if (tool && *tool != operation.tool) stop(text);
            if (tool && *tool != operation.tool) chunks_.add_joint_move(*tool, program_.home, angle, text);
            if (!tool || *tool != operation.tool) change_tool(operation.tool, text);
            tool = operation.tool;
            if (operation.table_angle != angle) {
                chunks_.add_joint_move(*tool, program_.home, operation.table_angle, text);
            }
            angle = operation.table_angle;
            call(chunk.name, is_loaded, text);
        }
        stop(text);
        chunks_.add_joint_move(*tool, program_.home, angle, text);
        if (angle != 0) chunks_.add_joint_move(*tool, program_.home, 0, text);
        text.line("ENDPROC");
    }

    static void call(const std::string& chunk, bool is_loaded, RapidText& text) {
        const std::string file = "\"HOME:/" + chunk + ".mod\";";
        if (!is_loaded) return text.line(rapid_procedure(chunk) + ";");
        text.line("Load\\Dynamic," + file);
        text.line("%\"" + rapid_procedure(chunk) + "\"%;");
        text.line("UnLoad " + file);
    }

    void change_tool(std::size_t tool, RapidText& text) const {
        const CuttingTool& next = machine_.tools[tool];
        if (machine_.program.tool_change_call) {
            return text.line(*machine_.program.tool_change_call + " " + std::to_string(next.number) + ";");
        }
        rapid::ask(tool_question(next), "k", text);
    }

    void switch_off(RapidText& text) const {
        rapid::switch_signal(machine_.spindle.off ? machine_.spindle.off : machine_.spindle.on, false, text);
        if (machine_.extraction) rapid::switch_signal(machine_.extraction->off, false, text);
    }

    void stop(RapidText& text) const {
        if (machine_.spindle.at_speed->kind != SignalKind::call) text.line("IDelete " + names().interrupt() + ";");
        switch_off(text);
    }

    void add_trap(RapidText& text) const {
        text.line("TRAP " + names().trap());
        text.line("StopMove;");
        switch_off(text);
        text.line("TPWrite \"The spindle has lost its speed: the program ends. Look at the spindle,\";");
        text.line("TPWrite \"move the arm out of the foam by hand, and start the chunk again.\";");
        text.line("EXIT;");
        text.line("ENDTRAP");
    }

    const Program& program_;
    const CellMachine& machine_;
    RapidChunks chunks_;
};

}  // namespace

std::unique_ptr<DialectPost> rapid_post(const Program& program, const Cell& cell, const std::string& piece) {
    return std::make_unique<RapidPost>(program, cell, piece);
}

}  // namespace qchopper
