// What the programs that measure have in common: their command line, and their way from it to a table of figures.

#pragma once

#include <filesystem>
#include <iostream>
#include <set>
#include <string>

#include "base/error.h"
#include "bench/figures.h"
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

// Prints the figures that measure(choice, figures) records. Returns the exit code: 64 with the usage for an unknown
// argument, 65 for an InputError.
template <class Measure>
int print_figures(int argc, char** argv, const char* usage, const Measure& measure) {
    Choice choice;
    if (!parse(argc, argv, choice)) {
        std::cerr << usage;
        return 64;
    }
    Figures figures;
    try {
        measure(choice, figures);
    } catch (const InputError& error) {
        std::cerr << error.what() << ". To do: " << error.to_do.text << std::endl;
        return 65;
    }
    figures.print(std::cout);
    return 0;
}

}  // namespace qchopper::bench
