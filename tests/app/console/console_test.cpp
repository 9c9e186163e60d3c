// The console without its sockets, with the real program as worker and for work.

#include "app/console/console.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <set>

#include "app/console/console_folder.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "tests/app/console/worked.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

const std::string key(32, 'a');

struct ConsoleTest : ::testing::Test {
    WorkedProject p;
    Folder scratch;
    std::unique_ptr<Console> console;
    std::atomic<int> made = 0;

    void SetUp() override { start(false); }
    void start(bool is_read_only, std::chrono::milliseconds look_interval = 2s) {
        ConsoleOptions options;
        options.folder = p.folder.path;
        options.rules = {key, {"a"}, is_read_only};
        options.program = QCHOPPER_PROGRAM;
        options.version = "0";
        options.server = "5e1f";
        options.scratch = scratch.path;
        options.queue = scratch.path / "queue";
        options.look_interval = look_interval;
        console.reset();
        console = std::make_unique<Console>(std::move(options));
    }

    static HttpRequest head(const std::string& method, const std::string& target) {
        HttpRequest request{method, target, 11, {{"Host", "a"}, {"Authorization", "Bearer " + key}}, {}, true};
        if (method == "POST") request.fields.emplace_back("Content-Type", "application/json");
        return request;
    }
    HttpAnswer send(HttpRequest request) const {
        const auto admitted = console->admit(request);
        if (const auto* refused = std::get_if<HttpAnswer>(&admitted)) return *refused;
        EXPECT_LE(request.body.size(), std::get<HttpAdmission>(admitted).body_bytes);
        return console->answer(request);
    }
    HttpAnswer get(const std::string& target) const { return send(head("GET", target)); }
    HttpAnswer post(const std::string& target, const std::string& body, const std::string& revision = {},
                    std::string id = {}) {
        HttpRequest request = head("POST", target);
        if (id.empty()) id = "request-" + std::to_string(++made);
        request.fields.emplace_back("X-Request-Id", id);
        if (!revision.empty()) request.fields.emplace_back("If-Match", "\"" + revision + "\"");
        request.body = body;
        return send(request);
    }
    std::string project() const { return "/api/projects/" + id_of_name("p.qch"); }
    Json json_of(const HttpAnswer& answer) const {
        const Json json = Json::parse(answer.body, nullptr, false);
        EXPECT_FALSE(json.is_discarded()) << answer.body.substr(0, 300);
        return json;
    }
    Json work_of(const std::string& id) const {
        const Json state = json_of(get("/api/state"));
        for (const Json& work : state.at("work")) {
            if (work.at("id") == id) return work;
        }
        return {};
    }
    Json end_of(const HttpAnswer& begun) const {
        EXPECT_EQ(begun.status, 202U) << begun.body;
        if (begun.status != 202) return {};
        const std::string id = json_of(begun).at("work");
        const std::set<std::string> open{"queued", "running", "stopping"};
        const Clock::time_point until = Clock::now() + 60s;
        while (open.contains(work_of(id).at("state")) && Clock::now() < until) std::this_thread::sleep_for(10ms);
        return work_of(id);
    }
    std::size_t cuts() const { return load_project(p.project).cuts.size(); }
};

TEST_F(ConsoleTest, EveryAnswerHasTheGuardsAndNoCors) {
    for (const HttpAnswer& answer : {get("/api/hello"), get("/api/state"), get("/api/no/such"), get("/no.js"),
                                     post("/api/tickets", "{"), Console::fault(431), get("/%")}) {
        std::set<std::string> names;
        for (const auto& [name, value] : answer.fields) names.insert(name);
        for (const char* name : {"X-Content-Type-Options", "Referrer-Policy", "Cross-Origin-Opener-Policy",
                                 "Cross-Origin-Resource-Policy", "Content-Security-Policy", "Cache-Control"}) {
            EXPECT_TRUE(names.contains(name)) << name << " " << answer.body.substr(0, 100);
        }
        EXPECT_FALSE(names.contains("Access-Control-Allow-Origin"));
        EXPECT_FALSE(names.contains("Set-Cookie"));
    }
}

TEST_F(ConsoleTest, AStarIsNoId) {
    for (const char* target : {"/*", "/api/t/*", "/api/checks/*", "/api/projects/*", "/api/meshes/*",
                               "/api/meshes/*/states/*", "/api/paths/*", "/api/projects/*/outputs/*"}) {
        EXPECT_EQ(get(target).status, 404U) << target;
    }
}

