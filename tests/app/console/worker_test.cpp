#include "app/console/worker/worker.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <fstream>
#include <random>

#include "app/console/worker/shown_pieces.h"
#include "app/display/display_store.h"
#include "app/engine/segment_project.h"
#include "app/engine/setup_project.h"
#include "app/report/segment_report.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "tests/app/console/worked.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

std::string bytes_of(const fs::path& project) {
    const Bytes bytes = read_file(project / "project.json", record_limit);
    return {bytes.begin(), bytes.end()};
}

// The document of a command within an answer, to the byte.
std::string document_in(const WorkerAnswer& answer) {
    const std::string key = R"("document":)";
    const std::size_t at = answer.document.find(key);
    EXPECT_NE(at, std::string::npos) << answer.document;
    return answer.document.substr(at + key.size(), answer.document.size() - at - key.size() - 1);
}

SegmentAnswer directly(const fs::path& project, const ProjectRequest& request) {
    return segment_project(project, {}, request, {});
}

TEST(Worker, AnAnswerIsOneLineAndReadAsItIsWritten) {
    const WorkerAnswer answer{409, "{\n \"schema\": \"x\",\n \"error\": \"a\\nb\"\n}"};
    const std::string line = to_line(answer);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const std::optional<WorkerAnswer> read = read_answer(line);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->status, answer.status);
    EXPECT_EQ(read->document, answer.document);
    EXPECT_FALSE(read_answer("{\"status\":200}"));
}

TEST(Worker, AStaleRevisionIsRefusedAndNothingChanges) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    const std::string old = p.revision();
    ASSERT_EQ(worker.decide(old, R"({"weights":{"fragility":2}})").status, 200U);
    const std::string before = bytes_of(p.project);
    for (const std::string& revision : {old, std::string("0"), std::string("ffffffffffffffff")}) {
        for (const char* body : {R"({"undo":"Undo change of weights"})", R"({"weights":{"fragility":3}})",
                                 R"({"reset":true})", R"({"back_to":0})", R"({"cut":{"plane":[1,0,0,0]}})"}) {
            const WorkerAnswer answer = worker.decide(revision, body);
            EXPECT_EQ(answer.status, 412U) << answer.document;
            EXPECT_EQ(bytes_of(p.project), before);
        }
    }
    EXPECT_EQ(worker.decide(p.revision(), R"({"undo":"Undo change of weights"})").status, 200U);
}

TEST(Worker, UndoAndRedoNameWhatTheyExpect) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    ASSERT_EQ(worker.decide(p.revision(), R"({"weights":{"fragility":2}})").status, 200U);
    const std::string before = bytes_of(p.project);
    for (const char* body : {R"({"undo":"Undo cut 1 on piece A"})", R"({"undo":""})", R"({"redo":"Redo reset"})",
                             R"({"back_to":2})", R"({"back_to":18446744073709551615})"}) {
        EXPECT_EQ(worker.decide(p.revision(), body).status, 412U) << body;
        EXPECT_EQ(bytes_of(p.project), before);
    }
    const Json undone = Json::parse(worker.decide(p.revision(), R"({"undo":"Undo change of weights"})").document);
    EXPECT_EQ(undone.at("redo"), "Redo change of weights");
    EXPECT_TRUE(undone.at("undo").is_null());
    EXPECT_EQ(undone.at("decisions"), 0);
    EXPECT_EQ(worker.decide(p.revision(), R"({"undo":""})").status, 409U) << "there is nothing to undo";
}

TEST(Worker, AnotherProgramsDecisionInBetweenIsSeen) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    const std::string old = p.revision();
    ASSERT_EQ(worker.ask({WorkerTask::show, {}, {}}).status, 200U);
    ProjectRequest cut;
    cut.accept = 1;
    directly(p.project, cut);
    EXPECT_EQ(worker.decide(old, R"({"reset":true})").status, 412U);
    const Json shown = Json::parse(worker.ask({WorkerTask::show, {}, {}}).document);
    EXPECT_EQ(shown.at("document").at("cuts").size(), 1U);
    EXPECT_EQ(shown.at("revision"), p.revision());
    const std::string undo = shown.at("undo").get<std::string>();
    EXPECT_EQ(undo, "Undo cut 1 on piece A");
    EXPECT_EQ(worker.decide(p.revision(), Json{{"undo", undo}}.dump()).status, 200U);
    EXPECT_TRUE(load_project(p.project).cuts.empty());
}

