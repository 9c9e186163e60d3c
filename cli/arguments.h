// What the operator typed, as values. The only file that knows the option parser is arguments.cpp.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include "segment/mesh/vec3.h"

namespace qchopper {

struct SampleArguments {
    std::string specimen;
    std::size_t faces = 100'000;
    int holes = 0;
    std::filesystem::path out;
};

struct InspectArguments {
    std::filesystem::path scan;
    std::optional<std::string> units;
};

struct PrepareArguments {
    std::filesystem::path input;  // a scan, or a project folder to go on with
    std::optional<std::string> units;
    std::optional<double> scale;
    std::optional<std::filesystem::path> cell;
    std::optional<std::string> preset;
    std::optional<int> min_cuts;
    std::optional<std::size_t> max_faces;
    std::optional<Vec3> max_obb;
    bool fits_cell = false;
    std::optional<std::string> stop;       // any | all
    std::optional<std::string> fragility;  // thinness | thesis
    std::optional<std::string> crumbs;     // keep | drop
    std::optional<std::filesystem::path> out;
};

struct DryRunArguments {
    std::filesystem::path project;
    std::optional<std::string> piece;
    double speed = 100'000;  // simulated seconds per second
};

struct CellSimArguments {
    std::string listen = "127.0.0.1:15020";
    std::filesystem::path drop;
    std::string consent = "auto";
    std::optional<std::filesystem::path> store;
    std::optional<std::filesystem::path> cell;
    double speed = 1;
};

struct DispatchArguments {
    std::filesystem::path project;
    std::optional<std::string> piece;
    std::optional<std::string> to;
    std::optional<std::filesystem::path> drop;
    bool yes = false;
};

struct Arguments {
    bool json = false;  // for the option parser; run.cpp knows it earlier
    bool quiet = false;
    std::variant<SampleArguments, InspectArguments, PrepareArguments, DryRunArguments, CellSimArguments,
                 DispatchArguments>
        command;
};

// Nothing if help or version was asked for: it is on stdout then. Throws InputError (use).
std::optional<Arguments> parse_arguments(int argc, const char* const* argv);

}  // namespace qchopper