TEST_F(ConsoleTest, AWayThatIsNotThereIsNamed) {
    const HttpAnswer answer = get("/api/paths/" + std::string(32, 'a'));
    EXPECT_EQ(answer.status, 404U);
    EXPECT_NE(answer.body.find("there is no way of a tool aaaa"), std::string::npos) << answer.body;
    EXPECT_EQ(get("/api/paths/x/y").status, 404U);
    EXPECT_EQ(post("/api/paths/" + std::string(32, 'a'), "{}").status, 405U);
}

// The project has no job yet: the work says so, and what to do.
TEST_F(ConsoleTest, AReplayWithoutAJobFailsWithItsDocument) {
    const Json work = end_of(post(project() + "/work", R"({"kind":"replay","piece":"A","part":1})", p.revision()));
    EXPECT_EQ(work.at("kind"), "replay");
    EXPECT_EQ(work.at("state"), "failed");
    EXPECT_EQ(work.at("error").at("unchanged"), "No job was changed.");
    EXPECT_FALSE(work.at("error").at("to_do").get<std::string>().empty());
}

TEST_F(ConsoleTest, IdsOfOthersLeadNowhere) {
    const std::string other = id_of_name("scan.ply");
    for (const std::string& id :
         {std::string("p.qch"), std::string("x"), other, std::string("..."), std::string("C1")}) {
        EXPECT_EQ(get("/api/projects/" + id).status, 404U) << id;
        EXPECT_EQ(get("/api/projects/" + id + "/outputs/guide.html").status, 404U) << id;
        EXPECT_EQ(get("/api/projects/" + id + "/outputs/project.json").status, 404U) << id;
        EXPECT_EQ(get("/api/checks/" + id).status, 404U) << id;
        EXPECT_EQ(post("/api/projects/" + id + "/decisions", R"({"reset":true})", "0").status, 404U) << id;
        EXPECT_EQ(post("/api/projects/" + id + "/questions", R"({"rank":{}})").status, 404U) << id;
        EXPECT_EQ(post("/api/checks/" + id + "/repair", "{}").status, 404U) << id;
        EXPECT_EQ(post("/api/checks", Json{{"scan", id}}.dump()).status, id == other ? 202U : 404U) << id;
    }
    EXPECT_EQ(get(project() + "/outputs/project.json").status, 404U) << "it is no output";
}

TEST_F(ConsoleTest, ADecisionIsTakenOnceAlsoIfItsAnswerIsLost) {
    const Json ranked = json_of(post(project() + "/questions", R"({"rank":{}})"));
    const std::string revision = p.revision();
    const std::string body = accept_body(ranked, 1);
    std::vector<std::thread> threads;
    std::vector<HttpAnswer> answers(8);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        threads.emplace_back([&, i] { answers[i] = post(project() + "/decisions", body, revision, "the-same-id"); });
    }
    for (std::thread& thread : threads) thread.join();
    for (const HttpAnswer& answer : answers) {
        EXPECT_EQ(answer.status, 200U) << answer.body;
        EXPECT_EQ(answer.body, answers[0].body);
    }
    EXPECT_EQ(cuts(), 1U);
    EXPECT_EQ(post(project() + "/decisions", body, revision, "another-id").status, 412U) << "of another window";
    EXPECT_EQ(post(project() + "/decisions", R"({"reset":true})", p.revision(), "the-same-id").status, 409U);
    EXPECT_EQ(cuts(), 1U);
}

TEST_F(ConsoleTest, TwoWindowsAndTheCommandLineMakeTheAcceptedSequence) {
    std::atomic<int> accepted = 0;
    std::atomic<int> stale = 0;
    const std::size_t before = load_project(p.project).history.decisions.size();
    std::vector<std::thread> windows;
    for (int w = 0; w < 2; ++w) {
        windows.emplace_back([&, w] {
            for (int i = 0; i < 20; ++i) {
                const std::string revision = p.revision();
                std::this_thread::sleep_for(std::chrono::milliseconds(3 * w));
                const double weight = 2 + w * 100 + i;
                const HttpAnswer answer =
                    post(project() + "/decisions", Json{{"weights", {{"fragility", weight}}}}.dump(), revision,
                         "window-" + std::to_string(w) + "-" + std::to_string(i));
                if (answer.status == 200) ++accepted;
                if (answer.status == 412) ++stale;
                EXPECT_TRUE(answer.status == 200 || answer.status == 412 || answer.status == 423) << answer.body;
            }
        });
    }
    int by_command = 0;
    for (int i = 0; i < 5; ++i) {
        const ChildOutput said = run_child(
            {QCHOPPER_PROGRAM, "segment", p.project.string(), "--weights", "fragility=" + std::to_string(1000 + i)},
            60s);
        if (said.code == 0) ++by_command;
    }
    for (std::thread& window : windows) window.join();
    EXPECT_GT(accepted, 5);
    EXPECT_EQ(load_project(p.project).history.decisions.size(),
              before + static_cast<std::size_t>(accepted + by_command));
}

