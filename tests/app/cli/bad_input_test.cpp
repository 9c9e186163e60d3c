// Every way to go wrong that a person can mend: the right exit code, one line that says what, why, what is unchanged
// and what to do, the same as one document with --json, and nothing left behind.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/cli/exit_code.h"
#include "app/store/project_folder.h"
#include "tests/app/cli/program.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using program::Arguments;
using program::bytes_in;
using program::put;

// What has to live as long as the program runs: a lock, a listening socket.
using Kept = std::shared_ptr<void>;

struct Case {
    std::string name;
    ExitCode code;
    Arguments arguments;
    std::vector<std::string> words;                     // that the line must hold
    std::function<Kept(const fs::path&)> arrange = {};  // what lies in the folder, besides a sound scan.ply
    std::string unchanged = "Nothing was written.";
};

void PrintTo(const Case& c, std::ostream* out) {
    *out << c.name;
}

// An empty socket file descriptor that is closed at the end.
struct Socket {
    int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    Socket() {
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        if (::bind(descriptor, reinterpret_cast<sockaddr*>(&address), size) != 0) throw std::runtime_error("bind");
        ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
    }
    ~Socket() { ::close(descriptor); }
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    std::string text() const { return "127.0.0.1:" + std::to_string(ntohs(address.sin_port)); }
};
// Bound, but nobody listens: no other program can take the port while the tests run.
const Socket& deaf() {
    static const Socket socket;
    return socket;
}
// Listens and never says a word.
const Socket& mute() {
    static const Socket socket;
    static const int listening = ::listen(socket.descriptor, 8);
    EXPECT_EQ(listening, 0);
    return socket;
}

using Arrange = std::function<Kept(const fs::path&)>;

Arrange file(const std::string& name, const std::string& bytes) {
    return [=](const fs::path& folder) {
        put(folder / name, bytes);
        return Kept();
    };
}

std::string ascii_ply(const std::string& points, int faces = 4) {
    return "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element face " +
           std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n" + points +
           (faces == 4 ? "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n" : "");
}

std::string cut_short(const std::string& text) {
    return text.substr(0, text.size() - 20);
}

// The cell file of the project with one text in it replaced.
Arrange cell_with(const std::string& old_text, const std::string& new_text) {
    return [=](const fs::path& folder) {
        std::string text = bytes_in(program::foam_cell());
        const std::size_t at = text.find(old_text);
        if (at == std::string::npos) throw std::runtime_error(old_text + " is not in the cell file");
        put(folder / "cell.toml", text.replace(at, old_text.size(), new_text));
        return Kept();
    };
}

// A copy of the prepared project; what is done to it is the fault.
Arrange project(const std::function<Kept(const fs::path&)>& fault = {}) {
    return [=](const fs::path& folder) {
        fs::copy(program::prepared() / "scan.qch", folder / "p.qch", fs::copy_options::recursive);
        return fault ? fault(folder / "p.qch") : Kept();
    };
}

Arrange project_text(const std::function<std::string(std::string)>& change) {
    return project([=](const fs::path& folder) {
        put(folder / "project.json", change(bytes_in(folder / "project.json")));
        return Kept();
    });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at == std::string::npos) throw std::runtime_error(from + " is not in the text");
    return text.replace(at, from.size(), to);
}

Arguments prepare(const std::string& scan, const Arguments& more = {"-o", "p.qch"}) {
    Arguments arguments = program::prepare_arguments(scan);
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}
Arguments prepare_for(const std::string& cell) {
    return {"prepare", "scan.ply", "--units", "mm", "--cell", cell, "-o", "p.qch"};
}
Arguments dispatch(const std::string& to, const std::string& project_folder = "p.qch") {
    return {"dispatch", project_folder, "--to", to, "--drop", "."};
}

const std::string no_start = "The project is unchanged, and this dispatch started no job.";
const std::string same_project = "The project is unchanged.";