TEST(Worker, APlaceHoldsThePlaneThatWasShownBitForBit) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    const Json ranked = worker.question(R"({"rank":{}})");
    Json body = Json::parse(accept_body(ranked, 2));
    body.at("cut").at("k") = 1;
    EXPECT_EQ(worker.decide(p.revision(), body.dump()).status, 412U);
    body = Json::parse(accept_body(ranked, 2));
    const double offset = body.at("cut").at("plane").at(3);
    body.at("cut").at("plane").at(3) = std::nextafter(offset, 1e9);
    EXPECT_EQ(worker.decide(p.revision(), body.dump()).status, 412U);
    EXPECT_TRUE(load_project(p.project).cuts.empty());
    EXPECT_EQ(worker.decide(p.revision(), accept_body(ranked, 2)).status, 200U);
    EXPECT_EQ(load_project(p.project).cuts.at(0).chosen.plane.offset, offset);
}

TEST(Worker, WhatIsNoRequestIsAnsweredAndTheNextOneToo) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    for (const std::string& line :
         {std::string(), std::string("x"), std::string("{}"), std::string("[[[["), std::string(100'000, '{'),
          std::string(R"({"task":"delete","revision":"","body":""})"), std::string("\xff\xfe\0x", 4)}) {
        const std::optional<WorkerAnswer> answer = read_answer(worker.line(line));
        ASSERT_TRUE(answer) << line;
        EXPECT_GE(answer->status, 400U);
    }
    for (const char* body :
         {"", "{", "[]", R"({"tilt":1})", R"({"cut":{"plane":[1,0,0,1e300]}})",
          R"({"cut":{"plane":[1,0,0,1e308],"piece":"A"}})", R"({"cut":{"plane":[1,0,0,0],"piece":"Z"}})",
          R"({"weights":{"fragility":-1}})", R"({"weights":{"fragility":1e308}})", R"({"weights":{"unreachable":1}})",
          R"({"discard":{"pieces":["Q"]}})", R"({"discard":{"pieces":["A"]}})", R"({"discard":{"pieces":[]}})",
          R"({"reset":true})", R"({"setup":{"piece":"A","base":1}})", R"({"cut":{"plane":[0,0,1,0],"k":1000000}})",
          R"({"cut":{"plane":[0,0,1,0],"k":18446744073709551615}})"}) {
        const std::string stood = bytes_of(p.project);
        const WorkerAnswer answer = worker.decide(p.revision(), body);
        if (bytes_of(p.project) != stood) {
            EXPECT_EQ(answer.status, 200U) << body << " has changed the project: " << answer.document;
            const std::string undo = Json::parse(answer.document).at("undo").get<std::string>();
            ASSERT_EQ(worker.decide(p.revision(), Json{{"undo", undo}}.dump()).status, 200U);
        }
        const Json document = Json::parse(answer.document);
        if (answer.status != 200) {
            EXPECT_FALSE(document.at("error").get<std::string>().empty()) << body;
            EXPECT_NE(answer.status, 500U) << body << ": " << answer.document;
        }
    }
    for (const char* body : {R"({"rank":{"piece":"Z"}})", R"({"rank":{"top":0}})", R"({"rank":{"top":1000000000}})",
                             R"({"rank":{"weights":{"fragility":-1}}})", R"({"rank":{"weights":{"structure":1}}})",
                             R"({"preview":{"plane":[1,0,0,1e300]}})", R"({"explain":{}})", R"({"explain":{"cut":-3}})",
                             R"({"explain":{"cut":2147483647}})", R"({"setups":{}})", R"({"setups":{"piece":"Z"}})"}) {
        const WorkerAnswer answer = worker.ask({WorkerTask::ask, {}, body});
        EXPECT_NE(answer.status, 500U) << body << ": " << answer.document;
    }
    EXPECT_EQ(worker.ask({WorkerTask::show, {}, {}}).status, 200U);
}

TEST(Worker, AQuestionChangesNothing) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    const std::string before = bytes_of(p.project);
    worker.question(R"({"rank":{"top":3,"weights":{"undercut":50}}})");
    worker.question(R"({"preview":{"plane":[1,0,0,0]}})");
    EXPECT_EQ(bytes_of(p.project), before);
}

