// The findings of the way are the proof's business: what it finds wrong is executed all the same.

#include "app/dispatch/executed_program.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "app/jobs/job_scene.h"
#include "base/error.h"
#include "cam/job/read_job.h"
#include "devices/wire/program_block.h"
#include "sim/program/parsed_program.h"
#include "sim/program/program_line.h"
#include "sim/replay/scene.h"
#include "sim/replay/stages/tool_way.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

ReceivedProgram refused(const std::string& why, std::size_t line = 0) {
    return {nullptr, why, static_cast<std::uint32_t>(line)};
}

// Per file of the program the number of its chunk, from 1; 0: the main program.
std::vector<std::uint32_t> chunk_numbers(const ParsedProgram& program) {
    std::vector<std::uint32_t> numbers(program.files.size(), 0);
    std::uint32_t count = 0;
    for (const ProgramChunk& chunk : program.chunks) {
        if (!chunk.is_main) numbers[chunk.file] = ++count;
    }
    return numbers;
}

class RunMaker {
 public:
    RunMaker(const ParsedProgram& program, const ToolWay& way)
        : program_(program), way_(way), chunks_(chunk_numbers(program)) {}

    JobRun make() {
        run_.steps.reserve(way_.points.size());
        for (const WayPoint& point : way_.points) {
            run_.steps.push_back({point.seconds, block_of(point.place), point.tool, point.tip});
        }
        run_.seconds = way_.seconds;
        add_waits();
        return std::move(run_);
    }

 private:
    std::uint32_t block_of(SourcePlace place) const { return program_block(chunks_[place.file], place.line); }

    // The moves of the program are met in its order among the steps of the run.
    void add_waits() {
        std::size_t next = 0;
        for (const ProgramStep& step : program_.steps) {
            const std::uint32_t block = block_of(step.place);
            if (step.kind == StepKind::wait_input) {
                run_.waits.push_back({next > 0 ? run_.steps[next - 1].end_s : 0, step.number, block});
            }
            while (next < run_.steps.size() && run_.steps[next].block == block) ++next;
        }
    }

    const ParsedProgram& program_;
    const ToolWay& way_;
    std::vector<std::uint32_t> chunks_;
    JobRun run_;
};

ReceivedProgram run_of(const ProofInput& input) {
    if (input.program.dialect != input.cell.machine->program.dialect) {
        return refused(std::string("the program is in the dialect ") + to_word(input.program.dialect) +
                       ", the controller of this cell takes " + to_word(input.cell.machine->program.dialect));
    }
    const ParsedProgram program = program_read_back(input);
    const ReplayScene scene = scene_of(input);
    check_scene(scene);
    FindingLog log;
    const ToolPath path = walk_machine(program, scene, log, {});
    const ToolWay way = tool_way(path, *input.cell.machine);
    if (way.points.empty()) return refused("the program moves nothing");
    return {std::make_shared<const JobRun>(RunMaker(program, way).make()), {}, 0};
}

}  // namespace

ReceivedProgram executed_program(const Bytes& job_file, const std::string& name, const Cell& cell) {
    try {
        const ReadJob job = parse_job(job_file, name);
        if (!job.program) return {};
        const JobContents contents(job, name);
        return run_of(contents.input(cell));
    } catch (const LineRefused& line) {
        return refused(line.what(), line.line);
    } catch (const InputError& fault) {
        return refused(fault.what());
    }
}

ProgramReader program_reader(const Cell& cell) {
    if (!cell.machine) return {};
    return [cell](const Bytes& job_file, const std::string& name) { return executed_program(job_file, name, cell); };
}

}  // namespace qchopper
