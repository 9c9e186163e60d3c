// Hands the items of a project to Slurm, or to processes here. The number of shards stands in the script, not in the
// array: an array of some tasks has another count. gather follows whatever became of the tasks (afterany), and names
// what is missing.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "app/cli/arguments/check_arguments.h"
#include "app/cli/arguments/version.h"
#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/local_engine.h"
#include "app/engine/prepare_project.h"
#include "app/engine/work_project.h"
#include "app/store/project_folder.h"
#include "base/child_process.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/printable.h"
#include "base/text.h"
#include "cam/job/glue_faces.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double seconds_a_shard = 900;
constexpr double most_shards = 1000;
constexpr double times_estimate = 3;  // of time that is asked for
constexpr double least_minutes = 10;
constexpr double least_megabytes = 1000;

// What is asked of Slurm.
struct ArrayJob {
    std::size_t shards = 1;
    std::vector<std::size_t> tasks;  // those that have something to make
    double minutes = least_minutes;
    double megabytes = least_megabytes;
};

ArrayJob array_job(const std::vector<ItemEstimate>& items, std::optional<std::size_t> shards) {
    std::vector<double> efforts;
    efforts.reserve(items.size());
    for (const ItemEstimate& item : items) efforts.push_back(item.seconds);
    const double all_s = std::accumulate(efforts.begin(), efforts.end(), 0.0);
    const double most = std::min(static_cast<double>(items.size()), most_shards);
    ArrayJob job;
    job.shards = shards.value_or(static_cast<std::size_t>(std::clamp(std::ceil(all_s / seconds_a_shard), 1.0, most)));
    for (std::size_t number = 0; number < job.shards; ++number) {
        double left_s = 0;
        double bytes = 0;
        for (const std::size_t i : items_of({number, job.shards}, efforts)) {
            if (items[i].is_made || items[i].is_given_up()) continue;
            left_s += items[i].seconds;
            bytes = std::max(bytes, items[i].bytes);
        }
        if (left_s <= 0) continue;
        job.tasks.push_back(number);
        job.minutes = std::max(job.minutes, std::ceil(times_estimate * left_s / 60));
        job.megabytes = std::max(job.megabytes, std::ceil(2 * bytes / 1e6));
    }
    return job;
}

std::vector<std::string> given_up_pieces(const std::vector<ItemEstimate>& items) {
    std::vector<std::string> names;
    for (const ItemEstimate& item : items) {
        if (item.is_given_up()) names.push_back(item.piece);
    }
    return names;
}

std::string numbers(const std::vector<std::size_t>& tasks) {
    std::string text;
    for (const std::size_t task : tasks) text += (text.empty() ? "" : ",") + std::to_string(task);
    return text;
}

std::string script(const ArrayJob& job, const fs::path& project, const std::string& program, bool has_retry) {
    return "#!/bin/sh\n"
           "# Written by qchopper submit.\n"
           "#SBATCH --job-name=qchopper --array=" +
           numbers(job.tasks) + " --cpus-per-task=1 --mem=" + fixed(job.megabytes, 0) +
           "M --time=" + fixed(job.minutes, 0) +
           "\n"
           "#SBATCH --requeue --open-mode=append --output=\"" +
           (project / "work" / "slurm-%a.log").string() +
           "\"\n"
           "exec " +
           shell_word(program) + " work " + shell_word(project) +
           " --threads \"$SLURM_CPUS_PER_TASK\" --shard \"$SLURM_ARRAY_TASK_ID/" + std::to_string(job.shards) + "\"" +
           (has_retry ? " --retry" : "") + "\n";
}

// What Slurm says, or why it does not.
struct SlurmAnswer {
    std::string text;
    std::string fault;  // empty: none
};

SlurmAnswer ask(const std::vector<std::string>& words) {
    const ChildOutput said = run_child(words, 15s);
    if (said.code == 127) return {{}, words[0] + " is not installed here"};
    if (said.code != 0) {
        const std::string& why = said.err.empty() ? said.out : said.err;
        return {{}, words[0] + ": " + (why.empty() ? "no answer" : printable(why.substr(0, why.find('\n'))))};
    }
    return {said.out.substr(0, said.out.find_first_of(";\n")), {}};
}