TEST_F(ConsoleTest, ADecisionOfThePageIsToldAsThePages) {
    HttpAnswer stream = get("/api/events?after=" + json_of(get("/api/state")).at("event").get<std::string>());
    ASSERT_TRUE(stream.next_part);
    for (int i = 0; i < 5; ++i) {
        ASSERT_EQ(
            post(project() + "/decisions", Json{{"weights", {{"fragility", 20 + i}}}}.dump(), p.revision()).status,
            200U);
    }
    std::this_thread::sleep_for(700ms);  // so that the watch has looked at it too
    WorkedProject::command({"segment", p.project.string(), "--weights", "fragility=9"});
    std::string text;
    const Clock::time_point until = Clock::now() + 5s;
    while (Clock::now() < until && text.find("command line") == std::string::npos) {
        text += stream.next_part(250ms).value_or("");
    }
    std::size_t by_page = 0;
    for (std::size_t at = text.find(R"("by":"page")"); at != std::string::npos;
         at = text.find(R"("by":"page")", at + 1)) {
        ++by_page;
    }
    EXPECT_EQ(by_page, 5U) << text;
    EXPECT_NE(text.find(R"("by":"command line")"), std::string::npos) << text;
    std::size_t names = 0;
    for (std::size_t at = text.find("event: project"); at != std::string::npos;
         at = text.find("event: project", at + 1)) {
        ++names;
    }
    EXPECT_LE(names, 5U + 3U) << "5 of the page, and of the command line that it writes, what, and that it is done";
}

TEST_F(ConsoleTest, ADecisionOfTheCommandLineIsToldWithoutALookAtIntervals) {
    start(false, 1h);
    const auto is_seen = [&] { return json_of(get("/api/state")).at("projects").size() == 1; };
    const Clock::time_point until = Clock::now() + 60s;
    while (!is_seen() && Clock::now() < until) std::this_thread::sleep_for(10ms);
    ASSERT_TRUE(is_seen());
    HttpAnswer stream = get("/api/events?after=" + json_of(get("/api/state")).at("event").get<std::string>());
    for (int i = 0; i < 3; ++i) {
        WorkedProject::command({"segment", p.project.string(), "--weights", "fragility=" + std::to_string(7 + i)});
        std::string text;
        const Clock::time_point limit = Clock::now() + 60s;
        while (Clock::now() < limit && text.find(p.revision()) == std::string::npos) {
            text += stream.next_part(250ms).value_or("");
        }
        EXPECT_NE(text.find(R"("by":"command line")"), std::string::npos) << text;
        EXPECT_NE(text.find(p.revision()), std::string::npos) << text;
    }
    const ProjectLock lock(p.project);
    const auto has_writer = [&] { return json_of(get("/api/state")).at("projects").at(0).at("writer").is_string(); };
    const Clock::time_point end = Clock::now() + 60s;
    while (!has_writer() && Clock::now() < end) std::this_thread::sleep_for(10ms);
    EXPECT_TRUE(has_writer()) << "who writes it is told too";
}

