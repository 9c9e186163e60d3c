// `qchopper serve` as a process, asked over sockets, ended and killed.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "app/cli/exit_code.h"
#include "app/console/console_folder.h"
#include "app/engine/segment_project.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "tests/app/cli/program.h"
#include "tests/app/console/http_client.h"
#include "tests/app/console/worked.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using program::Process;

const std::string key = "0123456789abcdef0123456789abcdef";

// A server of the folder of a project, at a port that is free, with the key of a file.
struct Server {
    fs::path key_file;
    Process process;
    std::uint16_t port = 0;
    std::string host;

    explicit Server(const WorkedProject& p)
        : key_file(made_key(p.folder.path)),
          process({"serve", p.folder.path.string(), "--listen", "127.0.0.1:0", "--key-file", key_file.string()},
                  {p.folder.path}) {
        EXPECT_TRUE(process.waits_until_out("#key=")) << process.err();
        const std::string link = process.out();
        const std::string begin = "http://127.0.0.1:";
        EXPECT_TRUE(link.starts_with(begin)) << link;
        if (!link.starts_with(begin)) return;
        port = static_cast<std::uint16_t>(std::stoi(link.substr(begin.size())));
        host = "127.0.0.1:" + std::to_string(port);
    }
    static fs::path made_key(const fs::path& folder) {
        const fs::path file = folder / "console.key";
        program::put(file, key + "\n");
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
        return file;
    }
    ClientFields fields() const { return {{"Host", host}, {"Authorization", "Bearer " + key}}; }
    std::string get(const std::string& target) const { return request_text("GET", target, fields()); }
    std::string post(const std::string& target, const std::string& body, const std::string& revision = {}) const {
        static int made = 0;
        ClientFields all = fields();
        all.insert(all.end(), {{"Content-Type", "application/json"},
                               {"X-Request-Id", "request-" + std::to_string(++made)},
                               {"If-Match", "\"" + revision + "\""}});
        return request_text("POST", target, all, body);
    }
};

std::string project_path() {
    return "/api/projects/" + id_of_name("p.qch");
}

// Processes whose words hold this text.
std::vector<pid_t> processes_of(const std::string& text) {
    std::vector<pid_t> found;
    std::error_code error;
    for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (program::bytes_in(entry->path() / "cmdline").find(text) != std::string::npos) {
            found.push_back(std::stoi(name));
        }
    }
    return found;
}

bool comes_true(const auto& condition, std::chrono::milliseconds limit = 20s) {
    const Clock::time_point until = Clock::now() + limit;
    while (!condition()) {
        if (Clock::now() > until) return false;
        std::this_thread::sleep_for(5ms);
    }
    return true;
}

TEST(Serve, PrintsOneLineTheLinkAndSaysThatItIsNoSafetyDevice) {
    const WorkedProject p;
    Server server(p);
    EXPECT_EQ(server.process.out(), "http://" + server.host + "/#key=" + key + "\n");
    EXPECT_NE(server.process.err().find("no safety device"), std::string::npos);
    HttpClient client(server.port);
    const GotAnswer hello = client.ask(request_text("GET", "/api/hello", {{"Host", server.host}}));
    EXPECT_EQ(hello.status, 200U);
    EXPECT_EQ(hello.field("X-Content-Type-Options"), "nosniff");
    EXPECT_EQ(client.ask(server.get("/api/state")).status, 200U);
    EXPECT_EQ(HttpClient(server.port).ask(request_text("GET", "/api/state", {{"Host", server.host}})).status, 401U);
    EXPECT_EQ(HttpClient(server.port).ask(request_text("GET", "/api/hello", {{"Host", "evil.example"}})).status, 403U);
    EXPECT_EQ(HttpClient(server.port).ask("GET /api/hello HTTP/1.0\r\nHost: " + server.host + "\r\n\r\n").status, 403U);
    EXPECT_EQ(HttpClient(server.port).ask(server.get("/%2e%2e/etc/passwd")).status, 400U);
    EXPECT_EQ(HttpClient(server.port).ask(server.get("/../etc/passwd")).status, 404U);
}

TEST(Serve, AServerWithoutAKeyFileHasANewKeyEachTime) {
    const Folder folder;
    std::set<std::string> keys;
    for (int i = 0; i < 3; ++i) {
        Process process({"serve", folder.path.string(), "--listen", "127.0.0.1:0"}, {folder.path});
        ASSERT_TRUE(process.waits_until_out("\n"));
        const std::string out = process.out();
        const std::string digits = out.substr(out.find("#key=") + 5);
        EXPECT_EQ(digits.size(), 33U) << out;
        keys.insert(digits);
    }
    EXPECT_EQ(keys.size(), 3U);
}