std::vector<std::string> sbatch(std::vector<std::string> words, const std::vector<std::string>& options) {
    words.insert(words.begin(), "sbatch");
    words.insert(words.begin() + 1, options.begin(), options.end());
    return words;
}

// Nothing is submitted if one of the first two fails.
SlurmAnswer submit(const fs::path& file, const fs::path& project, const std::string& program,
                   const std::vector<std::string>& options) {
    for (const auto& words : {std::vector<std::string>{"scontrol", "ping"}, sbatch({"--test-only", file}, options)}) {
        if (SlurmAnswer answer = ask(words); !answer.fault.empty()) return answer;
    }
    SlurmAnswer array = ask(sbatch({"--parsable", file}, options));
    if (!array.fault.empty()) return array;
    const std::string gather = "exec " + shell_word(program) + " gather " + shell_word(project);
    const SlurmAnswer after =
        ask(sbatch({"--parsable", "--job-name=qchopper-gather", "--dependency=afterany:" + array.text,
                    "--output=" + (project / "work" / "gather.log").string(), "--wrap=" + gather},
                   options));
    if (!after.fault.empty())
        return {{}, "job " + array.text + " is submitted, gather after it is not: " + after.fault};
    return {array.text + " and " + after.text, {}};
}

// Until the arm refuses no piece that can be changed; each time it does, the others are kept.
int make_locally(const fs::path& project, std::vector<ItemEstimate> items, const LocalLimits& limits,
                 Terminal& terminal) {
    while (true) {
        work_locally(project, items, limits, terminal);
        const GatherAnswer answer = gather_project(project, false, version(), terminal.context());
        if (!answer.unmade.empty() || answer.refused.empty()) return show(answer, project, terminal);
        PrepareOptions options{version(), {}};
        options.has_programs = true;
        options.has_items = true;
        prepare_project(project, {}, options, terminal.context());
        items = item_estimates(project, version());
    }
}

}  // namespace

int run(const SubmitArguments& a, Terminal& terminal) {
    terminal.set_unchanged("Nothing was submitted.");
    check_arguments(a);
    const fs::path project = fs::absolute(without_slash(a.project));
    std::vector<ItemEstimate> items = item_estimates(project, version());
    if (a.has_retry) {
        for (ItemEstimate& item : items) item.failures = 0;
    }
    const bool is_all_made = std::ranges::all_of(items, &ItemEstimate::is_made);
    const auto is_left = [](const ItemEstimate& item) { return !item.is_made && !item.is_given_up(); };
    if (const std::vector<std::string> given_up = given_up_pieces(items); !given_up.empty()) {
        const std::string name = shell_word(without_slash(a.project));
        const std::string what = "three attempts have failed to make " + list_of_pieces(given_up);
        const std::string remedy =
            "see qchopper work " + name + " --status, mend that, then qchopper submit " + name + " --retry";
        if (std::ranges::none_of(items, is_left)) throw InputError(InputFault::use, what, remedy);
        terminal.warn({what + ", which is left out; " + remedy});
    }
    if (!is_all_made && a.engine == "local") {
        terminal.set_unchanged("Pieces that are made are kept, and the same command makes the rest.");
        return make_locally(project, std::move(items), {a.shards, 1e6 * a.memory_mb.value_or(0), a.has_retry},
                            terminal);
    }
    const ArrayJob job = array_job(items, a.shards);
    if (job.tasks.empty()) {
        terminal.message("every result is there; next: qchopper gather " + shell_word(without_slash(a.project)));
        return exit_done;
    }
    const fs::path file = project / "work" / "slurm.sh";
    const std::string program = fs::read_symlink("/proc/self/exe").string();
    write_file(file, script(job, project, program, a.has_retry));
    terminal.message(file.string() + ": " + counted(job.tasks.size(), "task") + ", " + fixed(job.minutes, 0) +
                     " min and " + fixed(job.megabytes, 0) + " MB each");
    if (a.is_only_written) return exit_done;
    const SlurmAnswer answer = submit(file, project, program, a.options);
    if (!answer.fault.empty()) {
        terminal.warn({"Slurm does not take it: " + answer.fault});
        return exit_unreachable;
    }
    terminal.message("jobs " + answer.text + " are submitted: work, and gather after it; see qchopper work " +
                     shell_word(without_slash(a.project)) + " --status");
    return exit_done;
}

}  // namespace qchopper
