// prepare makes again only the programs of pieces that have changed, and its outputs are the same either way.

#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "app/engine/loop.h"
#include "app/engine/prepare_project.h"
#include "app/engine/work_project.h"
#include "app/jobs/kept_programs.h"
#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "segment/io/write_mesh.h"
#include "tests/app/ball_cap.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// Two caps of balls beside each other are two pieces without a cut, A and the larger B.
TriangleMesh two_caps() {
    TriangleMesh both = ball_cap();
    const TriangleMesh other = ball_cap();
    const auto first = static_cast<std::uint32_t>(both.points.size());
    for (const Vec3& p : other.points) both.points.push_back({1.15 * p.x + 200, 1.15 * p.y, 1.15 * p.z});
    for (const Triangle& t : other.triangles) both.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return both;
}

class KeptWork : public testing::Test {
 protected:
    void SetUp() override {
        write_file(temporary.path / "scan.ply", to_ply(two_caps()));
        ProjectChoices choices;
        choices.scan = temporary.path / "scan.ply";
        choices.mm_per_unit = 1;
        choices.settings.stop.min_cuts = 0;
        choices.folder = project_folder;
        choices.cell_file = fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml";
        made(prepare_scan(choices, {"1.0", {}, true}, context()));
    }

    ProjectContext context() {
        messages.clear();
        ProjectContext context;
        context.on_message = [this](const std::string& line) { messages += line + "\n"; };
        return context;
    }

    // The pieces of which a run made the programs; all have some.
    std::string made(const PreparedProject& prepared) {
        std::string names;
        for (const PieceReport& piece : prepared.pieces) {
            EXPECT_TRUE(piece.is_proven()) << piece.name << ": " << piece.no_program_because;
            if (!piece.has_kept_programs) names += piece.name;
        }
        return names;
    }
    std::string made_again(const PrepareOptions& options = {"1.0", {}}) {
        return made(prepare_project(project_folder, {}, options, context()));
    }

    // The folder of jobs, and project.json.
    std::map<std::string, Bytes> outputs() const {
        std::map<std::string, Bytes> files{{"project.json", read_file(project_folder / "project.json")}};
        for (const auto& entry : fs::directory_iterator(project_folder / "jobs")) {
            files[entry.path().filename().string()] = read_file(entry.path());
        }
        return files;
    }

    void change(const std::function<void(OpenProject&)>& decide) {
        LockedProject open(project_folder, {}, {});
        decide(open.project);
    }
    std::vector<fs::path> kept_files() const {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator(project_folder / "cache")) {
            if (entry.path().extension() == programs_ending) files.push_back(entry.path());
        }
        return files;
    }

    Folder temporary;
    fs::path project_folder = temporary.path / "p.qch";
    std::string messages;
};

TEST_F(KeptWork, AChangeOfOnePieceMakesOneProgram) {
    EXPECT_NE(messages.find("programs to make, the largest first: B (estimated at "), std::string::npos) << messages;
    const auto first = outputs();
    EXPECT_EQ(made_again(), "") << "nothing has changed";
    EXPECT_NE(messages.find("programs of 2 pieces kept from an earlier run, of 0 made"), std::string::npos) << messages;
    EXPECT_EQ(outputs(), first);

    SetupOrder order;
    order.piece = "B";
    order.max_directions = 1;
    change([&](OpenProject& project) { EXPECT_TRUE(project.decide_setup(order)); });
    EXPECT_EQ(made_again(), "B");
    EXPECT_NE(messages.find("programs of 1 piece kept from an earlier run, of 1 made"), std::string::npos) << messages;
    EXPECT_NE(outputs().at("B.qjob"), first.at("B.qjob"));
    EXPECT_EQ(outputs().at("A.qjob"), first.at("A.qjob"));
    change([](OpenProject& project) { EXPECT_TRUE(project.undo()); });
    EXPECT_EQ(made_again(), "") << "that of before is still there";
    EXPECT_EQ(outputs().at("B.qjob"), first.at("B.qjob"));
}

TEST_F(KeptWork, APieceThatTheArmCannotFollowIsMilledFromFewerOrientationsUntilOneIsLeft) {
    PreparedProject prepared = prepare_project(project_folder, {}, {"1.0", {}}, context());
    PieceReport& refused = prepared.pieces[1];
    const std::size_t before = refused.piece_setup.setup().access.orientations.size();
    ASSERT_GT(before, 1U);
    const auto order = [&] { return committed_setup_order(prepared.project.history, "B").max_directions; };
    LockedProject open(project_folder, {}, {});
    const auto take_fewer = [&] {
        const bool is_taken = take_fewer_orientations(open.project, prepared, context());
        prepared.project = open.project.project();
        return is_taken;
    };
    EXPECT_FALSE(take_fewer()) << "every piece has its program";
    refused.no_program_because = "no arm posture reaches it";
    EXPECT_FALSE(take_fewer()) << "another reason than the arm";
    refused.is_machine_refusing = true;
    EXPECT_TRUE(take_fewer());
    EXPECT_EQ(order(), before - 1);
    EXPECT_NE(messages.find("piece B: no arm posture reaches it; it is milled from "), std::string::npos) << messages;
    EXPECT_FALSE(take_fewer()) << "that is decided already";
    refused.piece_setup.choice.setups[0].access.orientations.resize(1);
    EXPECT_FALSE(take_fewer());
    ASSERT_TRUE(open.project.undo().has_value());
    prepared.project = open.project.project();
    EXPECT_FALSE(order().has_value());
}