TEST(Serve, AKeyThatOthersMayReadOrThatIsNoneIsRefused) {
    const Folder folder;
    const fs::path file = folder.path / "key";
    const auto refused = [&](const std::string& word) {
        const program::Ended ended = program::run(
            {"serve", folder.path.string(), "--listen", "127.0.0.1:0", "--key-file", file.string()}, {folder.path});
        EXPECT_NE(ended.code, exit_done);
        EXPECT_EQ(ended.killed_by, 0);
        EXPECT_NE(ended.err.find(word), std::string::npos) << ended.err;
        EXPECT_EQ(ended.err.find(key), std::string::npos) << "a key is not said";
    };
    refused("key");
    program::put(file, key);
    for (const mode_t mode : {0644, 0640, 0604, 0620, 0601}) {
        ASSERT_EQ(::chmod(file.c_str(), mode), 0);
        refused("chmod 600");
    }
    for (const std::string& text : {std::string(), key.substr(1), key + "0", std::string(32, 'g'), std::string(32, ' '),
                                    key + "\n" + key, std::string(40, '\0')}) {
        program::put(file, text);
        ASSERT_EQ(::chmod(file.c_str(), 0600), 0);
        refused("openssl rand -hex 16");
    }
}

TEST(Serve, APortThatIsTakenAFolderThatIsNoneAndAnAddressThatIsNoneAreSaid) {
    const WorkedProject p;
    Server server(p);
    const auto said = [&](const fs::path& folder, const std::string& listen) {
        const program::Ended ended = program::run({"serve", folder.string(), "--listen", listen}, {p.folder.path});
        EXPECT_NE(ended.code, exit_done);
        EXPECT_EQ(ended.killed_by, 0);
        return ended.err;
    };
    EXPECT_NE(said(p.folder.path, server.host).find(server.host), std::string::npos);
    EXPECT_NE(said(p.folder.path / "gone", "127.0.0.1:0").find("gone"), std::string::npos);
    for (const char* address : {"", ":8720", "127.0.0.1:x", "127.0.0.1:70000", "203.0.113.7:8720"}) {
        EXPECT_NE(said(p.folder.path, address), "") << address;
    }
}

TEST(Serve, AnAddressOfSixIsNamedAsABrowserNamesIt) {
    const Folder folder;
    Process process({"serve", folder.path.string(), "--listen", "[::1]:0"}, {folder.path});
    if (!process.waits_until_out("\n")) GTEST_SKIP() << "no such address here: " << process.err();
    EXPECT_TRUE(process.out().starts_with("http://[::1]:")) << process.out();
}

// The target is two seconds on an idle machine; this is for one with much else to do.
constexpr auto end_limit = 10s;

