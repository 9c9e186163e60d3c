// Processes and not threads: each has its own memory, and one that fails leaves the others alone. Their results are
// counted twice a second.

#include "app/cli/local_engine.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <numeric>
#include <string>
#include <thread>

#include "base/child_process.h"
#include "base/text.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr double share_of_memory = 0.8;
constexpr double unknown_memory = 2e9;

double free_bytes() {
    std::ifstream file("/proc/meminfo");
    std::string key;
    double kilobytes = 0;
    std::string unit;
    while (file >> key >> kilobytes >> unit) {
        if (key == "MemAvailable:") return 1024 * kilobytes;
        if (unit != "kB") break;
    }
    return unknown_memory;
}

std::size_t results_in(const fs::path& project) {
    std::error_code error;
    const fs::directory_iterator results(project / "work" / "results", error);
    if (error) return 0;
    return static_cast<std::size_t>(std::count_if(begin(results), end(results), [](const fs::directory_entry& entry) {
        return entry.path().extension() == ".programs";
    }));
}

fs::path log_of(const fs::path& project, std::size_t process) {
    return project / "work" / ("local-" + std::to_string(process) + ".log");
}

}  // namespace

std::size_t processes_for(const std::vector<ItemEstimate>& items, std::size_t processes, double bytes) {
    std::vector<double> needed;
    for (const ItemEstimate& item : items) {
        if (!item.is_made && !item.is_given_up()) needed.push_back(item.bytes);
    }
    std::sort(needed.begin(), needed.end(), std::greater<>());
    needed.resize(std::min(needed.size(), processes));
    while (needed.size() > 1 && std::accumulate(needed.begin(), needed.end(), 0.0) > bytes) needed.pop_back();
    return std::max<std::size_t>(1, needed.size());
}

void work_locally(const fs::path& project, const std::vector<ItemEstimate>& items, const LocalLimits& limits,
                  Terminal& terminal) {
    const double bytes = limits.bytes > 0 ? limits.bytes : share_of_memory * free_bytes();
    const std::size_t count =
        processes_for(items, limits.processes.value_or(std::max(1U, std::thread::hardware_concurrency())), bytes);
    terminal.message(counted(count, "process", "processes") + " of one thread each, in at most " +
                     fixed(bytes / 1e9, 1) + " GB of memory together");
    const std::string program = fs::read_symlink("/proc/self/exe").string();
    std::vector<Child> children;
    for (std::size_t i = 0; i < count; ++i) {
        const std::string shard = std::to_string(i) + "/" + std::to_string(count);
        std::vector<std::string> words{program, "work", project.string(), "--threads", "1", "--shard", shard};
        if (limits.has_retry) words.emplace_back("--retry");
        children.emplace_back(words, log_of(project, i));
    }
    const ProjectContext context = terminal.context();
    bool is_stopping = false;
    const auto is_running = [&] { return std::ranges::any_of(children, [](Child& child) { return !child.code(); }); };
    while (is_running()) {
        context.progress("pieces made", results_in(project), items.size());
        if (!is_stopping && context.cancelled != nullptr && context.cancelled->load()) {
            is_stopping = true;
            for (Child& child : children) child.stop();
        }
        std::this_thread::sleep_for(500ms);
    }
    context.check_cancelled();
    for (std::size_t i = 0; i < count; ++i) {
        if (children[i].code() == 0) continue;
        terminal.warn({"process " + std::to_string(i) + " ended with " + std::to_string(*children[i].code()) +
                       ": see " + log_of(project, i).string()});
    }
}

}  // namespace qchopper
