// A program that decides and is killed at any moment leaves a project that is right.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <set>
#include <thread>

#include "app/engine/open_project.h"
#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

extern char** environ;

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr const char* folder_variable = "QCHOPPER_KILLED_FOLDER";

TriangleMesh scan() {
    return shapes::torus({0, 0, 0}, 40, 12, 12);
}

void make_project(const fs::path& folder) {
    fs::create_directories(folder);
    Project project;
    project.scan = {"/a bone.ply", Sha256{{0xcc}}, Unit::mm, 1, {}, 0, volume_mm3(scan()), {}};
    project.settings.candidates.offsets_per_normal = 3;
    project.history.weights_at_start = project.settings.objectives.weights;
    record(project, uncut(scan(), 0));
    save_project(folder, project);
}

void decide_something(OpenProject& project, std::mt19937& random) {
    const std::size_t cuts = project.project().cuts.size();
    switch (random() % 8) {
        case 0:
            project.undo();
            return;
        case 1:
            project.redo();
            return;
        case 2:
            if (cuts > 2) project.decide_reset();
            return;
        case 3:
            project.decide_weights({static_cast<double>(random() % 9), 1, 1, 1});
            return;
        case 4: {
            StopRules rules;
            rules.min_cuts = static_cast<int>(cuts) + 1;
            project.set_search(rules, 1 + random() % 3);
            project.search(
                {}, [](const Segmentation&) {}, {}, std::nullopt);
            return;
        }
        default: {
            const std::size_t piece = *project.next({}).piece;
            const std::vector<Ranked> ranked = project.ranking(piece, 1, {});
            if (!ranked.empty() && cuts < 6) {
                project.decide_cut(cut_by(project.segmentation(), piece, ranked, random() % ranked.size(),
                                          project.project().settings));
            }
        }
    }
}

// What the only job of a finished project holds here.
std::string job_text(const Project& project) {
    std::string text;
    for (const Cut& cut : project.cuts) text += cut.piece + std::to_string(cut.chosen.plane.offset) + " ";
    return text;
}

// As prepare does, with a job that says of which cuts it is.
void finish(OpenProject& open) {
    write_pieces(open.folder(), open.segmentation(), FragmentChoice::keep);
    Project project = open.project();
    fs::create_directories(open.folder() / "jobs");
    write_file(open.folder() / "jobs" / "A.qjob", job_text(project));
    project.jobs = {{"A", Sha256{{0xdd}}, std::string(32, 'a')}};
    project.stage = Stage::done;
    save_project(open.folder(), project);
}

// The program that is killed: decides for ever. Started by the test below, never alone.
TEST(Killed, DISABLED_Victim) {
    const char* folder = std::getenv(folder_variable);
    ASSERT_NE(folder, nullptr);
    const ProjectLock lock(folder);
    clear_leftovers(folder);
    std::mt19937 random(static_cast<unsigned>(load_project(folder).history.decisions.size() + 17U));
    while (true) {
        OpenProject project(folder, load_project(folder), scan);
        for (int i = 0; i < 4; ++i) decide_something(project, random);
        finish(project);
    }
}

pid_t start_victim(const fs::path& folder) {
    ::setenv(folder_variable, folder.c_str(), 1);
    std::string name = "/proc/self/exe";
    std::string filter = "--gtest_filter=Killed.DISABLED_Victim";
    std::string also = "--gtest_also_run_disabled_tests";
    char* arguments[] = {name.data(), filter.data(), also.data(), nullptr};
    posix_spawn_file_actions_t quiet;
    posix_spawn_file_actions_init(&quiet);
    posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t pid = -1;
    EXPECT_EQ(posix_spawn(&pid, name.c_str(), &quiet, nullptr, arguments, environ), 0);
    posix_spawn_file_actions_destroy(&quiet);
    return pid;
}

// How long a victim takes until its first decision is saved: sanitizers and busy machines are slow.
std::chrono::microseconds time_to_decide(const fs::path& folder) {
    const auto before = read_file(folder / "project.json");
    const auto started = std::chrono::steady_clock::now();
    const pid_t victim = start_victim(folder);
    while (read_file(folder / "project.json") == before &&
           std::chrono::steady_clock::now() - started < std::chrono::seconds(60)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    const auto took = std::chrono::steady_clock::now() - started;
    ::kill(victim, SIGKILL);
    ::waitpid(victim, nullptr, 0);
    return std::chrono::duration_cast<std::chrono::microseconds>(took);
}

// Loadable, its pieces what its cuts make, and no product that belongs to other cuts.
void expect_right(const fs::path& folder) {
    const Project project = load_project(folder);
    const Segmentation segmentation = replay(project, scan());
    Project fresh = project;
    record(fresh, segmentation);
    EXPECT_EQ(fresh.pieces, project.pieces);
    EXPECT_EQ(fresh.history, project.history);
    EXPECT_EQ(project.jobs.empty(), project.stage != Stage::done);
    if (project.stage == Stage::cutting || !fs::exists(folder / "pieces")) return;
    if (project.stage == Stage::done) {
        const Bytes job = read_file(folder / "jobs" / "A.qjob");
        EXPECT_EQ(std::string(job.begin(), job.end()), job_text(project));
    }
    std::set<std::string> names;
    for (const Piece& piece : segmentation.pieces) {
        names.insert(piece.name + ".ply");
        EXPECT_EQ(read_file(folder / "pieces" / (piece.name + ".ply")), to_ply(*piece.mesh));
    }
    for (const auto& entry : fs::directory_iterator(folder / "pieces")) {
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(names.contains(name) || name.find(".tmp.") != std::string::npos) << name;
    }
}

TEST(Killed, AtAnyMomentItLeavesAProjectThatIsRight) {
    const fs::path folder = fs::path(testing::TempDir()) / ("killed" + std::to_string(::getpid()));
    make_project(folder);
    const auto first_decision = time_to_decide(folder);
    std::mt19937 random(3);
    std::size_t changed = 0;
    auto last = read_file(folder / "project.json");
    for (int i = 0; i < 40; ++i) {
        const pid_t victim = start_victim(folder);
        // From before its first decision to several decisions on.
        std::this_thread::sleep_for(first_decision * (50 + random() % 350) / 100);
        ::kill(victim, SIGKILL);
        int status = 0;
        ASSERT_EQ(::waitpid(victim, &status, 0), victim);
        ASSERT_TRUE(WIFSIGNALED(status)) << "it ended by itself";
        expect_right(folder);
        const auto now = read_file(folder / "project.json");
        changed += now != last ? 1 : 0;
        last = now;
    }
    EXPECT_GT(changed, 10U) << "it hardly came to decide anything before it was killed";
    fs::remove_all(folder);
}

}  // namespace
}  // namespace qchopper