TEST_F(ConsoleTest, TwoCellFilesThatNameOneAddressForTwoCellsAreRefusedClearly) {
    std::ifstream file(std::string(QCHOPPER_SOURCE_DIR) + "/cells/foam-1.toml");
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    const auto with_id = [&](const std::string& id) {
        const std::size_t at = text.find("\nid = ") + 6;
        std::string changed = text.substr(0, at) + id + text.substr(text.find('\n', at));
        const std::string port = ":15020";
        return changed.replace(changed.find(port), port.size(), ":9");
    };
    ASSERT_NE(text.find("\nid = "), std::string::npos);
    const fs::path other = p.folder.path / "q.qch";
    fs::copy(p.project, other, fs::copy_options::recursive);
    write_file(p.project / "cell.toml", with_id("41"));
    start(false);
    const auto plan = [&](const std::string& name) {
        return post("/api/projects/" + id_of_name(name) + "/plans", "{}", p.revision());
    };
    EXPECT_EQ(plan("p.qch").status, 502U) << "nobody answers there";
    write_file(other / "cell.toml", with_id("42"));
    const HttpAnswer refused = plan("q.qch");
    EXPECT_EQ(refused.status, 422U) << refused.body;
    EXPECT_NE(refused.body.find("cell 42"), std::string::npos) << refused.body;
    EXPECT_NE(refused.body.find("cell 41"), std::string::npos) << refused.body;
    write_file(other / "cell.toml", with_id("41"));
    fs::remove_all(p.project);
    EXPECT_EQ(post("/api/projects/" + id_of_name("q.qch") + "/plans", "{}", "0").status, 502U)
        << "the same cell, known also without the project that named it first";
    EXPECT_EQ(json_of(get("/api/state")).at("cells").size(), 1U);
}

TEST_F(ConsoleTest, WhileAnotherProgramWritesNothingIsDecided) {
    const std::string revision = p.revision();
    {
        const ProjectLock lock(p.project);
        EXPECT_EQ(post(project() + "/decisions", R"({"weights":{"fragility":2}})", revision).status, 423U);
        const Json shown = json_of(get(project()));
        EXPECT_TRUE(shown.at("segment").is_null());
        EXPECT_TRUE(shown.at("writer").is_string());
    }
    EXPECT_EQ(post(project() + "/decisions", R"({"weights":{"fragility":2}})", revision).status, 200U);
}

