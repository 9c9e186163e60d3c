// A small project of a real scan, made by the program, and a console worker in a thread of the test.

#pragma once

#include <condition_variable>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "app/console/worker/resident_project.h"
#include "app/console/worker/worker.h"
#include "base/child_process.h"
#include "tests/folder.h"

namespace qchopper {

using Json = nlohmann::ordered_json;

// folder/scan.ply, a vertebra, and folder/p.qch, which is not cut.
struct WorkedProject {
    Folder folder;
    std::filesystem::path scan = folder.path / "scan.ply";
    std::filesystem::path project = folder.path / "p.qch";

    explicit WorkedProject(std::size_t faces = 3000) {
        static const Folder samples;
        const std::filesystem::path sample = samples.path / (std::to_string(faces) + ".ply");
        if (!std::filesystem::exists(sample)) {
            command({"sample", "vertebra", "--faces", std::to_string(faces), "-o", sample.string()});
        }
        std::filesystem::copy_file(sample, scan);
        command({"segment", scan.string(), "--units", "mm", "--preset", "thesis", "-o", project.string()});
    }
    static void command(std::vector<std::string> words) {
        words.insert(words.begin(), QCHOPPER_PROGRAM);
        const ChildOutput made = run_child(words, std::chrono::minutes(2));
        EXPECT_EQ(made.code, 0) << made.err;
    }
    std::string revision() const { return revision_of_project(project); }
};

// How often a test of kills kills: 20 times, or as QCHOPPER_KILLS says.
inline int kills_wanted() {
    const char* const wanted = std::getenv("QCHOPPER_KILLS");
    return wanted == nullptr ? 20 : std::stoi(wanted);
}

// Of an answer with a plane: cut by the k-th plane that a rank question has listed.
inline std::string accept_body(const Json& ranked, std::size_t k) {
    const Json& proposal = ranked.at("document").at("proposal");
    const Json& plane = proposal.at("planes").at(k - 1);
    const Json numbers{plane.at("normal").at(0), plane.at("normal").at(1), plane.at("normal").at(2),
                       plane.at("offset_mm")};
    return Json{{"cut", {{"piece", proposal.at("piece")}, {"plane", numbers}, {"k", k}}}}.dump();
}

// work_for_console() in a thread; one request after the other.
class WorkerThread {
 public:
    explicit WorkerThread(const std::filesystem::path& project)
        : thread_([this, project] {
              work_for_console(
                  project, [this] { return next_line(); }, [this](const std::string& line) { put(line); }, "0", {});
          }) {}
    ~WorkerThread() {
        {
            const std::lock_guard lock(changing_);
            has_ended_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    WorkerThread(const WorkerThread&) = delete;
    WorkerThread& operator=(const WorkerThread&) = delete;

    std::string line(const std::string& request) {
        std::unique_lock lock(changing_);
        requests_.push_back(request);
        changed_.notify_all();
        changed_.wait(lock, [&] { return !answers_.empty(); });
        std::string answer = std::move(answers_.front());
        answers_.pop_front();
        return answer;
    }
    WorkerAnswer ask(const WorkerRequest& request) {
        const std::optional<WorkerAnswer> answer = read_answer(line(to_line(request)));
        EXPECT_TRUE(answer);
        return answer.value_or(WorkerAnswer{0, {}});
    }
    WorkerAnswer decide(const std::string& revision, const std::string& body) {
        return ask({WorkerTask::decide, revision, body});
    }
    Json question(const std::string& body) {
        const WorkerAnswer answer = ask({WorkerTask::ask, {}, body});
        EXPECT_EQ(answer.status, 200U) << answer.document;
        return Json::parse(answer.document);
    }

 private:
    std::optional<std::string> next_line() {
        std::unique_lock lock(changing_);
        changed_.wait(lock, [&] { return has_ended_ || !requests_.empty(); });
        if (requests_.empty()) return {};
        std::string request = std::move(requests_.front());
        requests_.pop_front();
        return request;
    }
    void put(const std::string& answer) {
        const std::lock_guard lock(changing_);
        answers_.push_back(answer);
        changed_.notify_all();
    }

    std::mutex changing_;
    std::condition_variable changed_;
    std::deque<std::string> requests_;
    std::deque<std::string> answers_;
    bool has_ended_ = false;
    std::thread thread_;  // the last member: it uses the others
};

}  // namespace qchopper
