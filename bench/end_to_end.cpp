// Measures every command as a process: wall and CPU time, peak memory, and the stages that the program reports itself.
// An older program runs the same command lines by turns with it, and each ratio is old to new of this one run.

#include <iostream>
#include <optional>

#include "base/error.h"
#include "base/files/temporary_folder.h"
#include "bench/by_turns.h"
#include "bench/choice.h"
#include "bench/figures.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr int turns = 2;  // of each program and step but the long ones; the least counts

constexpr const char* usage =
    R"(bench_end_to_end --new QCHOPPER [--old QCHOPPER] [--data DIR] [--small] [--only GROUP]...
  --new    the program that is measured
  --old    another one, which runs by turns with it
  --data   where bunny_bun_zipper.ply, ct_head_371k.ply and ct_head_1912k.ply lie
  --small  the bunny and 100,000 faces instead
  --only   inspect, repair, prepare, segment, explain, export or dry-run, all if none is named; or setups, the pieces of
           four models at 1 and 1.5 m, a quarter of an hour; or programs, the bunny at 1.5 m with proofs, half an hour
)";

struct Options {
    Choice choice;  // its program is the new one
    std::filesystem::path old_program;
};

std::optional<Options> options_from(int argc, char** argv) {
    Options options;
    std::vector<char*> rest{argv[0]};
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if ((word == "--old" || word == "--new") && i + 1 < argc) {
            (word == "--old" ? options.old_program : options.choice.program) = std::filesystem::absolute(argv[++i]);
        } else {
            rest.push_back(argv[i]);
        }
    }
    const bool is_parsed = parse(static_cast<int>(rest.size()), rest.data(), options.choice);
    return is_parsed && !options.choice.program.empty() ? std::optional(options) : std::nullopt;
}

std::string memory_text(double bytes) {
    return number_text(bytes / 1e6) + " MB";
}

// " | old | new | old / new"
std::string cells(const StepFigures& before, const StepFigures& now, double StepFigures::*figure,
                  std::string (*text)(double)) {
    const auto cell = [&](const StepFigures& f) { return f.has_run ? text(f.*figure) : std::string("-"); };
    const bool has_ratio = before.has_run && now.has_run && now.*figure > 0;
    return " | " + cell(before) + " | " + cell(now) + " | " +
           (has_ratio ? number_text(before.*figure / (now.*figure)) : "-");
}

// Stages of at least a hundredth of the time.
std::string stages_text(const StepFigures& figures) {
    std::string text;
    for (const TimedStage& stage : figures.stages) {
        if (stage.wall_s < 0.01 * figures.wall_s) continue;
        text += (text.empty() ? "" : ", ") + stage.name + " " + time_text(stage.wall_s);
    }
    return text;
}

class EndToEnd {
 public:
    EndToEnd(const Options& options, const std::filesystem::path& folder)
        : choice_(options.choice), folder_(folder), now_(options.choice.program, folder / "new") {
        if (!options.old_program.empty()) before_.emplace(options.old_program, folder / "old");
    }

    // False if a step has failed.
    bool run() {
        for (const CommandSpecimen& specimen : command_specimens(choice_.data, folder_, choice_.is_small)) {
            const std::vector<CommandStep> steps = command_steps(specimen, choice_.only);
            if (steps.empty() || !is_there(specimen)) continue;
            for (const CommandStep& step : steps) run(specimen, step);
            now_.clear();
            if (before_) before_->clear();
            if (specimen.faces > 0) std::filesystem::remove(specimen.scan);
        }
        return !has_failed_;
    }

    void print(std::ostream& out) const {
        out << "| specimen | command | wall, old | new | old / new | CPU, old | new | old / new | peak, old | new "
               "| old / new | stages of the new one, wall |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|\n";
        for (const std::string& row : rows_) out << row << "\n";
    }

 private:
    // Makes the scan by the new program if it is synthetic.
    bool is_there(const CommandSpecimen& specimen) const {
        if (specimen.faces > 0) {
            qchopper::bench::run({choice_.program.string(), "sample", "skull", "--faces",
                                  std::to_string(specimen.faces), "-o", specimen.scan.string(), "--quiet"});
        }
        const bool is_found = std::filesystem::exists(specimen.scan);
        if (!is_found) std::cerr << specimen.scan.string() << " is not there: left out" << std::endl;
        return is_found;
    }

    void run(const CommandSpecimen& specimen, const CommandStep& step) {
        StepFigures before;
        StepFigures now;
        const bool is_wanted = choice_.wants(step.group);
        for (int turn = 0; turn < (is_wanted && !step.is_long ? turns : 1); ++turn) {
            if (before_) before_->run(step, before);
            now_.run(step, now);
        }
        if (!now.has_run || (before_ && !before.has_run)) has_failed_ = true;
        if (!is_wanted) return;
        rows_.push_back("| " + specimen.name + " | " + step.name + cells(before, now, &StepFigures::wall_s, time_text) +
                        cells(before, now, &StepFigures::cpu_s, time_text) +
                        cells(before, now, &StepFigures::peak_bytes, memory_text) + " | " + stages_text(now) + " |");
        std::cerr << rows_.back() << std::endl;
    }

    const Choice& choice_;
    std::filesystem::path folder_;
    std::optional<MeasuredProgram> before_;
    MeasuredProgram now_;
    std::vector<std::string> rows_;
    bool has_failed_ = false;
};

}  // namespace

int main(int argc, char** argv) {
    const std::optional<Options> options = options_from(argc, argv);
    if (!options) {
        std::cerr << usage;
        return 64;
    }
    try {
        const TemporaryFolder folder("qchopper-bench-");
        EndToEnd bench(*options, folder.path());
        const bool is_complete = bench.run();
        bench.print(std::cout);
        return is_complete ? 0 : 1;
    } catch (const InputError& e) {
        std::cerr << e.what() << std::endl;
    } catch (const std::filesystem::filesystem_error& e) {
        std::cerr << e.what() << std::endl;
    }
    return 74;
}
