// Names that options had before are taken for one version more, and help does not show them.

#include <gtest/gtest.h>

#include "app/cli/exit_code.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

struct OlderOption {
    program::Arguments command;  // of a file that is not there
    std::string older, now;
    std::string value;
};

TEST(OlderOptions, AreTakenAndNotShown) {
    const program::Folder folder;
    const program::Arguments repair{"repair", "none.ply", "-o", "x.ply", "--units", "mm"};
    const program::Arguments to_stl{"export", "none.qch", "--format", "stl", "--max-faces", "9"};
    const OlderOption options[] = {
        {{"setup", "none.qch", "--piece", "A"}, "--directions", "--orientations", "3"},
        {repair, "--weld", "--snap-borders", "0.1"},
        {repair, "--wrap", "--alpha-wrap", "2"},
        {repair, "--crumbs", "--fragments", "drop"},
        {to_stl, "--max-deviation", "--max-distance", "1"},
    };
    for (const OlderOption& option : options) {
        const std::string help = program::run({option.command[0], "--help"}, {folder.path}).out;
        EXPECT_NE(help.find(option.now + " "), std::string::npos) << option.now;
        EXPECT_EQ(help.find(option.older + " "), std::string::npos) << option.older;
        for (const std::string& name : {option.older, option.now}) {
            program::Arguments arguments = option.command;
            arguments.insert(arguments.end(), {name, option.value});
            EXPECT_NE(program::run(arguments, {folder.path}).code, exit_use) << name << " is taken";
            arguments.back() = "-1";
            EXPECT_EQ(program::run(arguments, {folder.path}).code, exit_use) << name;
        }
    }
}

TEST(OlderOptions, StepsOfRepairTooAreTakenByTheirOlderNames) {
    const program::Folder folder;
    for (const auto& [step, code] : {std::pair{"outwards", exit_missing},
                                     {"orient_outward", exit_missing},
                                     {"no_area", exit_missing},
                                     {"inwards", exit_use}}) {
        EXPECT_EQ(program::run({"repair", "none.ply", "-o", "x.ply", "--skip", step}, {folder.path}).code, code)
            << step;
    }
}

}  // namespace
}  // namespace qchopper
