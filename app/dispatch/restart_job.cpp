// The first job is read back once and replayed up to the chunk. O(bytes) but for that and for the proof.

#include "app/dispatch/restart_job.h"

#include <algorithm>
#include <optional>

#include "app/jobs/job_scene.h"
#include "app/pictures/deviation_picture.h"
#include "base/error.h"
#include "base/text.h"
#include "cam/job/manifest.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "cam/post/post.h"
#include "cam/setup/drill_orientation.h"
#include "sim/program/program_line.h"
#include "sim/replay/stages/stock_before_chunk.h"

namespace qchopper {
namespace {

std::string without_ending(const std::string& file) {
    return file.substr(0, file.rfind('.'));
}

// The first job as it is read back and replayed.
class FirstJob {
 public:
    FirstJob(const ReadJob& job, const std::string& source, const Cell& cell)
        : job_(job), contents_(job, source), input_(contents_.input(cell)), program_(read(source)) {
        for (const ProgramChunk& chunk : program_.chunks) {
            if (!chunk.is_main) chunks_.push_back(chunk);
        }
        if (chunks_.size() == job.program->chunks.size()) return;
        throw InputError(InputFault::mesh, source + " lists other chunks than its program calls",
                         "write the job again with qchopper prepare");
    }

    const ProofInput& input() const { return input_; }

    // The last one up to `chunk` that may be started from home.
    std::size_t startable(std::size_t chunk) const {
        while (chunk > 0 && chunks_[chunk].free_from_home == 0) --chunk;
        return chunk;
    }

    // That the chunks from `chunk` on drill, ascending.
    std::vector<std::size_t> holes_from(std::size_t chunk) const {
        std::vector<std::size_t> holes;
        for (const std::size_t hole : job_.program->holes) {
            const auto drills = [&](const ProgramChunk& own) {
                const auto steps = std::span(program_.steps).subspan(own.first, own.end - own.first);
                return std::ranges::find(steps, hole, &ProgramStep::hole) != steps.end();
            };
            if (std::any_of(chunks_.begin() + static_cast<std::ptrdiff_t>(chunk), chunks_.end(), drills)) {
                holes.push_back(hole);
            }
        }
        return holes;
    }

    Bytes stock_before(std::size_t chunk, const Context& context) const {
        ReplayScene scene = scene_of(input_);
        const std::optional<StockRecord> before = qchopper::stock_before(input_);
        if (before) scene.before = &*before;
        ReplayOptions options;
        options.cell = input_.replay_cell;
        return to_bytes(stock_before_chunk(program_, scene, chunk, options, context));
    }

 private:
    ParsedProgram read(const std::string& source) const {
        try {
            return program_read_back(input_);
        } catch (const LineRefused& refused) {
            throw InputError(
                InputFault::mesh,
                source + ": " + refused.file + " line " + std::to_string(refused.line) + ": " + refused.why,
                "write the job again with qchopper prepare");
        }
    }

