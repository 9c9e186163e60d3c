// A job as the page replays it: the way of the tool, the stock at its stages, and the piece in its deviation.
//
// Display files are kept in the project's cache, and found by their ids (tests/app/cli/replay_test.cpp).
// mm, seconds, coordinates of the setup.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/dispatch/replay_job.h"
#include "app/report/document.h"
#include "base/context.h"

namespace qchopper {

struct ShownStage {
    std::string mesh;        // id
    std::size_t points = 0;  // of the way, which are passed
    double seconds = 0;
    double removed_mm3 = 0;
    bool operator==(const ShownStage&) const = default;
};

// Points of the way in a row.
struct ShownSection {
    std::string file;
    std::uint16_t tool = 0;
    std::uint32_t orientation = 0;  // from 1
    std::size_t points = 0;
    bool operator==(const ShownSection&) const = default;
};

struct ShownTool {
    std::uint16_t number = 0;
    std::string name;
    bool operator==(const ShownTool&) const = default;
};

// The piece, with a class of deviation for each face (app/pictures/deviation_picture.h).
struct ShownDeviation {
    std::string mesh;     // id
    std::string classes;  // id of states
    bool operator==(const ShownDeviation&) const = default;
};

struct ShownReplay {
    std::string piece;
    std::uint16_t part = 1;
    std::uint16_t parts = 1;
    std::string job;           // SHA-256 of its file
    bool is_positive = false;  // the verdict of its proof
    double cell_mm = 0;        // of the foam in this replay
    double stock_off_mm = 0;   // a face of a stage is so far from the surface that it shows at most
    double time_s = 0;
    double removed_mm3 = 0;
    std::string path;  // id
    std::vector<ShownSection> sections;
    std::vector<ShownTool> tools;  // that are used, by number
    std::vector<Vec3> tool_axes;   // by orientation: unit vectors from the tip into the spindle
    std::vector<ShownStage> stages;
    std::optional<ShownDeviation> deviation;
    bool operator==(const ShownReplay&) const = default;
};

// Where they are kept.
std::filesystem::path replay_folder(const std::filesystem::path& project);

// From the cache, or replayed and kept there. Throws what JobToReplay throws.
ShownReplay shown_replay(const ReplayOrder& order, const Context& context);

Document document(const ShownReplay& replay);

}  // namespace qchopper
