// Lists of words; which steps are needed is found from the last to the first.

#include "bench/command_steps.h"

#include <algorithm>

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* project = "@/p.qch";

std::set<std::string> all_groups() {
    return {"inspect", "repair", "prepare", "segment", "explain", "export", "dry-run"};
}

std::string cell(const std::string& name = "foam-1") {
    return (fs::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml")).string();
}

void add_scan_steps(const CommandSpecimen& s, std::vector<CommandStep>& steps) {
    const std::string scan = s.scan.string();
    steps.push_back({"inspect", "inspect", {"inspect", scan, "--units", s.unit}, "", ""});
    steps.push_back({"repair", "repair", {"repair", scan, "--units", s.unit, "-o", "@/solid.ply"}, "", ""});
    for (const int cuts : s.cuts) {
        const std::string count = std::to_string(cuts);
        const bool is_last = cuts == s.cuts.back();
        steps.push_back({"prepare",
                         "prepare, " + count + (cuts == 1 ? " cut" : " cuts"),
                         {"prepare", scan, "--units", s.unit, "--cell", cell(), "--min-cuts", count, "-o", project},
                         "",
                         is_last ? "prepared" : ""});
    }
}

void add_segment_steps(const CommandSpecimen& s, std::vector<CommandStep>& steps) {
    steps.push_back({"segment",
                     "segment, new",
                     {"segment", s.scan.string(), "--units", s.unit, "--cell", cell(), "-o", project},
                     "",
                     "new"});
    steps.push_back({"segment", "segment --step", {"segment", project, "--step"}, "new", "ranked"});
    steps.push_back({"segment", "segment --step again", {"segment", project, "--step"}, "ranked", ""});
    steps.push_back({"segment", "segment --accept", {"segment", project, "--accept", "1"}, "ranked", "cut"});
    steps.push_back({"segment", "segment --undo", {"segment", project, "--undo"}, "cut", ""});
}

void add_project_steps(const CommandSpecimen& s, std::vector<CommandStep>& steps) {
    steps.push_back({"explain", "explain", {"explain", project}, "prepared", ""});
    steps.push_back({"export", "export 3mf", {"export", project, "--format", "3mf", "-o", "@/p.3mf"}, "prepared", ""});
    steps.push_back(
        {"export",
         "export 3mf, simplified",
         {"export", project, "--format", "3mf", "--max-faces", std::to_string(s.faces_a_piece), "-o", "@/p.3mf"},
         "prepared",
         ""});
    steps.push_back({"dry-run", "dry-run, all jobs", {"dry-run", project}, "prepared", ""});
}

// Models in the size in which they are carved, and the cells that carve them.
struct WholeModel {
    std::string name;
    std::string unit;
    std::string scale;
    std::vector<std::string> cells;
};

const std::vector<WholeModel>& whole_models() {
    static const std::vector<WholeModel> all{{"bunny", "m", "9.63397", {"kr60-ha", "kr120-r2500-pro-rotary"}},
                                             {"igea", "mm", "10066.64", {"kr60-ha", "kr120-r2500-pro-rotary"}},
                                             {"gorilla", "mm", "3.7154", {"irb6640-185-2.8"}},
                                             {"CT head 371k", "mm", "5.5866", {"kr60-ha"}}};
    return all;
}

// The bunny at 1.5 m and others at 1 m: pieces alone, or with programs and their proofs.
void add_whole_steps(const CommandSpecimen& s, std::vector<CommandStep>& steps) {
    const auto& all = whole_models();
    const auto model = std::find_if(all.begin(), all.end(), [&](const WholeModel& m) { return m.name == s.name; });
    if (model == all.end()) return;
    for (const bool has_programs : {false, true}) {
        for (const std::string& name : model->cells) {
            CommandStep step;
            step.group = has_programs ? "programs" : "setups";
            step.name = std::string("prepare ") + (has_programs ? "with programs, " : "--no-programs, ") + name;
            step.words = {"prepare",    s.scan.string(), "--units",  model->unit, "--scale",
                          model->scale, "--cell",        cell(name), "-o",        project};
            if (!has_programs) step.words.emplace_back("--no-programs");
            step.is_long = true;
            steps.push_back(step);
        }
    }
}

}  // namespace

std::vector<CommandSpecimen> command_specimens(const fs::path& data, const fs::path& made, bool is_small) {
    CommandSpecimen bunny{"bunny", data / "bunny_bun_zipper.ply", 0, "m", {0, 6}, 2000, all_groups()};
    bunny.groups.insert({"setups", "programs"});
    CommandSpecimen ct_head{"CT head 371k", data / "ct_head_371k.ply", 0, "mm", {0, 6}, 5000, all_groups()};
    ct_head.groups.insert("setups");
    if (is_small) return {bunny, {"skull 100k", made / "skull_100k.ply", 100'000, "mm", {0, 6}, 2000, all_groups()}};
    return {bunny,
            {"igea", data / "igea_268k.ply", 0, "mm", {}, 0, {"setups"}},
            {"gorilla", data / "gorilla_skull_159k.ply", 0, "mm", {}, 0, {"setups"}},
            ct_head,
            {"skull 1.9M", made / "skull_1900k.ply", 1'900'000, "mm", {12, 20}, 50'000, all_groups()},
            {"CT head 1.9M", data / "ct_head_1912k.ply", 0, "mm", {0}, 50'000, {"inspect", "repair", "prepare"}},
            {"skull 10M", made / "skull_10M.ply", 10'000'000, "mm", {1}, 50'000, {"inspect", "prepare"}}};
}

std::vector<CommandStep> command_steps(const CommandSpecimen& specimen, const std::set<std::string>& only) {
    std::vector<CommandStep> all;
    add_scan_steps(specimen, all);
    add_segment_steps(specimen, all);
    add_project_steps(specimen, all);
    add_whole_steps(specimen, all);
    std::vector<CommandStep> chosen;
    std::set<std::string> needed;  // projects that later steps start from
    for (auto step = all.rbegin(); step != all.rend(); ++step) {
        const bool is_named = only.contains(step->group) || (only.empty() && !step->is_long);
        const bool is_wanted = specimen.groups.contains(step->group) && is_named;
        if (!is_wanted && !needed.contains(step->keep)) continue;
        if (!step->from.empty()) needed.insert(step->from);
        chosen.push_back(*step);
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace qchopper::bench