std::vector<Case> scans() {
    const std::string zero = "0 0 0\n1 0 0\n0 1 0\n";
    return {
        {"MissingFile", exit_missing, prepare("no.ply"), {"no.ply", "No such file"}},
        {"MissingFileOfInspect", exit_missing, {"inspect", "no.ply"}, {"no.ply"}, {}, "Nothing was changed."},
        {"FolderInPlaceOfScan", exit_missing, {"prepare", "."}, {"is a folder, but no project"}},
        {"EmptyFile", exit_mesh, prepare("bad.ply"), {"bad.ply", "empty"}, file("bad.ply", "")},
        {"NeitherPlyNorStl", exit_mesh, prepare("bad.ply"), {"bad.ply"}, file("bad.ply", "Dear Sir or Madam,\n")},
        {"TruncatedFile",
         exit_mesh,
         prepare("bad.ply"),
         {"bad.ply", "more than the file has room for"},
         [](const fs::path& folder) {
             const std::string bytes = bytes_in(folder / "scan.ply");
             put(folder / "bad.ply", bytes.substr(0, bytes.size() / 2));
             return Kept();
         }},
        {"TruncatedHeader", exit_mesh, prepare("bad.ply"), {"bad.ply"}, file("bad.ply", ascii_ply("").substr(0, 60))},
        {"TruncatedText",
         exit_mesh,
         prepare("bad.ply"),
         {"bad.ply"},
         file("bad.ply", cut_short(ascii_ply(zero + "0 0 1\n")))},
        {"NanCoordinates",
         exit_mesh,
         prepare("bad.ply"),
         {"bad.ply", "line 13", "not a finite number"},
         file("bad.ply", ascii_ply(zero + "0 nan 1\n"))},
        {"ZeroFaces",
         exit_mesh,
         prepare("bad.ply"),
         {"bad.ply", "no face"},
         file("bad.ply", ascii_ply(zero + "0 0 1\n", 0))},
    };
}

std::vector<Case> uses() {
    return {
        {"UnknownUnits", exit_use, {"prepare", "scan.ply", "--units", "furlong"}, {"furlong", "mm, cm, m, in"}},
        {"MissingUnits", exit_use, {"prepare", "scan.ply"}, {"no unit", "--units mm"}},
        {"MissingCell", exit_use, {"prepare", "scan.ply", "--units", "mm"}, {"no cell", "--cell FILE"}},
        {"MissingOutput",
         exit_use,
         {"prepare", "scan.ply", "--units", "mm", "--cell", "cell.toml"},
         {"no project folder", "-o NAME.qch"}},
        {"ScaleOfNothing", exit_use, prepare("scan.ply", {"--scale", "0"}), {"--scale", "\"0\""}},
        {"FinestToolOfACellOfBoxes",
         exit_use,
         prepare("scan.ply", {"-o", "p.qch", "--finest-tool", "6"}),
         {"no machine", "--fine"}},
        {"FinestToolLargerThanAll",
         exit_use,
         {"prepare", "scan.ply", "--units", "mm", "--cell", std::string(QCHOPPER_SOURCE_DIR) + "/cells/kr60-ha.toml",
          "-o", "new.qch", "--finest-tool", "100"},
         {"100 mm or more", "--finest-tool"}},
        {"UnknownCommand", exit_use, {"inspct", "scan.ply"}, {"\"inspct\" is no command", "did you mean \"inspect\"?"}},
        {"CommandLikeNoOther", exit_use, {"fry", "scan.ply"}, {"\"fry\" is no command"}},
        {"NoCommand", exit_use, {}, {"--help"}},
        {"UnknownOption", exit_use, {"inspect", "scan.ply", "--bogus"}, {"--bogus"}},
        {"MisspeltOption",
         exit_use,
         {"inspect", "scan.ply", "--unit", "mm"},
         {"--unit is no option of qchopper inspect", "did you mean \"--units\"?", "qchopper inspect --help"}},
        {"MisspeltOptionOfAnInnerCommand",
         exit_use,
         {"cells", "reach", "cell.toml", "--tild=30"},
         {"--tild is no option of qchopper cells reach", "did you mean \"--tilt\"?"}},
        {"MisspeltInnerCommand", exit_use, {"cells", "chek", "cell.toml"}, {"did you mean \"check\"?"}},
        {"DiscardBelowNothing",
         exit_use,
         prepare("scan.ply", {"--discard", "below=0ml"}),
         {"below=0ml", "A,C,below=50ml"}},
        {"DiscardWithoutAUnit", exit_use, prepare("scan.ply", {"--discard", "below=5"}), {"below=5", "A,C,below=50ml"}},
        {"MissingArgument", exit_use, {"inspect"}, {"SCAN"}},
        {"UnknownPreset", exit_use, {"prepare", "scan.ply", "--preset", "hare"}, {"hare", "bunny"}},
        {"TooFewFaces", exit_use, {"sample", "femur", "--faces", "3", "-o", "f.ply"}, {"2000", "3"}},
        {"FuseOfNoList", exit_missing, {"fuse", "no.conf", "-o", "f.ply"}, {"no.conf"}},
        {"FuseOfAMesh", exit_mesh, {"fuse", "scan.ply", "-o", "f.ply"}, {"scan.ply", "fewer than two scans"}},
        {"FuseByNoLength", exit_use, {"fuse", "no.conf", "--voxel", "-1", "-o", "f.ply"}, {"--voxel"}},
        {"SampleOfNoFormat", exit_use, {"sample", "femur", "-o", "f.obj"}, {"f.obj", ".ply"}},
    };
}

