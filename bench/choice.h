// The command line that bench_search and bench_import share.

#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "bench/specimens.h"

namespace qchopper::bench {

struct Choice {
    std::filesystem::path data = default_data();
    std::filesystem::path program;  // empty: its memory is not measured
    bool is_small = false;
    std::set<std::string> only;  // groups of figures; empty: all
    bool wants(const std::string& group) const { return only.empty() || only.contains(group); }
};

// Fills `choice` from the arguments; false if one is unknown or lacks its value.
inline bool parse(int argc, char** argv, Choice& choice) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool has_value = i + 1 < argc;
        if (word == "--small")
            choice.is_small = true;
        else if (word == "--data" && has_value)
            choice.data = argv[++i];
        else if (word == "--program" && has_value)
            choice.program = argv[++i];
        else if (word == "--only" && has_value)
            choice.only.insert(argv[++i]);
        else
            return false;
    }
    return true;
}

}  // namespace qchopper::bench
