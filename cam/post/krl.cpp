// Runs are taken into a chunk while they fit, chunks into a part while they fit; their sizes are those of their text.
// O(moves): the text of a run is made twice, that of the first of a chunk three times.

#include "cam/post/krl.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <optional>

#include "base/text.h"
#include "cam/post/krl_chunk.h"
#include "cam/post/krl_signals.h"
#include "cam/post/krl_text.h"

namespace qchopper {
namespace {

std::string name_of(std::uint32_t piece) {
    return "qc_" + std::to_string(piece);
}

// Names of one piece.
struct Names {
    std::string piece;
    std::size_t parts = 1;
    std::string chunk(std::size_t order) const {
        const std::string number = std::to_string(order + 1);
        return piece + "_" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
    }
    std::string main(std::size_t part) const { return parts == 1 ? piece : piece + "_p" + std::to_string(part + 1); }
};

// The runs of every chunk: as many as fit into its lines and bytes.
std::vector<RunRange> chunk_ranges(const Program& program, const KrlChunks& chunks, const ProgramSettings& settings) {
    constexpr std::size_t max_numbers = 20;  // by which the header of the longest comments may be longer
    const std::size_t max_bytes = settings.memory_bytes / 2;
    std::vector<RunRange> ranges;
    for (std::size_t s = 0; s < program.operations.size(); ++s) {
        const ProgramOperation& operation = program.operations[s];
        std::size_t lines = 0;
        std::size_t bytes = 0;
        for (std::size_t r = 0; r < operation.runs.size(); ++r) {
            KrlChunks::Stated stated;
            const KrlText run = chunks.run(operation, operation.runs[r], true, stated);
            if (r == 0 || lines + run.lines() > settings.lines_per_chunk || bytes + run.bytes().size() > max_bytes) {
                const KrlText alone = chunks.chunk({s, r, 1}, "qc", 0, 1);
                ranges.push_back({s, r, 0});
                lines = alone.lines() - run.lines() + operation.exit.targets.size() + 3;
                bytes = alone.bytes().size() - run.bytes().size() + 100 * (operation.exit.targets.size() + 2) +
                        max_numbers * 8;
            }
            ++ranges.back().count;
            lines += run.lines();
            bytes += run.bytes().size();
        }
    }
    return ranges;
}

struct WrittenChunk {
    RunRange range;
    ProgramText file;
};

// Main programs.
class Mains {
 public:
    Mains(const Program& program, const Cell& cell, const KrlChunks& chunks, const Names& names)
        : program_(program), machine_(*cell.machine), chunks_(chunks), names_(names) {}

    // Of the chunks [first, last).
    KrlText main(std::size_t part, const std::vector<WrittenChunk>& all, std::size_t first, std::size_t last) const {
        KrlText text;
        begin_program(names_.main(part), text);
        text.comment("part " + std::to_string(part + 1) + " of " + std::to_string(names_.parts));
        text.line("BAS(#INITMOV,0)");
        text.line("$ADVANCE = 5");
        chunks_.add_axis_speeds(text);
        double angle = 0;
        std::optional<std::size_t> tool;
        for (std::size_t i = first; i < last; ++i) {
            const ProgramOperation& operation = operation_at(all[i]);
            if (!tool) begin(part, operation, text);
            if (tool && *tool != operation.tool) stop(text);
            if (tool && *tool != operation.tool) chunks_.add_joint_move(program_.home, angle, text);
            if (!tool || *tool != operation.tool) change_tool(operation.tool, text);
            tool = operation.tool;
            if (operation.table_angle != angle) chunks_.add_joint_move(program_.home, operation.table_angle, text);
            angle = operation.table_angle;
            text.line(names_.chunk(i) + "( )");
        }
        end(angle, text);
        return text;
    }

    KrlText data(std::size_t part) const {
        KrlText text;
        text.line("&ACCESS RVP");
        text.line("&REL 1");
        text.line("DEFDAT " + names_.main(part));
        text.line("ENDDAT");
        return text;
    }

 private:
    const ProgramOperation& operation_at(const WrittenChunk& chunk) const {
        return program_.operations[chunk.range.operation];
    }

    void begin(std::size_t part, const ProgramOperation& operation, KrlText& text) const {
        chunks_.add_tool(operation.tool, text);
        if (part > 0) {
            text.comment("ASK part " + std::to_string(part) + " has ended, and this is the same block, not moved");
            text.line("HALT");
        }
        chunks_.add_joint_move(program_.home, 0, text);
    }

