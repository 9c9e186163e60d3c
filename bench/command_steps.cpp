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

// The bunny, whose scan is in metres, at 1.5 m: pieces, programs and their proofs.
void add_program_steps(const CommandSpecimen& s, std::vector<CommandStep>& steps) {
    for (const std::string name : {"kr60-ha", "kr120-r2500-pro-rotary"}) {
        steps.push_back(
            {"programs",
             "prepare with programs at 1.5 m, " + name,
             {"prepare", s.scan.string(), "--units", "m", "--scale", "9.63397", "--cell", cell(name), "-o", project},
             "",
             "",
             true});
    }
}

}  // namespace

std::vector<CommandSpecimen> command_specimens(const fs::path& data, const fs::path& made, bool is_small) {
    CommandSpecimen bunny{"bunny", data / "bunny_bun_zipper.ply", 0, "m", {0, 6}, 2000, all_groups()};
    bunny.groups.insert("programs");
    if (is_small) return {bunny, {"skull 100k", made / "skull_100k.ply", 100'000, "mm", {0, 6}, 2000, all_groups()}};
    return {bunny,
            {"CT head 371k", data / "ct_head_371k.ply", 0, "mm", {0, 6}, 5000, all_groups()},
            {"skull 1.9M", made / "skull_1900k.ply", 1'900'000, "mm", {12, 20}, 50'000, all_groups()},
            {"CT head 1.9M", data / "ct_head_1912k.ply", 0, "mm", {0}, 50'000, {"inspect", "repair", "prepare"}},
            {"skull 10M", made / "skull_10M.ply", 10'000'000, "mm", {1}, 50'000, {"inspect", "prepare"}}};
}

std::vector<CommandStep> command_steps(const CommandSpecimen& specimen, const std::set<std::string>& only) {
    std::vector<CommandStep> all;
    add_scan_steps(specimen, all);
    add_segment_steps(specimen, all);
    add_project_steps(specimen, all);
    add_program_steps(specimen, all);
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