    const ReadJob& job_;
    JobContents contents_;
    ProofInput input_;
    ParsedProgram program_;
    std::vector<ProgramChunk> chunks_;
};

std::vector<KeptChunk> kept_chunks(const ReadJob& first, std::size_t from, const Cell& cell) {
    std::vector<KeptChunk> kept;
    for (std::size_t i = from; i < first.program->chunks.size(); ++i) {
        const JobChunk& chunk = first.program->chunks[i];
        if (std::ranges::count(cell.machine->tools, chunk.tool, &CuttingTool::number) == 0) {
            throw InputError(InputFault::use,
                             "tool " + std::to_string(chunk.tool) + " of " + chunk.file + " is not in the cell file");
        }
        kept.push_back({without_ending(chunk.file), chunk.tool, chunk.orientation, first.files.at(chunk.file).size()});
    }
    return kept;
}

// Names of older jobs are without the order.
ProgramName name_of(const ReadJob& first) {
    ProgramName name{first.piece_no, order_in_names(first.project_id)};
    if (!first.program->entry.starts_with(piece_name(name))) name.order.clear();
    return name;
}

// Without stock, proof and time. `number` is that of the chunk over all parts, from 1.
ProgramInput program_from(const ReadJob& first, const FirstJob& read, std::size_t chunk, std::uint32_t number,
                          const Cell& cell) {
    const JobProgram& old = *first.program;
    const std::vector<KeptChunk> kept = kept_chunks(first, chunk, cell);
    const std::string main = without_ending(old.entry) + "_r" + std::to_string(number);
    ProgramInput input;
    input.program = old;
    input.program.restart = {first.file_sha256, static_cast<std::uint32_t>(chunk)};
    input.program.chunks.erase(input.program.chunks.begin(),
                               input.program.chunks.begin() + static_cast<std::ptrdiff_t>(chunk));
    input.program.holes = read.holes_from(chunk);
    input.program.files.clear();
    const Setup setup = with_drill_orientations(first.setup, old.drilling);
    for (ProgramText& file : post_restart(kept, setup, cell, name_of(first), main, old.part.number, old.part.count)) {
        if (input.program.files.empty()) input.program.entry = file.name;
        input.program.files.push_back(file.name);
        input.texts[file.name] = std::move(file.text);
    }
    for (const JobChunk& own : input.program.chunks) {
        const Bytes& bytes = first.files.at(own.file);
        input.program.files.push_back(own.file);
        input.texts[own.file] = {bytes.begin(), bytes.end()};
        if (input.tools.empty() || input.tools.back() != own.tool) input.tools.push_back(own.tool);
    }
    return input;
}

ProofFinding finding(const char* kind, const std::string& text) {
    return {kind, "", 0, text};
}

// The manifest that the restart must have, but for what its own proof says of it.
std::string expected_manifest(const ReadJob& restart, const ReadJob& first, const ProgramInput& expected) {
    ReadJob job = first;
    job.program = expected.program;
    job.program->time_s = restart.program->time_s;
    job.program->entry = restart.program->entry;  // its number is that of the piece, which a part does not know
    job.program->files = restart.program->files;
    job.entries = restart.entries;
    return to_manifest(job);
}

}  // namespace

RestartJob make_restart(const RestartOrder& order, const Context& context) {
    const ReadJob& first = order.first;
    const std::size_t count = first.program->chunks.size();
    if (order.chunk >= count) {
        throw InputError(InputFault::use, order.source + " has " + counted(count, "chunk") + ", and no chunk " +
                                              std::to_string(order.chunk + 1));
    }
    const FirstJob read(first, order.source, order.cell);
    RestartJob made;
    made.chunk = read.startable(order.chunk);
    if (made.chunk == 0) {
        throw InputError(InputFault::use,
                         order.source + ": a restart from " + first.program->chunks[order.chunk].file +
                             " would begin with the first chunk, which is the whole job",
                         Sentence::with_key("carve_again", {}, "Ask for it to be carved again."));
    }
    const auto number = static_cast<std::uint32_t>(order.chunks_before + made.chunk + 1);
    made.name = job_file_name(first.piece, first.program->part.number, number);
    ProgramInput program = program_from(first, read, made.chunk, number, order.cell);
    program.stock = read.stock_before(made.chunk, context);
    ProofInput proof = read.input();
    const ProofInput of_restart{proof.cell,        proof.setup,      proof.setup_in_cell, proof.mesh,
                                program.program,   program.texts,    &program.stock,      proof.holes,
                                proof.half_spaces, proof.replay_cell};
    made.proof = prove(of_restart, context);
    program.program.time_s = made.proof.time_s;
    if (!made.proof.deviation.empty()) {
        program.deviation_picture = deviation_picture(proof.mesh, made.proof.deviation, made.proof.is_given_up);
    }
    made.file = restart_job_file(first, program, order.cell);
    return made;
}

std::vector<ProofFinding> faults_of_restart(const ReadJob& restart, const ReadJob& first, const std::string& source,
                                            const Cell& cell, const Context& context) {
    const JobRestart& from = *restart.program->restart;
    if (from.of != first.file_sha256) {
        return {finding("other_job", "the restart was made for another job than " + source)};
    }
    if (!first.program || from.chunks_before >= first.program->chunks.size()) {
        return {finding("other_chunks", source + " has no chunk " + std::to_string(from.chunks_before + 1))};
    }
    std::vector<ProofFinding> faults;
    try {
        const FirstJob read(first, source, cell);
        const ProgramInput expected = program_from(first, read, from.chunks_before, 1, cell);
        if (to_manifest(restart) != expected_manifest(restart, first, expected)) {
            faults.push_back(finding("other_job", "the manifest describes another job than " + source));
        }
        for (const JobChunk& chunk : expected.program.chunks) {
            const auto own = restart.files.find(chunk.file);
            if (own != restart.files.end() && own->second == first.files.at(chunk.file)) continue;
            faults.push_back(finding("other_chunks", chunk.file + " is not that of " + source));
        }
        if (restart.files.at("piece.stl") != first.files.at("piece.stl")) {
            faults.push_back(finding("other_piece", "the mesh of the job is not that of " + source));
        }
        if (restart.files.at("stock.bin") != read.stock_before(from.chunks_before, context)) {
            faults.push_back(finding("other_stock", "stock.bin is not what the chunks before " +
                                                        expected.program.chunks.front().file + " leave, as " + source +
                                                        " has them"));
        }
    } catch (const InputError& error) {
        faults.push_back(finding("other_job", error.what()));
    }
    return faults;
}

}  // namespace qchopper
