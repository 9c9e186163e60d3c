// Every command that the program prints for the next step is run as it stands, by the words that a shell makes of it.

#include <gtest/gtest.h>
#include <signal.h>
#include <wordexp.h>

#include <algorithm>
#include <sstream>

#include "app/cli/exit_code.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using program::Arguments;
using program::Ended;

// What begins a line that names a next step.
constexpr const char* beginnings[] = {"Next: ", "Nothing was cut. Take one by: ", "One piece: "};

std::vector<std::string> next_steps(const Ended& ended) {
    std::vector<std::string> steps;
    std::istringstream text(ended.out + "\n" + ended.err);
    for (std::string line; std::getline(text, line);) {
        for (const std::string beginning : beginnings) {
            if (line.starts_with(beginning)) steps.push_back(line.substr(beginning.size()));
        }
    }
    return steps;
}

// As a POSIX shell reads the line; without the name of the program.
Arguments words_of(const std::string& command) {
    wordexp_t words{};
    EXPECT_EQ(::wordexp(command.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF), 0) << command;
    Arguments arguments(words.we_wordv, words.we_wordv + words.we_wordc);
    ::wordfree(&words);
    EXPECT_FALSE(arguments.empty());
    if (arguments.empty()) return arguments;
    EXPECT_EQ(arguments.front(), "qchopper") << command;
    arguments.erase(arguments.begin());
    return arguments;
}

struct NextStep : ::testing::Test {
    program::Folder folder;
    std::unique_ptr<program::Process> cell;
    std::string cell_address;  // where the simulated cell listens

    Ended run(const Arguments& arguments) const { return program::run(arguments, {folder.path}); }

    // A simulated cell of the file; its drop folder is "drop".
    void start_cell(const fs::path& cell_file) {
        fs::create_directory(folder.path / "drop");
        cell = std::make_unique<program::Process>(Arguments{"cell-sim", "--listen", "127.0.0.1:0", "--drop", "drop",
                                                            "--cell", cell_file.string(), "--speed", "100000"},
                                                  program::RunOptions{folder.path});
        cell_address = program::address_of(*cell);
    }
    // A copy of the cell file with the address of the simulated cell.
    fs::path with_its_address(const fs::path& cell_file) const {
        std::string text = program::bytes_in(cell_file);
        const std::string listed = "127.0.0.1:15020";
        const std::size_t at = text.find(listed);
        EXPECT_NE(at, std::string::npos);
        program::put(folder.path / "cell.toml", text.replace(at, listed.size(), cell_address));
        return folder.path / "cell.toml";
    }
    // What a person fills in.
    Arguments completed(Arguments words) const {
        for (std::string& word : words) {
            if (word == "DIR") word = "drop";
            if (word == "HOST:PORT") word = cell_address;
            if (word == "K") word = "1";
        }
        return words;
    }
    // Runs each step that `ended` prints, and those that these print, at a terminal where a person says yes: the cap
    // stands on its rim, and dispatch asks. Returns all commands in their order.
    std::vector<std::string> follow(const Ended& ended) const {
        program::RunOptions terminal{folder.path, "y\n"};
        terminal.has_terminal = true;
        std::vector<std::string> done;
        std::vector<std::string> left = next_steps(ended);
        while (!left.empty() && done.size() < 10) {
            const std::string step = left.front();
            left.erase(left.begin());
            if (std::find(done.begin(), done.end(), step) != done.end()) continue;
            done.push_back(step);
            const Ended next = program::run(completed(words_of(step)), terminal);
            EXPECT_EQ(next.code, exit_done) << step << "\n" << next.err << next.out;
            for (const std::string& more : next_steps(next)) left.push_back(more);
        }
        return done;
    }
    static std::string all(const std::vector<std::string>& steps) {
        std::string text;
        for (const std::string& step : steps) text += step + "\n";
        return text;
    }
};

// Six tools, one job with a program of several.
TEST_F(NextStep, LeadsFromPrepareToTheEndOfEveryJobForACellWithAMachine) {
    const fs::path file = fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml";
    start_cell(file);
    write_file(folder.path / "cap.ply", to_ply(ball_cap()));
    const Ended made = run({"prepare", "cap.ply", "--units", "mm", "--cell", with_its_address(file).string(),
                            "--preset", "thesis", "--max-cuts", "0", "-o", "a cap's project.qch"});
    ASSERT_EQ(made.code, 0) << made.err << made.out;
    ASSERT_NE(made.out.find("verified"), std::string::npos) << made.out;
    const std::string name = R"('a cap'\''s project.qch')";
    EXPECT_EQ(all(follow(made)), "qchopper dry-run " + name + "\nqchopper dispatch " + name + " --drop DIR\n");
    EXPECT_NE(cell->err().find("STARTED"), std::string::npos) << "the cell has carved: " << cell->err();
}

TEST_F(NextStep, LeadsFromPrepareToTheEndOfEveryJobForACellWithoutAMachine) {
    start_cell(program::foam_cell());
    write_file(folder.path / "cap.ply", to_ply(ball_cap()));
    const Ended made =
        run({"prepare", "cap.ply", "--units", "mm", "--cell", with_its_address(program::foam_cell()).string(),
             "--preset", "thesis", "--max-cuts", "0", "-o", "./-p q.qch"});
    ASSERT_EQ(made.code, 0) << made.err << made.out;
    EXPECT_EQ(all(follow(made)), "qchopper dry-run './-p q.qch'\nqchopper dispatch './-p q.qch' --drop DIR\n");
}

TEST_F(NextStep, NamesWhatTheCellFileLeavesOpen) {
    start_cell(program::foam_cell());
    write_file(folder.path / "cap.ply", to_ply(ball_cap()));
    std::string text = program::bytes_in(program::foam_cell());
    text.erase(text.find("[link]"));
    program::put(folder.path / "cell.toml", text);
    const Ended made = run({"prepare", "cap.ply", "--units", "mm", "--cell", "cell.toml", "--preset", "thesis",
                            "--max-cuts", "0", "-o", "p.qch"});
    ASSERT_EQ(made.code, 0) << made.err << made.out;
    EXPECT_EQ(all(follow(made)), "qchopper dry-run p.qch\nqchopper dispatch p.qch --to HOST:PORT --drop DIR\n");
}

// Nothing can be handed over: the table of setups says why.
TEST_F(NextStep, OfAPieceThatDoesNotFitIsItsSetup) {
    write_file(folder.path / "cap.ply", to_ply(ball_cap()));
    const Ended made = run({"prepare", "cap.ply", "--units", "mm", "--scale", "100", "--cell",
                            program::foam_cell().string(), "--preset", "thesis", "--max-cuts", "0", "-o", "p.qch"});
    ASSERT_EQ(made.code, exit_demand_broken) << made.err << made.out;
    const std::vector<std::string> steps = follow(made);
    ASSERT_FALSE(steps.empty());
    EXPECT_EQ(steps.front(), "qchopper setup p.qch");
}

TEST_F(NextStep, OfTheOtherCommandsRunsToo) {
    fs::copy(program::prepared() / "scan.qch", folder.path / "a b.qch", fs::copy_options::recursive);
    fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
    for (const Arguments& arguments : {Arguments{"setup", "a b.qch"}, Arguments{"segment", "a b.qch", "--step"}}) {
        const Ended ended = run(arguments);
        ASSERT_EQ(ended.code, 0) << ended.err;
        EXPECT_FALSE(next_steps(ended).empty()) << ended.out;
        follow(ended);
    }
}

}  // namespace
}  // namespace qchopper