std::vector<Case> cells() {
    const std::string key = "clearance = 20.0";
    return {
        {"CellFileMissing", exit_missing, prepare_for("no.toml"), {"no.toml"}},
        {"ImpossibleCellFile",
         exit_config,
         prepare_for("cell.toml"),
         {"cell.toml", "reach"},
         cell_with("max = [1200.0", "max = [-1300.0")},
        {"UnknownKeyInTheCellFile",
         exit_config,
         prepare_for("cell.toml"),
         {"cell.toml", ":8:", "clearence", "clearance?"},
         cell_with(key, "clearence = 20.0")},
        {"CellFileThatIsNoToml",
         exit_config,
         prepare_for("cell.toml"),
         {"cell.toml:8:", "not TOML"},
         cell_with(key, "<xml>")},
    };
}

std::vector<Case> outputs() {
    return {
        {"OutputExists",
         exit_create,
         prepare("scan.ply"),
         {"p.qch exists already"},
         [](const fs::path& folder) {
             fs::create_directory(folder / "p.qch");
             return Kept();
         }},
        {"OutputIsAProject", exit_create, prepare("scan.ply"), {"go on with it by: qchopper prepare p.qch"}, project()},
        {"OutputInNoFolder", exit_create, prepare("scan.ply", {"-o", "no/p.qch"}), {"no/p.qch", "no folder no"}},
        {"OutputInAFile", exit_create, prepare("scan.ply", {"-o", "scan.ply/p.qch"}), {"no folder scan.ply"}},
        {"OutputNameTooLong",
         exit_create,
         prepare("scan.ply", {"--quiet", "-o", std::string(250, 'n') + ".qch"}),
         {"cannot be made", "too long"}},
        {"SampleOverAFile",
         exit_create,
         {"sample", "femur", "--faces", "2000", "-o", "f.ply"},
         {"f.ply exists already", "choose another name"},
         file("f.ply", "what was there")},
        {"CommandsQuoteWhatAShellWouldPartInTwo",
         exit_create,
         prepare("scan.ply", {"-o", "my bone's.qch"}),
         {"go on with it by: qchopper prepare 'my bone'\\''s.qch'"},
         [](const fs::path& folder) {
             fs::copy(program::prepared() / "scan.qch", folder / "my bone's.qch", fs::copy_options::recursive);
             return Kept();
         }},
        {"SampleInNoFolder", exit_create, {"sample", "femur", "--faces", "2000", "-o", "no/f.ply"}, {"no/f.ply"}},
    };
}

Kept lock_of(const fs::path& folder) {
    return std::make_shared<ProjectLock>(folder);
}

