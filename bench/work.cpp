// Programs of items: shards against one prepare, two processes against one, the first step, gather, estimates, kills.
//
// A sample vertebra of 60,000 faces in kr60-ha, and with a mesh as argument that one: FILE UNITS SCALE CELL. CPU time
// and ratios of one run. Cost: a dozen times that of its programs. --kills N: nothing but as many kills, of work on a
// small vertebra, three seconds each on average.

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "bench/child.h"
#include "bench/clock.h"
#include "bench/figures.h"

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Words = std::vector<std::string>;

struct Model {
    std::string name;
    Words options;  // of prepare
};

class WorkBench {
 public:
    WorkBench(fs::path program, fs::path folder, Model model, Figures& figures)
        : program_(std::move(program)), folder_(std::move(folder)), model_(std::move(model)), figures_(figures) {}

    void prepare() {
        whole_ = prepared("whole", {"--threads", "1"});
        items_ = prepared("items", {"--items", "--threads", "1"});
    }

    void shards() {
        const double of_programs = whole_.cpu - items_.cpu;
        figures_.record(model_.name, "programs of prepare --threads 1, CPU", time_text(of_programs));
        for (const int count : {1, 2, 4, 8}) {
            fs::remove_all(project("items") / "work" / "results");
            double cpu = 0;
            for (int i = 0; i < count; ++i) cpu += work(i, count).cpu;
            figures_.at_most(model_.name, "CPU of " + std::to_string(count) + " shards / that", cpu / of_programs,
                             1.05);
        }
    }

    void processes() {
        fs::remove_all(project("items") / "work" / "results");
        const double one = work(0, 1).wall;
        fs::remove_all(project("items") / "work" / "results");
        const double started = wall_s();
        std::thread beside([&] { work(1, 2); });
        work(0, 2);
        beside.join();
        figures_.at_most(model_.name, "wall of 2 processes / of 1", (wall_s() - started) / one, 0.55);
    }

    // By the estimates, of the attempts of the last runs.
    void estimates() {
        const json status = json::parse(said({"work", project("items").string(), "--status", "--json"}));
        figures_.record(model_.name, "CPU time of all attempts", time_text(status.at("spent_s").get<double>()));
        double peak = 0;
        for (const auto& entry : fs::directory_iterator(project("items") / "work" / "attempts")) {
            peak = std::max(peak, json::parse(std::ifstream(entry.path())).at("process_bytes").get<double>());
        }
        figures_.record(model_.name, "peak memory of a process", number_text(peak / 1e6) + " MB");
    }

    // From its start to the record of its first attempt.
    void first_step() {
        fs::remove_all(project("items") / "work" / "results");
        fs::remove_all(project("items") / "work" / "attempts");
        const double started = wall_s();
        const pid_t child = begun();
        while (attempts() == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        figures_.at_most(model_.name, "seconds to the first step", wall_s() - started, 0.3);
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
    }

    void gather() {
        work(0, 1);
        const ChildResult gathered = run({program_.string(), "gather", project("items").string(), "-q"});
        figures_.record(model_.name, "gather, CPU; peak memory",
                        time_text(gathered.cpu) + "; " + number_text(gathered.peak_bytes / 1e6) + " MB");
        const json timed = json::parse(said({"gather", project("items").string(), "--json", "--timings"}));
        double pictures = 0;
        for (const json& stage : timed.at("timings").at("stages")) {
            if (stage.at("name") == "pictures drawn") pictures = stage.at("cpu_s");
        }
        Words hash{"sha256sum"};
        for (const char* name : {"items", "results"}) {
            for (const auto& entry : fs::directory_iterator(project("items") / "work" / name)) {
                hash.push_back(entry.path());
            }
        }
        figures_.at_most(model_.name, "gather without pictures / sha256sum of items and results, CPU",
                         (timed.at("timings").at("cpu_s").get<double>() - pictures) / run(hash, {folder_ / "sums"}).cpu,
                         10);
        const Words differ{"diff", "-rq", (project("whole") / "jobs").string(), (project("items") / "jobs").string()};
        figures_.record(model_.name, "jobs are those of prepare", run(differ).status == 0 ? "yes" : "NO");
    }

    // Kills a process at a random moment again and again; results that were whole stay, so that at most the piece at
    // work is made again.
    void kills(int count) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> seconds(0.02, 6);
        fs::remove_all(project("items") / "work" / "results");
        int lost = 0;
        for (int k = 0; k < count; ++k) {
            if (results().size() == pieces()) fs::remove_all(project("items") / "work" / "results");
            const auto before = results();
            const pid_t child = begun();
            std::this_thread::sleep_for(std::chrono::duration<double>(seconds(random)));
            ::kill(child, SIGKILL);
            ::waitpid(child, nullptr, 0);
            const auto after = results();
            for (const auto& [name, bytes] : before) lost += after.contains(name) && after.at(name) == bytes ? 0 : 1;
        }
        figures_.record(model_.name, std::to_string(count) + " kills: whole results lost", std::to_string(lost));
        work(0, 1);
        gather();
    }

