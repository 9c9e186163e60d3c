// Runs are taken into a chunk while they fit, chunks into a part while they fit; their sizes are those of their text.
// O(moves): the text of a run is made twice, that of the first of a chunk three times.

#include "cam/post/post.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <memory>
#include <string_view>

#include "base/error.h"
#include "base/hex.h"
#include "base/text.h"
#include "cam/post/dialect_post.h"
#include "cam/post/post_signals.h"

namespace qchopper {
namespace {

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
std::vector<RunRange> chunk_ranges(const Program& program, const DialectPost& post, const ProgramSettings& settings) {
    constexpr std::size_t max_numbers = 20;  // by which the header of the longest comments may be longer
    const std::size_t max_bytes = settings.memory_bytes / 2;
    std::vector<RunRange> ranges;
    for (std::size_t s = 0; s < program.operations.size(); ++s) {
        const ProgramOperation& operation = program.operations[s];
        std::size_t lines = 0;
        std::size_t bytes = 0;
        for (std::size_t r = 0; r < operation.runs.size(); ++r) {
            const ProgramLines run = post.run(operation, operation.runs[r]);
            if (r == 0 || lines + run.lines() > settings.lines_per_chunk || bytes + run.bytes().size() > max_bytes) {
                const ProgramLines alone = post.chunk({s, r, 1}, "qc", 0, 1);
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
    CalledChunk chunk;
    ProgramText file;
};

// A main program with its configuration module and one more chunk is not larger than this.
constexpr std::size_t bytes_of_main = 6'500;
constexpr std::size_t bytes_per_call = 600;  // with a tool change and a turn of the table

// The first chunk of every part: whole operations, because between them the arm is at home.
std::vector<std::size_t> part_starts(const std::vector<WrittenChunk>& all, std::size_t memory) {
    std::vector<std::size_t> starts;
    std::size_t used = 0;
    for (std::size_t i = 0; i < all.size();) {
        std::size_t own = 0;
        std::size_t next = i;
        for (; next < all.size() && all[next].chunk.range.operation == all[i].chunk.range.operation; ++next) {
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
    const ProgramOperation& operation = program.operations[chunk.chunk.range.operation];
    PostedChunk posted{chunk.file.name,
                       order,
                       chunk.chunk.range.operation,
                       operation.tool,
                       cell.machine->tools[operation.tool].number,
                       operation.orientation,
                       chunk.chunk.range.first,
                       chunk.chunk.range.count,
                       {}};
    for (std::size_t r = chunk.chunk.range.first; r < chunk.chunk.range.first + chunk.chunk.range.count; ++r) {
        if (operation.runs[r].hole > 0) posted.holes.push_back(operation.runs[r].hole);
    }
    return posted;
}

bool is_of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Where in a line the words begin that people read: comments and messages, in any of the languages. The comment that
// states the name of the program counts as a line of it.
std::size_t words_for_people(std::string_view line) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string_view::npos) return line.size();
    const std::string_view text = line.substr(first);
    if (text.starts_with(";program ")) return line.size();
    if (text.starts_with(';') || text.starts_with('!') || text.starts_with('(') || text.starts_with("TPWrite "))
        return 0;
    const std::size_t quote = line.find("(\"");
    const bool is_message = quote != std::string_view::npos &&
                            (line.substr(0, quote).ends_with("_ask") || line.substr(0, quote).ends_with("_say"));
    return is_message ? quote : line.size();
}

// Whether the text goes on at `at` with a name of the piece: alone, or with a part or a chunk behind it.
bool is_name_at(const std::string& text, std::size_t at, const std::string& piece) {
    if (text.compare(at, piece.size(), piece) != 0) return false;
    const std::size_t end = at + piece.size();
    return end == text.size() || std::isalnum(static_cast<unsigned char>(text[end])) == 0;
}

struct DialectRow {
    Dialect dialect;
    std::unique_ptr<DialectPost> (*make)(const Program&, const Cell&, const std::string&);
};

constexpr std::array<DialectRow, 3> dialects{
    {{Dialect::krl, krl_post}, {Dialect::rapid, rapid_post}, {Dialect::ngc, ngc_post}}};

}  // namespace

std::string order_in_names(const Uuid& project_id) {
    constexpr std::size_t digits = 6;
    return to_hex(project_id).substr(0, digits);
}

std::string piece_name(const ProgramName& name) {
    return "qc_" + (name.order.empty() ? "" : name.order + "_") + std::to_string(name.piece);
}

std::unique_ptr<DialectPost> post_in_dialect(const Program& program, const Cell& cell, const std::string& piece) {
    const auto row = std::ranges::find(dialects, cell.machine->program.dialect, &DialectRow::dialect);
    return row->make(program, cell, piece);
}

std::string renamed_file(const std::string& file, const ProgramName& from, const ProgramName& to) {
    const std::string piece = piece_name(from);
    return is_name_at(file, 0, piece) ? piece_name(to) + file.substr(piece.size()) : file;
}

// Everywhere but in comments and in what the operator reads.
std::string renamed_text(const std::string& text, const ProgramName& from, const ProgramName& to) {
    const std::string piece = piece_name(from);
    const std::string other = piece_name(to);
    std::string renamed;
    renamed.reserve(text.size());
    for (std::size_t line = 0; line < text.size();) {
        const std::size_t end = std::min(text.find('\n', line), text.size() - 1) + 1;
        std::size_t at = line;
        const std::size_t words = line + words_for_people(std::string_view(text).substr(line, end - line));
        for (std::size_t found = text.find(piece, at); found < words; found = text.find(piece, at)) {
            const bool is_name = is_name_at(text, found, piece) && (found == line || !is_of_name(text[found - 1]));
            renamed.append(text, at, found - at);
            renamed += is_name ? other : piece;
            at = found + piece.size();
        }
        renamed.append(text, at, end - at);
        line = end;
    }
    return renamed;
}

std::vector<ProgramPart> post_program(const Program& program, const Cell& cell, const ProgramName& name) {
    assert(cell.machine && !program.operations.empty());
    Names names{piece_name(name)};
    const std::unique_ptr<DialectPost> post = post_in_dialect(program, cell, names.piece);
    const std::vector<RunRange> ranges = chunk_ranges(program, *post, cell.machine->program);
    std::vector<WrittenChunk> all;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        const ProgramLines text = post->chunk(ranges[i], names.chunk(i), i, ranges.size());
        all.push_back(
            {{names.chunk(i), ranges[i], text.bytes().size()}, {names.chunk(i) + post->ending(), text.bytes()}});
    }
    std::vector<std::size_t> starts{0};
    if (!post->loads_chunks()) starts = part_starts(all, cell.machine->program.memory_bytes);
    names.parts = starts.size();
    starts.push_back(all.size());
    std::vector<ProgramPart> parts;
    for (std::size_t k = 0; k < names.parts; ++k) {
        MainProgram main{names.main(k), k, names.parts, {}, k > 0 ? part_question(k) : std::string()};
        for (std::size_t i = starts[k]; i < starts[k + 1]; ++i) main.chunks.push_back(all[i].chunk);
        ProgramPart part{names.main(k) + post->ending(), post->main(main), {}};
        for (std::size_t i = starts[k]; i < starts[k + 1]; ++i) {
            part.chunks.push_back(listed(program, cell, all[i], i));
            part.files.push_back(std::move(all[i].file));
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

}  // namespace qchopper
