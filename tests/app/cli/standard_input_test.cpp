// A scan may come from standard input, packed or not, wherever it is read only once.

#include <gtest/gtest.h>

#include "app/cli/exit_code.h"
#include "segment/io/read_mesh.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

using program::Folder;

std::string scan() {
    return program::bytes_in(program::prepared() / "scan.ply");
}

TEST(StandardInput, IsInspectedLikeAFile) {
    const Folder folder;
    program::put(folder.path / "scan.ply", scan());
    const program::Ended file = program::run({"inspect", "scan.ply", "--units", "mm"}, {folder.path});
    const program::Ended input = program::run({"inspect", "-", "--units", "mm"}, {folder.path, scan()});
    EXPECT_EQ(input.code, exit_done) << input.err;
    EXPECT_EQ(input.out.substr(input.out.find('\n')), file.out.substr(file.out.find('\n')));
}

TEST(StandardInput, IsRepairedLikeAFile) {
    const Folder folder;
    program::put(folder.path / "scan.ply", scan());
    const program::Ended file = program::run({"repair", "scan.ply", "--units", "mm", "-o", "a.ply"}, {folder.path});
    const program::Ended input = program::run({"repair", "-", "--units", "mm", "-o", "b.ply"}, {folder.path, scan()});
    EXPECT_EQ(file.code, exit_done) << file.err;
    EXPECT_EQ(input.code, exit_done) << input.err;
    EXPECT_EQ(program::bytes_in(folder.path / "b.ply"), program::bytes_in(folder.path / "a.ply"));
}

TEST(StandardInput, IsNoScanForAProjectWhichNeedsItAgain) {
    const Folder folder;
    program::Arguments arguments = program::prepare_arguments("-");
    arguments.insert(arguments.end(), {"-o", "p.qch"});
    const program::Ended ended = program::run(arguments, {folder.path, scan()});
    EXPECT_EQ(ended.code, exit_use) << ended.err;
    EXPECT_NE(ended.err.find("save the scan in a file"), std::string::npos) << ended.err;
    EXPECT_TRUE(program::contents(folder.path).empty());
}

TEST(StandardInput, ThatIsEmptyOrNoScanIsRefused) {
    const Folder folder;
    for (const std::string& text : {std::string(), std::string("hello")}) {
        const program::Ended ended = program::run({"inspect", "-"}, {folder.path, text});
        EXPECT_EQ(ended.code, exit_mesh) << ended.err;
        EXPECT_NE(ended.err.find("standard input"), std::string::npos) << ended.err;
    }
}

}  // namespace
}  // namespace qchopper