TEST(Worker, ItsAnswersAreThoseOfTheCommandToTheByte) {
    const WorkedProject p;
    const fs::path kept = p.folder.path / "kept.qch";
    WorkerThread worker(p.project);
    const auto compare = [&](const WorkerRequest& asked, const ProjectRequest& request) {
        fs::remove_all(kept);
        fs::copy(p.project, kept, fs::copy_options::recursive);
        const WorkerAnswer answer = worker.ask(asked);
        ASSERT_EQ(answer.status, 200U) << answer.document;
        const std::string after = bytes_of(p.project);
        fs::remove_all(p.project);
        fs::copy(kept, p.project, fs::copy_options::recursive);
        const SegmentAnswer direct = directly(p.project, request);
        EXPECT_EQ(document_in(answer), document(direct).json->dump()) << asked.body;  // on one line
        EXPECT_EQ(after, bytes_of(p.project)) << asked.body;
    };
    const auto decides = [&](const std::string& body, const ProjectRequest& request) {
        compare({WorkerTask::decide, p.revision(), body}, request);
    };
    ProjectRequest request;
    compare({WorkerTask::show, {}, {}}, request);
    request.propose = true;
    compare({WorkerTask::ask, {}, R"({"rank":{}})"}, request);
    request = {};
    request.accept = 1;
    const std::string accept = accept_body(worker.question(R"({"rank":{}})"), 1);
    decides(accept, request);
    request = {};
    request.weights = GivenWeights{};
    request.weights->weight[1] = 7.5;
    decides(R"({"weights":{"fragility":7.5}})", request);
    request = {};
    request.plane = Plane{{1, 0, 0}, 3};
    decides(R"({"cut":{"plane":[1,0,0,3]}})", request);
    request = {};
    request.preview = Plane{{0, 1, 0}, -40};
    compare({WorkerTask::ask, {}, R"({"preview":{"plane":[0,1,0,-40]}})"}, request);
    request = {};
    request.undo = true;
    decides(R"({"undo":"Undo cut 2 on piece )" + load_project(p.project).cuts.at(1).piece + "\"}", request);
    request = {};
    request.redo = true;
    decides(Json{{"redo", redo_text(load_project(p.project).history)}}.dump(), request);
    request = {};
    request.reset = true;
    decides(R"({"reset":true})", request);
    request = {};
    request.propose = true;
    request.tried_weights = GivenWeights{};
    request.tried_weights->weight[0] = 0;
    request.top = 3;
    compare({WorkerTask::ask, {}, R"({"rank":{"weights":{"face_ratio":0},"top":3}})"}, request);
}

TEST(Worker, PiecesAreDrawnWhenAskedForAndFoundUnderTheirIds) {
    const WorkedProject p;
    WorkerThread worker(p.project);
    const Json shown = Json::parse(worker.ask({WorkerTask::show, {}, {}}).document);
    EXPECT_FALSE(shown.contains("pieces")) << "the document does not wait for drawings";
    EXPECT_EQ(worker.decide(p.revision(), R"({"cut":{"plane":[1,0,0,3]}})").status, 200U);
    const Json drawn = worker.question(R"({"display":{}})");
    EXPECT_EQ(drawn.at("revision"), p.revision());
    const Project project = load_project(p.project);
    ASSERT_EQ(drawn.at("pieces").size(), project.pieces.size());
    for (std::size_t i = 0; i < project.pieces.size(); ++i) {
        const Json& piece = drawn.at("pieces").at(i);
        EXPECT_EQ(piece.at("name"), project.pieces[i].name);
        EXPECT_TRUE(kept_display(display_folder(p.project), DisplayKind::mesh, piece.at("mesh")));
    }
    EXPECT_EQ(worker.question(R"({"display":{}})"), drawn);
}

