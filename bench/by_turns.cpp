// Before a run the folder is emptied and the project that the step starts from is copied there, which is not timed.

#include "bench/by_turns.h"

#include <sys/wait.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;

std::string text_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::vector<TimedStage> stages_in(const fs::path& document) {
    std::vector<TimedStage> stages;
    const auto json = nlohmann::json::parse(text_in(document), nullptr, false);
    if (!json.is_object() || !json.contains("timings")) return stages;
    for (const auto& stage : json["timings"]["stages"]) stages.push_back({stage["name"], stage["wall_s"]});
    return stages;
}

bool is_done(int status) {
    return status != -1 && WIFEXITED(status) && WEXITSTATUS(status) <= 1;
}

}  // namespace

MeasuredProgram::MeasuredProgram(fs::path program, fs::path folder)
    : program_(std::move(program)), folder_(std::move(folder)) {
    fs::create_directories(folder_ / "kept");
    qchopper::bench::run({program_.string(), "inspect", "--help"}, streams());
    knows_timings_ = text_in(streams().out).find("--timings") != std::string::npos;
}

ChildStreams MeasuredProgram::streams() const {
    return {folder_ / "out", folder_ / "err"};
}

std::vector<std::string> MeasuredProgram::command(const CommandStep& step) const {
    std::vector<std::string> words{program_.string()};
    for (const std::string& word : step.words) {
        words.push_back(word.starts_with("@/") ? (folder_ / "run" / word.substr(2)).string() : word);
    }
    words.insert(words.end(), {"--quiet", "--json"});
    if (knows_timings_) words.emplace_back("--timings");
    return words;
}

void MeasuredProgram::run(const CommandStep& step, StepFigures& figures) const {
    const fs::path here = folder_ / "run";
    const fs::path kept = folder_ / "kept";
    fs::remove_all(here);
    fs::create_directory(here);
    if (!step.from.empty() && !fs::exists(kept / step.from)) return;  // the step before has failed
    if (!step.from.empty()) fs::copy(kept / step.from, here / "p.qch", fs::copy_options::recursive);
    const ChildResult ended = qchopper::bench::run(command(step), streams());
    if (!is_done(ended.status)) {
        std::cerr << program_.string() << ": " << step.name << " ended with status " << ended.status << ": "
                  << text_in(streams().err) << std::endl;
        return;
    }
    if (!figures.has_run || ended.wall < figures.wall_s) figures.stages = stages_in(streams().out);
    const auto least = [&](double figure, double now) { return figures.has_run ? std::min(figure, now) : now; };
    figures.wall_s = least(figures.wall_s, ended.wall);
    figures.cpu_s = least(figures.cpu_s, ended.cpu);
    figures.peak_bytes = least(figures.peak_bytes, ended.peak_bytes);
    figures.has_run = true;
    if (step.keep.empty()) return;
    fs::remove_all(kept / step.keep);
    fs::rename(here / "p.qch", kept / step.keep);
}

void MeasuredProgram::clear() const {
    fs::remove_all(folder_ / "run");
    fs::remove_all(folder_ / "kept");
    fs::create_directory(folder_ / "kept");
}

}  // namespace qchopper::bench