// What other processes found out is decided about when the items are written again, as prepare does.
TEST_F(KeptWork, APieceThatTheArmCannotFollowIsMilledFromFewerOrientationsWhenItIsGathered) {
    PrepareOptions options{"1.0", {}};
    options.has_items = true;
    fs::remove_all(project_folder / "cache");
    const PreparedProject prepared = prepare_project(project_folder, {}, options, context());
    const std::size_t before = prepared.pieces[1].piece_setup.setup().access.orientations.size();
    const fs::path file = items_folder(project_folder) / "B.qitem";
    const WorkItem item = item_from(read_file(file), file, "1.0");
    PiecePrograms refused{{}, "no arm posture reaches it", item.job.caps};
    refused.is_machine_refusing = true;
    fs::create_directories(project_folder / "work" / "results");
    keep_programs(project_folder / "work" / "results" / item.result, {item.job, sha256(item.cell_file), item.fine},
                  refused);
    const WorkAnswer worked = work_items({project_folder}, {}, "1.0", {}, context());
    ASSERT_EQ(worked.pieces.size(), 2U);
    EXPECT_EQ(worked.pieces[1].outcome, ProgramOutcome::none) << "it is not tried again";
    const GatherAnswer early = gather_project(project_folder, false, "1.0", context());
    EXPECT_TRUE(early.unmade.empty());
    EXPECT_FALSE(early.prepared);
    ASSERT_EQ(early.refused.size(), 1U);
    EXPECT_EQ(early.refused[0].name, "B");

    const PreparedProject again = prepare_project(project_folder, {}, options, context());
    EXPECT_NE(messages.find("piece B: no arm posture reaches it; it is milled from "), std::string::npos) << messages;
    EXPECT_EQ(committed_setup_order(again.project.history, "B").max_directions, before - 1);
    EXPECT_EQ(again.items.count, 2U);
    EXPECT_EQ(again.items.kept, 1U) << "A";
    const WorkAnswer rest = work_items({project_folder}, {}, "1.0", {}, context());
    ASSERT_EQ(rest.pieces.size(), 2U);
    EXPECT_TRUE(rest.pieces[0].was_kept);
    EXPECT_FALSE(rest.pieces[1].was_kept);
    const GatherAnswer gathered = gather_project(project_folder, false, "1.0", context());
    ASSERT_TRUE(gathered.prepared);
    EXPECT_EQ(made(*gathered.prepared), "") << "all were made by work";
}

// Of a piece that nothing helps the job is written without a program, as prepare does; it is not asked for again.
TEST_F(KeptWork, APieceThatTheArmRefusesWithOneOrientationIsGatheredWithoutAProgram) {
    SetupOrder order;
    order.piece = "B";
    order.max_directions = 1;
    change([&](OpenProject& project) { EXPECT_TRUE(project.decide_setup(order)); });
    PrepareOptions options{"1.0", {}};
    options.has_items = true;
    const auto put_refusal = [&](const fs::path& folder) {
        const fs::path file = items_folder(project_folder) / "B.qitem";
        const WorkItem item = item_from(read_file(file), file, "1.0");
        PiecePrograms refused{{}, "no arm posture reaches it", item.job.caps};
        refused.is_machine_refusing = true;
        keep_programs(folder / item.result, {item.job, sha256(item.cell_file), item.fine}, refused);
    };
    prepare_project(project_folder, {}, options, context());
    put_refusal(project_folder / "work" / "results");
    EXPECT_EQ(gather_project(project_folder, false, "1.0", context()).refused.size(), 1U);
    prepare_project(project_folder, {}, options, context());
    const GatherAnswer gathered = gather_project(project_folder, false, "1.0", context());
    EXPECT_TRUE(gathered.refused.empty());
    ASSERT_TRUE(gathered.prepared);
    EXPECT_TRUE(gathered.prepared->pieces[0].is_proven());
    EXPECT_EQ(gathered.prepared->pieces[1].no_program_because, "no arm posture reaches it");
    EXPECT_TRUE(fs::exists(gathered.prepared->pieces[1].job));
}

// B is then the first of one piece: names in its program change, and nothing else.
TEST_F(KeptWork, APieceOfAnotherNumberHasTheBytesOfANewProgram) {
    PrepareOptions options{"1.0", {}};
    options.discard = DiscardRequest{{"A"}, {}};
    EXPECT_EQ(made_again(options), "");
    const auto kept = outputs();
    fs::remove_all(project_folder / "cache");
    EXPECT_EQ(made_again(), "B");
    EXPECT_EQ(outputs(), kept);
}

TEST_F(KeptWork, ADamagedFileIsNotTaken) {
    const auto first = outputs();
    ASSERT_EQ(kept_files().size(), 2U);
    for (const fs::path& file : kept_files()) {
        Bytes bytes = read_file(file);
        bytes[bytes.size() / 2] ^= 1U;
        write_file(file, bytes);
    }
    EXPECT_EQ(made_again(), "AB");
    EXPECT_EQ(outputs(), first);
}

TEST_F(KeptWork, AnotherCellFileMakesAllAgain) {
    const Bytes cell = read_file(project_folder / "cell.toml");
    std::string text(cell.begin(), cell.end());
    const std::string before = "tool_change = \"stop\"\n";  // what follows is seen by no setup
    ASSERT_NE(text.find(before), std::string::npos);
    text.replace(text.find(before), before.size(), before + "tool_change_time = 61.0\n");
    write_file(project_folder / "cell.toml", text);
    EXPECT_EQ(made_again(), "AB");
}

}  // namespace
}  // namespace qchopper