// Makes decisions at random by the worker or, as another program, directly; those that were accepted, done again on a
// copy of the project, give the same project.
TEST(Worker, AHundredDecisionsByItAndByAnotherProgramAreTheAcceptedSequence) {
    const WorkedProject p;
    const fs::path copy = p.folder.path / "copy.qch";
    fs::copy(p.project, copy, fs::copy_options::recursive);
    WorkerThread worker(p.project);
    std::mt19937 random(20261127);
    std::vector<ProjectRequest> accepted;
    std::string stale = "0123456789abcdef";
    for (int i = 0; i < 100; ++i) {
        const Project now = load_project(p.project);
        ProjectRequest request;
        std::string body;
        switch (random() % 5) {
            case 0:
                if (to_undo(now.history) == nullptr) continue;
                request.undo = true;
                body = Json{{"undo", undo_text(now.history)}}.dump();
                break;
            case 1:
                if (to_redo(now.history) == nullptr) continue;
                request.redo = true;
                body = Json{{"redo", redo_text(now.history)}}.dump();
                break;
            case 2: {
                const double weight = 1 + 0.5 * static_cast<double>(random() % 8);
                request.weights = GivenWeights{};
                request.weights->weight[1] = weight;
                body = Json{{"weights", {{"fragility", weight}}}}.dump();
                break;
            }
            case 3: {
                const double offset = static_cast<double>(random() % 60) - 30;
                request.plane = Plane{{0, 1, 0}, offset};
                body = Json{{"cut", {{"plane", {0, 1, 0, offset}}}}}.dump();
                break;
            }
            default: {
                request.accept = 1;
                if (now.cuts.size() > 5) {
                    request = {};
                    request.reset = true;
                    body = R"({"reset":true})";
                } else {
                    body = accept_body(worker.question(R"({"rank":{}})"), 1);
                }
            }
        }
        const std::string before = p.revision();
        const std::string bytes = bytes_of(p.project);
        if (random() % 2 == 0) {
            EXPECT_EQ(worker.decide(stale, body).status, 412U) << body;
            ASSERT_EQ(bytes_of(p.project), bytes);
            const WorkerAnswer answer = worker.decide(before, body);
            if (answer.status == 200) {
                accepted.push_back(request);
                EXPECT_EQ(Json::parse(answer.document).at("revision"), p.revision());
            } else {
                EXPECT_EQ(bytes_of(p.project), bytes) << answer.document;
            }
        } else {
            const SegmentAnswer answer = directly(p.project, request);
            if (!answer.done.empty()) accepted.push_back(request);
        }
        if (p.revision() != before) stale = before;
    }
    EXPECT_GT(accepted.size(), 40U);
    for (const ProjectRequest& request : accepted) directly(copy, request);
    EXPECT_EQ(bytes_of(copy), bytes_of(p.project));
}

std::size_t resident_kb() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word) {
        std::size_t kb = 0;
        if (word == "VmRSS:" && status >> kb) return kb;
    }
    return 0;
}

TEST(Worker, FiveHundredCutsAndUndosGrowByFivePerCentAtMost) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers keep freed memory";
#endif
    const WorkedProject p(10'000);
    WorkerThread worker(p.project);
    const auto round = [&](int i) {
        const std::string body =
            i % 3 == 0 ? Json{{"cut", {{"plane", {0, 1, 0, -20 + i % 40}}}}}.dump()
                       : accept_body(worker.question(R"({"rank":{"top":5}})"), 1 + static_cast<std::size_t>(i) % 5);
        const WorkerAnswer cut = worker.decide(p.revision(), body);
        ASSERT_EQ(cut.status, 200U) << cut.document;
        const std::string undo = Json::parse(cut.document).at("undo").get<std::string>();
        ASSERT_EQ(worker.decide(p.revision(), Json{{"undo", undo}}.dump()).status, 200U);
    };
    for (int i = 0; i < 40; ++i) round(i);  // every kind of cut once
    ::malloc_trim(0);
    const std::size_t before = resident_kb();
    for (int i = 0; i < 500; ++i) round(i);
    ::malloc_trim(0);
    const std::size_t after = resident_kb();
    RecordProperty("before_kb", static_cast<int>(before));
    RecordProperty("after_kb", static_cast<int>(after));
    EXPECT_LE(static_cast<double>(after), 1.05 * static_cast<double>(before)) << before << " kB before";
}

}  // namespace
}  // namespace qchopper