TEST_F(ConsoleTest, ManyWindowsThatLoadAtOnceAllSeeTheProject) {
    std::vector<std::thread> threads;
    std::atomic<int> seen = 0;
    for (int i = 0; i < 10; ++i) {
        threads.emplace_back([&] {
            const HttpAnswer shown = get(project());
            if (shown.status == 200 && json_of(shown).at("segment").is_object()) ++seen;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(seen, 10);
}

TEST_F(ConsoleTest, WhatAProjectShowsIsOfOneMoment) {
    std::atomic<bool> is_over = false;
    std::thread decider([&] {
        for (int i = 0; i < 15; ++i) {
            post(project() + "/decisions", Json{{"weights", {{"fragility", 20 + i}}}}.dump(), p.revision(),
                 "decide-" + std::to_string(i));
            const std::string undo = undo_text(load_project(p.project).history);
            if (i % 3 == 0) {
                post(project() + "/decisions", Json{{"undo", undo}}.dump(), p.revision(),
                     "undo-and-" + std::to_string(i));
            }
        }
        is_over = true;
    });
    while (!is_over) {
        const Json shown = json_of(get(project()));
        if (!shown.at("segment").is_object()) continue;
        const auto text = [](const Json& value) {
            return value.is_string() ? value.get<std::string>() : std::string();
        };
        EXPECT_EQ(text(shown.at("undo")).empty(), shown.at("segment").at("undo").is_null()) << shown.at("undo");
        EXPECT_EQ(text(shown.at("redo")).empty(), shown.at("segment").at("redo").is_null()) << shown.at("redo");
    }
    decider.join();
}

TEST_F(ConsoleTest, AScanIsCheckedAndMadeAProject) {
    const Json check = end_of(post("/api/checks", Json{{"scan", id_of_name("scan.ply")}, {"units", "mm"}}.dump()));
    ASSERT_EQ(check.at("state"), "done") << check;
    const std::string id = check.at("of");
    EXPECT_EQ(json_of(get("/api/checks/" + id)).at("inspect").at("schema").get<std::string>().rfind("qchopper-", 0),
              0U);
    const Json project_body{{"check", id}, {"name", "new one"}, {"units", "mm"}, {"preset", "thesis"}};
    const Json made_one = end_of(post("/api/projects", project_body.dump()));
    ASSERT_EQ(made_one.at("state"), "done") << made_one;
    EXPECT_TRUE(fs::exists(p.folder.path / "new one.qch" / "project.json"));
    EXPECT_EQ(get("/api/projects/" + made_one.at("result").at("project").get<std::string>()).status, 200U);
    const Json again = end_of(post("/api/projects", project_body.dump()));
    EXPECT_EQ(again.at("state"), "failed") << "it is there already";
    EXPECT_FALSE(again.at("error").at("error").get<std::string>().empty());
}

TEST_F(ConsoleTest, CutsAreMadeAgainOnAPaintedScanAndWhatDoesNotFitIsSaid) {
    WorkedProject::command({"segment", p.project.string(), "--plane", "1,0,0,0"});
    WorkedProject::command({"segment", p.project.string(), "--weights", "fragility=11"});
    WorkedProject::command({"sample", "femur", "--faces", "2000", "-o", (p.folder.path / "femur.ply").string()});
    const std::string revision = p.revision();
    const auto checked = [&](const std::string& scan) {
        return end_of(post("/api/checks", Json{{"scan", id_of_name(scan)}, {"units", "mm"}}.dump()));
    };
    const Json check = checked("scan.ply");
    const Json seen = json_of(get("/api/checks/" + check.at("of").get<std::string>())).at("inspect");
    const Json point{seen["max"][0], 0, 0, 1, 0, 0};
    const Json stroke{{"surface", "no_cut"}, {"radius_mm", 15}, {"points", Json::array({point})}};
    const Json body{{"check", check.at("of")},
                    {"name",
                     "Sch\xc3\xa4"
                     "del 3"},
                    {"units", "mm"},
                    {"cuts_of", id_of_name("p.qch")},
                    {"strokes", Json::array({stroke})}};
    const Json work = end_of(post("/api/projects", body.dump()));
    ASSERT_EQ(work.at("state"), "done") << work;
    EXPECT_EQ(work["result"]["segment"]["demand_met"], true) << work;
    const Project first = load_project(p.project);
    const Project again = load_project(p.folder.path /
                                       "Sch\xc3\xa4"
                                       "del 3.qch");
    ASSERT_EQ(again.cuts.size(), 1U);
    EXPECT_EQ(again.cuts[0].chosen.plane, first.cuts[0].chosen.plane) << "bit for bit";
    EXPECT_EQ(again.settings.objectives.weights.fragility, 11);
    EXPECT_EQ(work["result"]["project"], id_of_name("Sch\xc3\xa4"
                                                    "del 3.qch"));
    EXPECT_EQ(p.revision(), revision) << "the first one stays as it is";

    Json other = body;
    other.erase("strokes");
    other["check"] = checked("femur.ply").at("of");
    other["name"] = "femur";
    const Json misfit = end_of(post("/api/projects", other.dump()));
    ASSERT_EQ(misfit.at("state"), "done") << misfit;
    EXPECT_EQ(misfit["result"]["project"], "");
    EXPECT_FALSE(misfit["result"]["segment"]["notes"].empty());
    EXPECT_FALSE(fs::exists(p.folder.path / "femur.qch"));
    other["cuts_of"] = "0123456789abcdef";
    EXPECT_EQ(post("/api/projects", other.dump()).status, 404U);
    const ProjectLock lock(p.project);
    other["cuts_of"] = id_of_name("p.qch");
    EXPECT_EQ(post("/api/projects", other.dump()).status, 423U);
}

TEST_F(ConsoleTest, TheJournalIsThatOfTheCommandLineWithoutItsRows) {
    const Json journal = json_of(get("/api/journal"));
    EXPECT_EQ(journal["schema"], "qchopper-journal-1");
    for (const Json& one : journal["journals"]) {
        EXPECT_FALSE(one.contains("rows"));
        EXPECT_TRUE(one["jobs"].is_array());
    }
}

TEST_F(ConsoleTest, AValueIsNeverTakenForAnOption) {
    const Json check = end_of(post("/api/checks", Json{{"scan", id_of_name("scan.ply")}, {"units", "mm"}}.dump()));
    const std::string id = check.at("of");
    const std::string out = (p.folder.path / "stolen").string();
    for (const std::string& value :
         {"--out=" + out, std::string("-o"), "-o" + out, std::string("--help"), std::string("--"),
          std::string("--version"), "@" + out, std::string(), std::string("--deep")}) {
        const Json checked =
            end_of(post("/api/checks", Json{{"scan", id_of_name("scan.ply")}, {"units", value}}.dump()));
        EXPECT_EQ(checked.at("state"), "failed") << value << " " << checked;
        const Json project_body{{"check", id}, {"name", "option"}, {"units", "mm"}, {"preset", value}};
        EXPECT_EQ(end_of(post("/api/projects", project_body.dump())).at("state"), "failed") << value;
        const Json repair{{"fill", value}};
        EXPECT_EQ(end_of(post("/api/checks/" + id + "/repair", repair.dump())).at("state"), "failed") << value;
        const Json verify{{"kind", "verify"}, {"piece", value}};
        EXPECT_NE(end_of(post(project() + "/work", verify.dump(), p.revision())).at("state"), "done") << value;
    }
    EXPECT_FALSE(fs::exists(out));
    EXPECT_FALSE(fs::exists(p.folder.path / "option.qch"));
}

TEST_F(ConsoleTest, ATicketIsForOneUseOfOneAddress) {
    write_file(p.project / "guide.html", std::string_view("<p>guide"));
    const std::string path = project() + "/outputs/guide.html";
    const HttpAnswer ticket = post("/api/tickets", Json{{"path", path}}.dump());
    ASSERT_EQ(ticket.status, 201U) << ticket.body;
    const std::string address = json_of(ticket).at("path");
    HttpRequest open{"GET", address, 11, {{"Host", "a"}}, {}, true};
    const HttpAnswer used = send(open);
    EXPECT_EQ(used.status, 200U);
    EXPECT_EQ(used.body, "<p>guide");
    const auto is_policy = [](const auto& field) {
        return field.first == "Content-Security-Policy" && field.second.starts_with("sandbox");
    };
    EXPECT_TRUE(std::ranges::any_of(used.fields, is_policy));
    EXPECT_EQ(send(open).status, 404U) << "it was used";
    open.target = "/api/t/" + std::string(32, '0');
    EXPECT_EQ(send(open).status, 404U);
    for (const std::string& other :
         {std::string("/api/state"), std::string("/api/t/x"), std::string(), std::string("/etc/passwd"),
          std::string("/api/../etc"), path + "?x", path + "/", "http://a" + path}) {
        EXPECT_EQ(post("/api/tickets", Json{{"path", other}}.dump()).status, 400U) << other;
    }
    EXPECT_EQ(post("/api/tickets", Json{{"path", path}}.dump(), {}, "same-ticket").body,
              post("/api/tickets", Json{{"path", path}}.dump(), {}, "same-ticket").body);
}

TEST_F(ConsoleTest, EightStreamsAndNoNinth) {
    std::vector<HttpAnswer> streams;
    for (int i = 0; i < 8; ++i) {
        streams.push_back(get("/api/events"));
        ASSERT_EQ(streams.back().status, 200U) << i;
    }
    EXPECT_EQ(get("/api/events").status, 503U);
    streams.pop_back();
    EXPECT_EQ(get("/api/events").status, 200U) << "the place is free again, and again, because nobody holds it";
    EXPECT_EQ(get("/api/events").status, 200U);
    console->end();
    for (HttpAnswer& stream : streams) EXPECT_FALSE(stream.next_part(10s));
}

TEST_F(ConsoleTest, AfterTenWrongKeysOneIsAnsweredASecondAndTheRightOneAtOnce) {
    HttpRequest wrong = head("GET", "/api/state");
    wrong.fields[1].second = "Bearer " + std::string(32, 'b');
    const auto try_one = [&] { return std::get<HttpAnswer>(console->admit(wrong)).status; };
    Clock::time_point begin = Clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_EQ(try_one(), 401U);
    EXPECT_LT(Clock::now() - begin, 500ms);
    EXPECT_EQ(try_one(), 401U);
    begin = Clock::now();
    EXPECT_EQ(try_one(), 401U);
    EXPECT_EQ(try_one(), 401U);
    EXPECT_GE(Clock::now() - begin, 1s);
    std::vector<std::thread> many;
    std::atomic<int> refused = 0;
    for (int i = 0; i < 40; ++i) many.emplace_back([&] { refused += try_one() == 503 ? 1 : 0; });
    std::this_thread::sleep_for(200ms);
    EXPECT_GE(refused, 30) << "only a few wait, each with a thread";
    begin = Clock::now();
    EXPECT_EQ(get("/api/hello").status, 200U);
    EXPECT_EQ(get("/api/state").status, 200U);
    EXPECT_LT(Clock::now() - begin, 500ms);
    begin = Clock::now();
    console->end();
    for (std::thread& thread : many) thread.join();
    EXPECT_LT(Clock::now() - begin, 1s) << "an end is not kept waiting";
}

TEST_F(ConsoleTest, AServerThatOnlyShowsDecidesNothing) {
    start(true);
    const std::string before = p.revision();
    EXPECT_EQ(post(project() + "/decisions", R"({"weights":{"fragility":2}})", before).status, 403U);
    EXPECT_EQ(post(project() + "/work", R"({"kind":"prepare"})", before).status, 403U);
    EXPECT_EQ(post("/api/checks", "{}").status, 403U);
    EXPECT_EQ(post(project() + "/questions", R"({"rank":{}})").status, 200U);
    EXPECT_EQ(get(project()).status, 200U);
    EXPECT_EQ(json_of(get("/api/state")).at("read_only"), true);
    EXPECT_EQ(p.revision(), before);
}

TEST_F(ConsoleTest, WorkBeginsForItsRevisionAndQuestionsWaitForItsEnd) {
    EXPECT_EQ(post(project() + "/work", R"({"kind":"search"})", "0123").status, 412U);
    EXPECT_EQ(post(project() + "/work", R"({"kind":"check"})", p.revision()).status, 400U);
    EXPECT_EQ(post(project() + "/work", R"({"kind":"fly"})", p.revision()).status, 400U);
    const HttpAnswer begun = post(project() + "/work", R"({"kind":"setups"})", p.revision(), "begin-setups");
    ASSERT_EQ(begun.status, 202U);
    EXPECT_EQ(post(project() + "/work", R"({"kind":"setups"})", p.revision(), "begin-setups").body, begun.body);
    EXPECT_EQ(end_of(begun).at("state"), "failed") << "it has no cell";
    EXPECT_EQ(json_of(get("/api/state")).at("work").size(), 1U);
    EXPECT_EQ(post(project() + "/questions", R"({"rank":{}})").status, 200U);
}

TEST_F(ConsoleTest, BrokenAndStrangeProjectsStopNothing) {
    fs::create_directory(p.folder.path / "broken.qch");
    write_file(p.folder.path / "broken.qch" / "project.json", std::string_view("{\"schema\":"));
    const std::string strange = "<b>\n\xff\xfe.qch";
    fs::copy(p.project, p.folder.path / strange, fs::copy_options::recursive);
    std::this_thread::sleep_for(1200ms);  // the watch has looked at both
    const Json files = json_of(get("/api/files"));
    EXPECT_EQ(files.at("projects").size(), 3U);
    EXPECT_EQ(json_of(get("/api/state")).at("projects").size(), 2U);
    EXPECT_EQ(get("/api/projects/" + id_of_name("broken.qch")).status, 422U);
    EXPECT_EQ(get("/api/projects/" + id_of_name(strange)).status, 200U);
    fs::remove_all(p.folder.path / strange);
    fs::remove_all(p.project);
    std::this_thread::sleep_for(1200ms);
    EXPECT_EQ(json_of(get("/api/state")).at("projects").size(), 0U);
    EXPECT_EQ(get(project()).status, 404U);
}

TEST_F(ConsoleTest, ManyProjectsAreWatchedWithoutKeepingARequestWaiting) {
    for (int i = 0; i < 300; ++i) {
        const fs::path copy = p.folder.path / ("copy" + std::to_string(i) + ".qch");
        fs::create_directory(copy);
        fs::copy_file(p.project / "project.json", copy / "project.json");
    }
    const Clock::time_point until = Clock::now() + 30s;
    while (json_of(get("/api/state")).at("projects").size() < 301 && Clock::now() < until) {
        std::this_thread::sleep_for(50ms);
    }
    EXPECT_EQ(json_of(get("/api/state")).at("projects").size(), 301U);
    const auto cpu_s = [] { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; };
    const double before = cpu_s();
    std::this_thread::sleep_for(3s);
    EXPECT_LT(cpu_s() - before, 1.0) << "CPU seconds of six looks at 300 projects";
}

TEST_F(ConsoleTest, ItsEndIsPromptWhateverRuns) {
    ASSERT_EQ(get(project()).status, 200U);
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] { post(project() + "/questions", R"({"rank":{"weights":{"undercut":3}}})"); });
    }
    post(project() + "/work", R"({"kind":"prepare"})", p.revision());
    const Clock::time_point begin = Clock::now();
    console->end();
    for (std::thread& thread : threads) thread.join();
    console.reset();
    EXPECT_LT(Clock::now() - begin, 2s);
}

}  // namespace
}  // namespace qchopper
