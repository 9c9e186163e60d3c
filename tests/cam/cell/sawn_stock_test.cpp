// Stock that may be sawn down in a cell file: kerf, accuracy of the saw, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "cam/cell/cell.h"
#include "tests/cam/cell/ready_cells.h"

namespace qchopper {
namespace {

// The cell with these lines as its table [saw], or with no such table for an empty text.
std::string with_saw(std::string text, const std::string& keys) {
    const std::size_t begin = text.find("[saw]\n");
    EXPECT_NE(begin, std::string::npos);
    return text.replace(begin, text.find("\n\n", begin) - begin, keys.empty() ? "" : "[saw]\n" + keys);
}

// A cell in which no block may be sawn.
std::string never_sawn() {
    std::string text = robot_cell();
    for (const char* line : {"sawn = true  # may be sawn down\n", "kerf = 3.0\n"}) {
        while (text.find(line) != std::string::npos) text = replaced(text, line, "");
    }
    return text;
}

TEST(CellVersion2, TheSawIsReadWhereABlockMayBeSawn) {
    const Cell by_default = parse_cell(with_saw(robot_cell(), ""), "cell.toml");
    EXPECT_EQ(by_default.saw, (Saw{0.5, 0.1}));
    const auto has = [](const Cell& cell, const ValueOrigin& value) {
        return std::find(cell.origins.begin(), cell.origins.end(), value) != cell.origins.end();
    };
    EXPECT_TRUE(has(by_default, {"saw", "accuracy", Origin::by_default}));
    const Cell given =
        parse_cell(with_saw(robot_cell(), "accuracy = 0.2\nflush_tolerance = 0\nsource = \"measured\""), "cell.toml");
    EXPECT_EQ(given.saw, (Saw{0.2, 0}));
    EXPECT_TRUE(has(given, {"saw", "accuracy", Origin::measured}));
    const Cell none = parse_cell(with_saw(never_sawn(), ""), "cell.toml");
    EXPECT_EQ(none.saw, Saw{});
    EXPECT_TRUE(std::none_of(none.origins.begin(), none.origins.end(),
                             [](const ValueOrigin& value) { return value.table == "saw"; }));
}

TEST(CellVersion2, ASawThatCannotBeIsRefusedWithItsLine) {
    const std::vector<std::pair<std::string, std::string>> values{{"-0.1", "-0.1 is out of bounds, 0 to 5"},
                                                                  {"5.1", "5.1 is out of bounds, 0 to 5"},
                                                                  {"nan", "must be a finite number"},
                                                                  {"inf", "must be a finite number"},
                                                                  {"\"half\"", "must be a number"}};
    for (const std::string key : {"accuracy", "flush_tolerance"}) {
        for (const auto& [value, why] : values) {
            const std::string line = key + " = " + value;
            const std::string text = with_saw(robot_cell(), line);
            const std::string what = refused(text);
            EXPECT_EQ(what.find("cell.toml:" + std::to_string(line_of(text, line)) + ": saw." + key + ": " + why), 0U)
                << line << " -> " << what;
        }
        EXPECT_EQ(refused(with_saw(robot_cell(), key + " = 0")), "taken");
        EXPECT_EQ(refused(with_saw(robot_cell(), key + " = 5")), "taken");
    }
    const std::string unknown = with_saw(robot_cell(), "acuracy = 0.5");
    EXPECT_EQ(
        refused(unknown).find("cell.toml:" + std::to_string(line_of(unknown, "acuracy")) + ": unknown key saw.acuracy"),
        0U)
        << refused(unknown);
}

TEST(CellVersion2, ASawWithoutABlockToSawIsRefused) {
    const std::string text = with_saw(never_sawn(), "accuracy = 0.5");
    EXPECT_EQ(refused(text).find("cell.toml:" + std::to_string(line_of(text, "[saw]")) + ": saw: has no meaning"), 0U)
        << refused(text);
}

TEST(CellVersion2, AKerfThatLeavesNothingIsRefused) {
    for (const char* kerf : {"40.0", "39.9"}) {
        const std::string line = std::string("kerf = ") + kerf;
        const std::string thin = replaced(replaced(robot_cell(), "kerf = 3.0", line), "size = [300.0, 300.0, 200.0]",
                                          "size = [300.0, 300.0, 40.0]");
        const std::string text =
            replaced(replaced(thin, "size = [1000.0, 600.0, 500.0]", "size = [1000.0, 600.0, 40.0]"),
                     "size = [600.0, 400.0, 400.0]", "size = [600.0, 400.0, 40.0]");
        const std::string what = refused(text);
        if (std::string(kerf) == "39.9") {
            EXPECT_EQ(what, "taken");
            continue;
        }
        EXPECT_EQ(what.find("cell.toml:" + std::to_string(line_of(text, line)) +
                            ": stock.kerf: leaves nothing of the block's smallest side"),
                  0U)
            << what;
    }
}

}  // namespace
}  // namespace qchopper
