// One step after the other; the replay takes most of the time.

#include "app/project/piece_program.h"

#include <algorithm>
#include <map>
#include <utility>

#include "app/project/deviation_picture.h"
#include "base/error.h"
#include "cam/post/krl.h"
#include "cam/program/make_program.h"
#include "cam/setup/block_placement.h"
#include "cam/toolpath/make_toolpath.h"
#include "segment/io/write_stl.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

std::vector<Pose> frames_of(const Setup& setup, const Cell& cell) {
    std::vector<Pose> frames;
    const std::size_t angles = std::max<std::size_t>(1, setup.placement.table_angles.size());
    for (std::size_t d = 0; d < angles; ++d) frames.push_back(setup_in_cell(cell, setup.spoil, setup.placement, d));
    return frames;
}

// Of a part as it was posted; the figures of its chunks are read back later.
ProgramInput program_of(const ProgramPart& part, std::size_t number, std::size_t count, const Toolpath& toolpath) {
    ProgramInput input;
    input.program.entry = part.entry;
    for (const ProgramText& file : part.files) {
        input.program.files.push_back(file.name);
        input.texts[file.name] = file.text;
    }
    for (const PostedChunk& chunk : part.chunks) {
        JobChunk record;
        record.file = chunk.name;
        record.tool = chunk.tool_number;
        record.direction = chunk.direction;
        input.program.chunks.push_back(record);
        if (input.tools.empty() || input.tools.back() != chunk.tool_number) input.tools.push_back(chunk.tool_number);
    }
    input.program.part.number = static_cast<std::uint16_t>(number);
    input.program.part.count = static_cast<std::uint16_t>(count);
    for (const Operation& operation : toolpath.operations) {
        input.program.scallop_mm = std::max(input.program.scallop_mm, operation.scallop);
    }
    return input;
}

void add_proof(ProgramInput& input, const JobProof& proof, const TriangleMesh& mesh) {
    if (proof.chunks.size() == input.program.chunks.size()) input.program.chunks = proof.chunks;
    input.program.time_s = proof.time_s;
    input.is_proven = proof.is_proven();
    input.figures = proof.figures;
    for (const VerdictFinding& finding : proof.findings) input.findings.push_back(describe(finding));
    if (!proof.deviation.empty()) input.deviation_picture = deviation_picture(mesh, proof.deviation);
}

}  // namespace

std::string no_programs_for(const Cell& cell) {
    if (!cell.machine) return "the cell file is of version 1 and describes no machine";
    const Dialect dialect = cell.machine->program.dialect;
    if (dialect == Dialect::krl) return {};
    return std::string("programs in the dialect ") + to_word(dialect) + " are not written yet";
}

PiecePrograms make_programs(const Piece& piece, const Carving& carving, std::uint16_t piece_no, const Cell& cell,
                            const Context& context) {
    const Setup& setup = carving.setup();
    std::vector<ProgramPart> parts;
    Toolpath toolpath;
    try {
        toolpath = make_toolpath(setup, *piece.mesh, cell, {}, context);
        parts = post_krl(make_program(toolpath, setup, carving.work_envelope, cell, context), cell, {piece_no});
    } catch (const InputError& error) {
        return {{}, error.what()};
    }
    const TriangleMesh mesh = job_mesh(to_stl(apply(setup.piece_in_setup, *piece.mesh)), piece.name);
    const std::vector<Pose> frames = frames_of(setup, cell);
    PiecePrograms programs;
    Bytes stock;  // what the part before left
    for (const ProgramPart& part : parts) {
        ProvenProgram proven;
        proven.input = program_of(part, programs.parts.size() + 1, parts.size(), toolpath);
        proven.input.stock = std::move(stock);
        proven.proof =
            prove({cell, setup, frames, mesh, proven.input.program, proven.input.texts, &proven.input.stock}, context);
        stock = std::move(proven.proof.stock_left);
        add_proof(proven.input, proven.proof, mesh);
        programs.parts.push_back(std::move(proven));
    }
    return programs;
}

}  // namespace qchopper