std::vector<Case> projects() {
    const Arguments go_on{"prepare", "p.qch"};
    return {
        {"BrokenProject", exit_config, go_on, {"p.qch/project.json"}, project_text([](const std::string& text) {
             return text.substr(0, text.size() / 2);
         })},
        {"ProjectOfAnotherVersion",
         exit_config,
         go_on,
         {"p.qch/project.json", "schema"},
         project_text(
             [](const std::string& text) { return replaced(text, "qchopper-project-4", "qchopper-project-9"); })},
        {"BrokenProjectInADryRun",
         exit_config,
         {"dry-run", "p.qch"},
         {"p.qch/project.json"},
         project_text([](const std::string&) { return "[1, 2"; }),
         same_project},
        {"NoProject", exit_missing, {"dry-run", "p.qch"}, {"p.qch", "no project"}, {}, same_project},
        {"LockedProject", exit_busy, go_on, {"p.qch"}, project(lock_of)},
        {"ProjectOptionsRepeated",
         exit_use,
         {"prepare", "p.qch", "--min-cuts", "3"},
         {"settings were fixed"},
         project()},
        {"SafetyStopRepeated", exit_use, {"prepare", "p.qch", "--max-cuts", "3"}, {"settings were fixed"}, project()},
        {"SafetyStopWithoutASearch",
         exit_use,
         {"segment", "p.qch", "--max-cuts", "3"},
         {"--max-cuts", "use them with --auto"},
         project()},
        {"UnreachableShareWithoutASearch",
         exit_use,
         {"segment", "p.qch", "--step", "--max-unreachable", "0.02"},
         {"options of the search", "use them with --auto"},
         project()},
        {"UnreachableShareAsAPercentage",
         exit_use,
         {"segment", "p.qch", "--auto", "--max-unreachable", "2"},
         {"--max-unreachable", "a share from 0 to 1"},
         project()},
        {"AnotherScanInTheOldPlace",
         exit_mesh,
         go_on,
         {"is not the scan"},
         [](const fs::path& folder) {
             project()(folder);
             put(folder / "other.ply", replaced(bytes_in(folder / "scan.ply"), "ply\n", "ply\ncomment another\n"));
             const fs::path json = folder / "p.qch" / "project.json";
             put(json, replaced(bytes_in(json), (program::prepared() / "scan.ply").string(),
                                (folder / "other.ply").string()));
             return Kept();
         },
         same_project},
        {"ScanGone",
         exit_missing,
         go_on,
         {"gone.ply"},
         project_text([](const std::string& text) { return replaced(text, "scan.ply", "gone.ply"); }),
         same_project},
        {"UnfinishedProjectInADryRun",
         exit_use,
         {"dry-run", "p.qch"},
         {"not finished", "qchopper prepare p.qch"},
         project_text([](const std::string& text) {
             nlohmann::ordered_json project = nlohmann::ordered_json::parse(text);
             project["stage"] = "cutting";
             project["jobs"] = nlohmann::ordered_json::array();
             return project.dump(1) + "\n";
         }),
         same_project},
        {"UnfinishedProjectInADispatch",
         exit_use,
         {"dispatch", "p.qch"},
         {"not finished", "qchopper prepare p.qch"},
         project_text([](const std::string& text) { return replaced(text, "\"done\"", "\"cut\""); }),
         no_start},
        {"UnknownPiece", exit_use, {"dry-run", "p.qch", "--piece", "ZZ"}, {"no piece ZZ"}, project(), same_project},
        {"BrokenJob",
         exit_mesh,
         {"dry-run", "p.qch", "--piece", "C"},
         {"C.qjob", "piece.stl"},
         project([](const fs::path& folder) {
             std::string bytes = bytes_in(folder / "jobs" / "C.qjob");
             bytes.at(bytes.find("piece.stl") + 2000) ^= 1;
             put(folder / "jobs" / "C.qjob", bytes);
             return Kept();
         }),
         same_project},
    };
}

