// The command lines that bench_end_to_end runs, specimen by specimen.

#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace qchopper::bench {

// One command of the program. In its words "@/" stands for the folder of the run, which holds nothing but the project
// p.qch that the step starts from.
struct CommandStep {
    std::string
        group;  // "inspect", "repair", "prepare", "segment", "explain", "export", "dry-run", "setups", "programs"
    std::string name;  // "prepare, 6 cuts"
    std::vector<std::string> words;
    std::string from;      // the kept project that it starts from; empty: none
    std::string keep;      // the name under which its project is kept for later steps; empty: it is not kept
    bool is_long = false;  // minutes to an hour: it is run once, and only if its group is named
};

struct CommandSpecimen {
    std::string name;
    std::filesystem::path scan;
    std::size_t faces = 0;  // of a synthetic skull that is made as the scan; 0: the scan is a file
    std::string unit = "mm";
    std::vector<int> cuts;          // prepare once for each, ascending; the last project is that of the later steps
    std::size_t faces_a_piece = 0;  // to which export simplifies
    std::set<std::string> groups;   // the commands that are run
};

// The specimens of the whole bench, or of the small one. `data` is the folder of the scans, `made` that of synthetic
// ones.
std::vector<CommandSpecimen> command_specimens(const std::filesystem::path& data, const std::filesystem::path& made,
                                               bool is_small);

// The steps of a specimen in their order: of those that are in `only`, or of all if that is empty, and of those that
// make a project for them.
std::vector<CommandStep> command_steps(const CommandSpecimen& specimen, const std::set<std::string>& only);

}  // namespace qchopper::bench