    void change_tool(std::size_t tool, KrlText& text) const {
        ask_for_tool(machine_, machine_.tools[tool], text);
        chunks_.add_tool(tool, text);
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
    const KrlChunks& chunks_;
    const Names& names_;
};

// A main program with one more chunk is not larger than this.
constexpr std::size_t bytes_of_main = 2'500;
constexpr std::size_t bytes_per_call = 600;  // with a tool change and a turn of the table

// The first chunk of every part: whole operations, because between them the arm is at home.
std::vector<std::size_t> part_starts(const std::vector<WrittenChunk>& all, std::size_t memory) {
    std::vector<std::size_t> starts;
    std::size_t used = 0;
    for (std::size_t i = 0; i < all.size();) {
        std::size_t own = 0;
        std::size_t next = i;
        for (; next < all.size() && all[next].range.operation == all[i].range.operation; ++next) {
            own += all[next].file.text.size() + bytes_per_call;
        }
        if (own + bytes_of_main > memory) {
            throw InputError(InputFault::config,
                             "the chunks from " + all[i].file.name + " on, " + with_commas(own) +
                                 " bytes, do not fit into the controller's memory of " + with_commas(memory) + " bytes",
                             "raise program.memory_bytes in the cell file if the controller has more");
        }
        if (starts.empty() || used + own > memory) {
            starts.push_back(i);
            used = bytes_of_main;
        }
        used += own;
        i = next;
    }
    return starts;
}

PostedChunk listed(const Program& program, const Cell& cell, const WrittenChunk& chunk, std::size_t order) {
    const ProgramOperation& operation = program.operations[chunk.range.operation];
    PostedChunk posted{chunk.file.name,
                       order,
                       chunk.range.operation,
                       operation.tool,
                       cell.machine->tools[operation.tool].number,
                       operation.orientation,
                       chunk.range.first,
                       chunk.range.count,
                       {}};
    for (std::size_t r = chunk.range.first; r < chunk.range.first + chunk.range.count; ++r) {
        if (operation.runs[r].hole > 0) posted.holes.push_back(operation.runs[r].hole);
    }
    return posted;
}

// Whether the text goes on at `at` with a name of the piece: alone, or with a part or a chunk behind it.
bool is_name_at(const std::string& text, std::size_t at, const std::string& piece) {
    if (text.compare(at, piece.size(), piece) != 0) return false;
    const std::size_t end = at + piece.size();
    return end == text.size() || std::isalnum(static_cast<unsigned char>(text[end])) == 0;
}

}  // namespace

std::string renumbered_name(const std::string& file, std::uint32_t from, std::uint32_t to) {
    const std::string piece = name_of(from);
    return is_name_at(file, 0, piece) ? name_of(to) + file.substr(piece.size()) : file;
}

// Names stand at the beginning of a line, where a chunk is called, and behind DEF and DEFDAT.
std::string renumbered_text(const std::string& text, std::uint32_t from, std::uint32_t to) {
    const std::string piece = name_of(from);
    std::string renumbered;
    renumbered.reserve(text.size());
    for (std::size_t line = 0; line < text.size();) {
        std::size_t at = line;
        for (const std::string_view before : {"DEF ", "DEFDAT "}) {
            if (text.compare(line, before.size(), before) == 0) at = line + before.size();
        }
        const std::size_t end = std::min(text.find('\n', line), text.size() - 1) + 1;
        renumbered.append(text, line, at - line);
        if (is_name_at(text, at, piece)) {
            renumbered += name_of(to);
            at += piece.size();
        }
        renumbered.append(text, at, end - at);
        line = end;
    }
    return renumbered;
}

std::vector<ProgramPart> post_krl(const Program& program, const Cell& cell, const ProgramName& name) {
    assert(cell.machine && !program.operations.empty());
    if (cell.machine->program.dialect != Dialect::krl) throw NoPostYet(cell.machine->program.dialect);
    check_signals(*cell.machine);
    const KrlChunks chunks(program, cell);
    Names names{name_of(name.piece)};
    const std::vector<RunRange> ranges = chunk_ranges(program, chunks, cell.machine->program);
    std::vector<WrittenChunk> all;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const KrlText text = chunks.chunk(ranges[i], names.chunk(i), i, ranges.size());
        all.push_back({ranges[i], {names.chunk(i) + ".src", text.bytes()}});
    }
    std::vector<std::size_t> starts = part_starts(all, cell.machine->program.memory_bytes);
    names.parts = starts.size();
    starts.push_back(all.size());
    const Mains mains(program, cell, chunks, names);
    std::vector<ProgramPart> parts;
    for (std::size_t k = 0; k < names.parts; ++k) {
        ProgramPart part{names.main(k) + ".src", {}, {}};
        part.files.push_back({part.entry, mains.main(k, all, starts[k], starts[k + 1]).bytes()});
        part.files.push_back({names.main(k) + ".dat", mains.data(k).bytes()});
        for (std::size_t i = starts[k]; i < starts[k + 1]; ++i) {
            part.chunks.push_back(listed(program, cell, all[i], i));
            part.files.push_back(std::move(all[i].file));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace qchopper
