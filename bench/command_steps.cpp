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

std::string cell() {
    return (fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "foam-1.toml").string();
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

}  // namespace

std::vector<CommandSpecimen> command_specimens(const fs::path& data, const fs::path& made, bool is_small) {
    const CommandSpecimen bunny{"bunny", data / "bunny_bun_zipper.ply", 0, "m", {0, 6}, 2000, all_groups()};
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
    std::vector<CommandStep> chosen;
    std::set<std::string> needed;  // projects that later steps start from
    for (auto step = all.rbegin(); step != all.rend(); ++step) {
        const bool is_wanted = specimen.groups.contains(step->group) && (only.empty() || only.contains(step->group));
        if (!is_wanted && !needed.contains(step->keep)) continue;
        if (!step->from.empty()) needed.insert(step->from);
        chosen.push_back(*step);
    }
    std::reverse(chosen.begin(), chosen.end());
    return chosen;
}

}  // namespace qchopper::bench