TEST(Serve, EndsWithPagesOpenAndLeavesNoProcess) {
    const WorkedProject p(20'000);
    for (const int number : {SIGTERM, SIGINT}) {
        Server server(p);
        std::vector<HttpClient> clients;
        for (int i = 0; i < 8; ++i) {
            clients.emplace_back(server.port);
            ASSERT_TRUE(clients.back().send(server.get("/api/events")));
            ASSERT_TRUE(clients.back().reads_until("reset", 10s));
        }
        for (int i = 0; i < 20; ++i) clients.emplace_back(server.port);
        for (int i = 0; i < 12; ++i) {
            clients.emplace_back(server.port);
            static_cast<void>(clients.back().send(request_text("GET", "/api/state", {{"Host", server.host}})));
        }
        clients.emplace_back(server.port);
        const std::string weight = std::to_string(number);
        static_cast<void>(clients.back().send(server.post(
            project_path() + "/questions", R"({"rank":{"weights":{"fragility":)" + weight + "}}}", p.revision())));
        clients.emplace_back(server.port);
        static_cast<void>(clients.back().ask(
            server.post("/api/checks", Json{{"scan", id_of_name("scan.ply")}, {"deep", true}}.dump(), "0")));
        std::this_thread::sleep_for(200ms);
        const Clock::time_point begin = Clock::now();
        server.process.signal(number);
        const program::Ended ended = server.process.wait(20);
        EXPECT_LT(Clock::now() - begin, end_limit);
        EXPECT_EQ(ended.killed_by, 0) << ended.err;
        EXPECT_TRUE(comes_true([&] { return processes_of(p.folder.path.string()).empty(); }, end_limit));
    }
}

TEST(Serve, AWorkerEndsAtOnceWithItsServerInTheMiddleOfItsWork) {
    const WorkedProject p(100'000);
    Server server(p);
    HttpClient client(server.port);
    ASSERT_TRUE(client.send(server.post(project_path() + "/questions", R"({"rank":{}})", "0")));
    ASSERT_TRUE(comes_true([&] { return processes_of("console-worker").size() == 1 || writer_of(p.project); }));
    ASSERT_TRUE(comes_true([&] { return writer_of(p.project).has_value(); }));
    const std::string words = p.project.string();
    server.process.signal(SIGKILL);
    const Clock::time_point begin = Clock::now();
    // What ends has no words any more a moment before its lock is released.
    EXPECT_TRUE(comes_true([&] { return processes_of(words).empty() && !writer_of(p.project); }));
    EXPECT_LT(Clock::now() - begin, end_limit);
}

TEST(Serve, ASecondServerOfAFolderIsRefusedWithWhoServesItAndOneThatShowsIsNot) {
    const WorkedProject p;
    Server server(p);
    const program::Ended second =
        program::run({"serve", p.folder.path.string(), "--listen", "127.0.0.1:0"}, {p.folder.path});
    EXPECT_EQ(second.code, exit_busy) << second.err;
    EXPECT_NE(second.err.find("serve, process "), std::string::npos) << second.err;
    const std::vector<std::string> words{"serve", p.folder.path.string(), "--listen", "127.0.0.1:0", "--read-only"};
    Process shows(words, {p.folder.path});
    EXPECT_TRUE(shows.waits_until_out("#key=")) << shows.err();
    server.process.signal(SIGKILL);
    server.process.wait(20);
    Process alone(words, {p.folder.path});
    EXPECT_TRUE(alone.waits_until_out("#key=")) << alone.err();
    Server third(p);
    EXPECT_NE(third.port, 0) << "neither a kill nor who only shows leaves anything locked";
}

TEST(Serve, WorkAndTheSimulatedCellEndWithAServerThatIsKilled) {
    const WorkedProject p(100'000);
    const fs::path project = p.folder.path / "long.qch";
    WorkedProject::command(
        {"segment", p.scan.string(), "--units", "mm", "--cell", program::foam_cell().string(), "-o", project.string()});
    Process process({"serve", p.folder.path.string(), "--listen", "127.0.0.1:0", "--cell-sim", "--key-file",
                     Server::made_key(p.folder.path).string()},
                    {.folder = p.folder.path, .temporary_folder = p.folder.path});
    ASSERT_TRUE(process.waits_until_out("#key=")) << process.err();
    const std::string link = process.out();
    const std::string begin = "http://127.0.0.1:";
    const auto port = static_cast<std::uint16_t>(std::stoi(link.substr(begin.size())));
    const std::string folder = p.folder.path.string();
    ASSERT_EQ(processes_of(folder).size(), 2U) << "the server, and the cell, whose drop folder is there";
    HttpClient client(port);
    const ClientFields fields{{"Host", "127.0.0.1:" + std::to_string(port)},
                              {"Authorization", "Bearer " + key},
                              {"Content-Type", "application/json"},
                              {"X-Request-Id", "begin-prepare"},
                              {"If-Match", "\"" + revision_of_project(project) + "\""}};
    const GotAnswer begun = client.ask(
        request_text("POST", "/api/projects/" + id_of_name("long.qch") + "/work", fields, R"({"kind":"prepare"})"));
    ASSERT_EQ(begun.status, 202U) << begun.body;
    ASSERT_TRUE(comes_true([&] { return processes_of(folder).size() == 3 && writer_of(project); })) << "and the work";
    process.signal(SIGKILL);
    EXPECT_TRUE(comes_true([&] { return processes_of(folder).empty() && !writer_of(project); }));
    EXPECT_NE(load_project(project).stage, Stage::done) << "it was ended, and the project is whole";
}

// One decision of the course, for the page and as the command line takes it.
struct CourseStep {
    std::string body;
    ProjectRequest request;
    program::Arguments options;
};

CourseStep next_step(const Project& now, std::mt19937& random) {
    CourseStep step;
    const unsigned choice = random() % 4;
    if (choice == 0 && to_undo(now.history) != nullptr) {
        step.request.undo = true;
        step.body = Json{{"undo", undo_text(now.history)}}.dump();
        step.options = {"--undo"};
    } else if (choice == 1 && to_redo(now.history) != nullptr) {
        step.request.redo = true;
        step.body = Json{{"redo", redo_text(now.history)}}.dump();
        step.options = {"--redo"};
    } else if (choice == 2 && now.cuts.size() < 4) {
        const double offset = static_cast<double>(random() % 80) - 40;
        step.request.plane = Plane{{0, 1, 0}, offset};
        step.body = Json{{"cut", {{"plane", {0, 1, 0, offset}}}}}.dump();
        step.options = {"--plane=0,1,0," + std::to_string(static_cast<int>(offset))};
    } else {
        const double weight = 1 + 0.25 * static_cast<double>(random() % 1000);
        step.request.weights = GivenWeights{};
        step.request.weights->weight[1] = weight;
        step.body = Json{{"weights", {{"fragility", weight}}}}.dump();
        step.options = {"--weights", "fragility=" + std::to_string(weight)};
    }
    return step;
}

// Each of three decides for the project as it has last seen it, which it looks at again half of the time only.
TEST(Serve, ThreeHundredDecisionsOfTwoWindowsAndTheCommandLineAreTheAcceptedSequence) {
    const WorkedProject p;
    const fs::path copy = p.folder.path / "expected" / "p.qch";
    fs::create_directories(copy.parent_path());
    fs::copy(p.project, copy, fs::copy_options::recursive);
    Server server(p);
    std::mt19937 random(300);
    std::vector<ProjectRequest> accepted;
    std::vector<std::string> seen(2, p.revision());
    int stale = 0;
    int by_command = 0;
    std::vector<HttpClient> windows;
    for (int i = 0; i < 2; ++i) windows.emplace_back(server.port);
    for (int i = 0; i < 300; ++i) {
        const std::string before = p.revision();
        const CourseStep step = next_step(load_project(p.project), random);
        const unsigned who = random() % 3;
        if (who == 2) {
            program::Arguments words{"segment", p.project.string()};
            words.insert(words.end(), step.options.begin(), step.options.end());
            const program::Ended ended = program::run(words, {p.folder.path});
            ASSERT_TRUE(ended.code == exit_done || ended.code == exit_demand_broken) << ended.err;
            if (p.revision() != before) ++by_command;
        } else {
            if (random() % 2 == 0) seen[who] = before;
            const GotAnswer answer = windows[who].ask(server.post(project_path() + "/decisions", step.body, seen[who]));
            if (seen[who] != before) {
                ++stale;
                ASSERT_EQ(answer.status, 412U) << answer.body;
                ASSERT_EQ(p.revision(), before);
                continue;
            }
            ASSERT_TRUE(answer.status == 200 || answer.status == 409) << answer.body;
            ASSERT_EQ(answer.status == 200, p.revision() != before) << step.body;
            if (answer.status == 200) seen[who] = p.revision();
        }
        if (p.revision() != before) accepted.push_back(step.request);
    }
    EXPECT_GT(stale, 30);
    EXPECT_GT(by_command, 50);
    EXPECT_GT(accepted.size(), 150U);
    for (const ProjectRequest& request : accepted) segment_project(copy, {}, request, {});
    EXPECT_EQ(program::bytes_in(copy / "project.json"), program::bytes_in(p.project / "project.json"));
}

TEST(Serve, KillsInACourseLoseNoAnsweredDecision) {
    const WorkedProject p;
    const fs::path copy = p.folder.path / "expected" / "p.qch";
    std::mt19937 random(20);
    int answered = 0;
    // A busy machine answers less between two kills: there are more of them then.
    constexpr int enough = 20;
    for (int kills = 0; kills < kills_wanted() || (answered <= enough && kills < 10 * kills_wanted()); ++kills) {
        Server server(p);
        const auto wait = std::chrono::milliseconds(50 + random() % 300);
        std::thread killer([&] {
            std::this_thread::sleep_for(wait);
            server.process.signal(SIGKILL);
        });
        HttpClient client(server.port);
        std::string stood = program::bytes_in(p.project / "project.json");
        CourseStep step;
        unsigned status = 1;
        while (status != 0) {
            stood = program::bytes_in(p.project / "project.json");
            step = next_step(load_project(p.project), random);
            const GotAnswer answer = client.ask(server.post(project_path() + "/decisions", step.body, p.revision()));
            status = answer.status;
            if (status == 200) {
                ++answered;
                EXPECT_EQ(Json::parse(answer.body).at("revision"), p.revision()) << "what is answered is on the disk";
            } else if (status != 0) {
                EXPECT_EQ(status, 409U) << answer.body;
            }
        }
        killer.join();
        ASSERT_TRUE(comes_true([&] { return processes_of(p.project.string()).empty(); }));
        const std::string is = program::bytes_in(p.project / "project.json");
        if (is == stood) continue;
        fs::remove_all(copy.parent_path());
        fs::create_directories(copy.parent_path());
        fs::copy(p.project, copy, fs::copy_options::recursive);
        program::put(copy / "project.json", stood);
        segment_project(copy, {}, step.request, {});
        EXPECT_EQ(program::bytes_in(copy / "project.json"), is) << "the unanswered one is whole: " << step.body;
    }
    EXPECT_GT(answered, enough);
}

}  // namespace
}  // namespace qchopper