 private:
    fs::path project(const std::string& name) const { return folder_ / (name + ".qch"); }

    ChildResult prepared(const std::string& name, const Words& further) const {
        Words words{program_.string(), "prepare"};
        words.insert(words.end(), model_.options.begin(), model_.options.end());
        words.insert(words.end(), {"-q", "-o", project(name).string()});
        words.insert(words.end(), further.begin(), further.end());
        return checked(words);
    }

    ChildResult work(int number, int count) const {
        return checked({program_.string(), "work", project("items").string(), "-q", "--retry", "--threads", "1",
                        "--shard", std::to_string(number) + "/" + std::to_string(count)});
    }

    static ChildResult checked(const Words& words) {
        const ChildResult result = run(words);
        if (!WIFEXITED(result.status) || WEXITSTATUS(result.status) > 1) {
            std::cerr << words[1] << " failed\n";
            std::exit(1);
        }
        return result;
    }

    std::string said(Words words) const {
        words.insert(words.begin(), program_.string());
        const fs::path out = folder_ / "out.json";
        run(words, {out});
        std::string text;
        std::getline(std::ifstream(out), text, '\0');
        return text;
    }

    pid_t begun() const {
        const std::string items = project("items").string();
        const pid_t child = ::fork();
        if (child == 0) {
            ::execl(program_.c_str(), program_.c_str(), "work", items.c_str(), "-q", "--retry", "--threads", "1",
                    nullptr);
            ::_exit(127);
        }
        return child;
    }

    std::size_t files_in(const char* name, const std::string& ending) const {
        std::error_code error;
        const fs::directory_iterator files(project("items") / "work" / name, error);
        return static_cast<std::size_t>(
            std::count_if(begin(files), end(files), [&](const auto& e) { return e.path().extension() == ending; }));
    }
    std::size_t pieces() const { return files_in("items", ".qitem"); }
    std::size_t attempts() const { return files_in("attempts", ".json"); }

    // Sizes of whole results by their names.
    std::map<std::string, std::uintmax_t> results() const {
        std::map<std::string, std::uintmax_t> sizes;
        std::error_code error;
        for (const auto& entry : fs::directory_iterator(project("items") / "work" / "results", error)) {
            if (entry.path().extension() == ".programs") sizes[entry.path().filename()] = entry.file_size();
        }
        return sizes;
    }

    fs::path program_;
    fs::path folder_;
    Model model_;
    Figures& figures_;
    ChildResult whole_;  // prepare with programs, and with items
    ChildResult items_;
};

int bench_work(Words words) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "qchopper";
    const fs::path folder = fs::temp_directory_path() / ("bench-work-" + std::to_string(::getpid()));
    fs::create_directories(folder);
    int kills = 0;
    if (words.size() >= 2 && words[0] == "--kills") {
        kills = std::atoi(words[1].c_str());
        words.erase(words.begin(), words.begin() + 2);
    }
    Model model;
    if (words.size() == 4) {
        model = {fs::path(words[0]).stem(), {words[0], "--units", words[1], "--scale", words[2], "--cell", words[3]}};
    } else {
        const std::string vertebra = (folder / "vertebra.ply").string();
        const std::string faces = kills > 0 ? "2000" : "60000";
        run({program.string(), "sample", "vertebra", "--faces", faces, "-o", vertebra});
        model = {"vertebra of " + faces, {vertebra, "--units", "mm", "--cell", "kr60-ha"}};
        if (kills > 0) model.options.insert(model.options.end(), {"--scale", "0.35"});
    }
    Figures figures;
    WorkBench bench(program, folder, model, figures);
    bench.prepare();
    if (kills > 0) {
        bench.kills(kills);
    } else {
        bench.shards();
        bench.processes();
        bench.estimates();
        bench.first_step();
        bench.gather();
    }
    figures.print(std::cout);
    fs::remove_all(folder);
    return 0;
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    return qchopper::bench::bench_work({argv + 1, argv + argc});
}