std::vector<Case> links() {
    const std::string no_cell = "No cell was started.";
    return {
        {"CellNotReachable",
         exit_unreachable,
         dispatch(deaf().text()),
         {deaf().text(), "refused"},
         project(),
         no_start},
        {"ListensAndNeverAnswers",
         exit_unreachable,
         dispatch(mute().text()),
         {mute().text(), "the cell does not answer"},
         project(),
         no_start},
        {"AddressThatIsNone",
         exit_use,
         dispatch("127.0.0.1:99999"),
         {"127.0.0.1:99999", "HOST:PORT"},
         project(),
         no_start},
        {"DispatchWithoutProject", exit_missing, dispatch(deaf().text(), "no.qch"), {"no.qch"}, {}, no_start},
        {"CellSimWithoutDropFolder", exit_missing, {"cell-sim", "--drop", "no"}, {"drop folder no"}, {}, no_cell},
        {"CellSimWithoutAnyFolder", exit_use, {"cell-sim"}, {"--drop FOLDER"}, {}, no_cell},
        {"CellSimWithoutItsScript", exit_missing, {"cell-sim", "--drop", ".", "--script", "no"}, {"no"}, {}, no_cell},
        {"CellSimForEverybody",
         exit_use,
         {"cell-sim", "--drop", ".", "--listen", "0.0.0.0:0"},
         {"0.0.0.0:0", "--allow"},
         {},
         no_cell},
        {"CellSimForAName",
         exit_use,
         {"cell-sim", "--drop", ".", "--listen", "127.0.0.1:0", "--allow", "192.0.2.1,office-pc"},
         {"\"office-pc\"", "no numeric address", "192.168.1.20"},
         {},
         no_cell},
        {"CellSimForARange",
         exit_use,
         {"cell-sim", "--drop", ".", "--listen", "127.0.0.1:0", "--allow", "192.0.2.0/24"},
         {"\"192.0.2.0/24\"", "no numeric address"},
         {},
         no_cell},
        {"CellSimForNobody",
         exit_use,
         {"cell-sim", "--drop", ".", "--listen", "0.0.0.0:0", "--allow", ""},
         {"\"\"", "no numeric address"},
         {},
         no_cell},
        {"CellSimOnATakenPort",
         exit_create,
         {"cell-sim", "--drop", ".", "--listen", mute().text()},
         {mute().text()},
         {},
         no_cell},
    };
}

class BadInput : public ::testing::TestWithParam<Case> {};

TEST_P(BadInput, IsToldInOneLineAndLeavesNothingBehind) {
    const Case& c = GetParam();
    const program::Folder folder;
    fs::copy(program::prepared() / "scan.ply", folder.path / "scan.ply");
    const Kept kept = c.arrange ? c.arrange(folder.path) : Kept();
    const program::Contents before = program::contents(folder.path);

    const program::Ended ended = program::run(c.arguments, {folder.path});
    EXPECT_EQ(ended.code, c.code) << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_TRUE(ended.err.starts_with("qchopper: ")) << ended.err;
    for (const std::string& word : c.words)
        EXPECT_NE(ended.err.find(word), std::string::npos) << word << "\n" << ended.err;
    const std::size_t unchanged = ended.err.find(" " + c.unchanged + " To do: ");
    EXPECT_NE(unchanged, std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find(".."), std::string::npos) << ended.err;
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");

    Arguments with_json = c.arguments;
    with_json.emplace_back("--json");
    const program::Ended again = program::run(with_json, {folder.path});
    EXPECT_EQ(again.code, c.code);
    const auto document = nlohmann::json::parse(again.out, nullptr, false);
    ASSERT_TRUE(document.is_object()) << again.out;
    EXPECT_EQ(document["schema"], "qchopper-error-1");
    EXPECT_EQ(document["exit_code"], static_cast<int>(c.code));
    EXPECT_EQ(document["unchanged"], c.unchanged);
    EXPECT_NE(document["error"], "");
    EXPECT_NE(document["to_do"], "");
    EXPECT_TRUE(document.contains("remedy"));
    EXPECT_EQ(program::difference(before, program::contents(folder.path)), "");
}

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
    return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Scan, BadInput, ::testing::ValuesIn(scans()), name_of);
INSTANTIATE_TEST_SUITE_P(Use, BadInput, ::testing::ValuesIn(uses()), name_of);
INSTANTIATE_TEST_SUITE_P(CellFile, BadInput, ::testing::ValuesIn(cells()), name_of);
INSTANTIATE_TEST_SUITE_P(Output, BadInput, ::testing::ValuesIn(outputs()), name_of);
INSTANTIATE_TEST_SUITE_P(Project, BadInput, ::testing::ValuesIn(projects()), name_of);
INSTANTIATE_TEST_SUITE_P(Link, BadInput, ::testing::ValuesIn(links()), name_of);

}  // namespace
}  // namespace qchopper
