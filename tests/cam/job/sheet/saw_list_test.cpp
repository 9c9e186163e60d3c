#include "cam/job/sheet/saw_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/cam/job/sawn_jobs.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using nlohmann::json;

std::vector<SawnBlock> all_blocks() {
    std::vector<SawnBlock> blocks;
    const SawnJobs& all = sawn_jobs();
    for (std::size_t p = 0; p < all.inputs.size(); ++p) {
        const JobInput& input = all.inputs[p];
        const std::optional<std::string> job =
            p == all.middle ? std::nullopt : std::optional(input.piece.name + ".qjob");
        const auto block = sawn_block(input.piece.name, job, input.setup, job_caps(input), input.cell);
        if (block) blocks.push_back(*block);
    }
    return blocks;
}

SawList some_list() {
    return saw_list("ball & co.ply", 0.5, all_blocks());
}

bool has(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

TEST(SawList, SizesCutsAndOffcutsAreThoseOfTheManifests) {
    const json list = json::parse(saw_list_json(some_list()));
    EXPECT_EQ(list["format"], "qchopper saw list");
    EXPECT_EQ(list["blocks"].size(), sawn_jobs().inputs.size());
    for (const JobInput& input : sawn_jobs().inputs) {
        if (input.piece.name == sawn_jobs().inputs[sawn_jobs().middle].piece.name) continue;
        const ReadJob job = parse_job(job_file(input), input.piece.name);
        const json manifest = json::parse(text_of(job.files.at("manifest.json")));
        const auto block = std::find_if(list["blocks"].begin(), list["blocks"].end(),
                                        [&](const json& b) { return b["piece"] == input.piece.name; });
        ASSERT_NE(block, list["blocks"].end());
        EXPECT_EQ((*block)["block_mm"], manifest["stock"]["size"]);
        EXPECT_EQ((*block)["stock"]["name"], manifest["stock"]["name"]);
        EXPECT_EQ((*block)["job"], input.piece.name + ".qjob");
        std::vector<json> offcuts;
        for (const json& cut : (*block)["saw"]) {
            if (!cut["offcut_mm"].is_null()) offcuts.push_back(cut["offcut_mm"]);
            const std::size_t axis = std::string("xyz").find(cut["axis"].get<std::string>());
            EXPECT_EQ(cut["to_mm"], (*block)["block_mm"][axis]);
        }
        ASSERT_EQ(offcuts.size(), manifest["stock"]["offcuts_mm"].size());
        for (const json& offcut : manifest["stock"]["offcuts_mm"]) {
            EXPECT_NE(std::find(offcuts.begin(), offcuts.end(), offcut), offcuts.end());
        }
        for (const json& cap : manifest["setup"].value("flush_caps", json::array())) {
            const bool is_named =
                std::any_of((*block)["glue_faces"].begin(), (*block)["glue_faces"].end(), [&](const json& face) {
                    const json& caps = face["caps"];
                    return face["face"] == cap["face"] && std::find(caps.begin(), caps.end(), cap["cut"]) != caps.end();
                });
            EXPECT_TRUE(is_named) << cap;
        }
    }
}

// Both pieces of a joint say of each other that they are glued, unless the machine makes the face.
TEST(SawList, SaysOfEveryJointWithASawnFaceWhatIsGluedToIt) {
    const SawnJobs& all = sawn_jobs();
    const SawList list = some_list();
    std::size_t named = 0;
    for (const PieceJoint& joint : all.joints) {
        for (const auto& [self, other] : {std::pair(joint.below, joint.above), {joint.above, joint.below}}) {
            const std::string& name = all.segmentation.pieces[self].name;
            const std::string& neighbour = all.segmentation.pieces[other].name;
            const auto block = std::find_if(list.blocks.begin(), list.blocks.end(),
                                            [&](const SawnBlock& b) { return b.piece == name; });
            ASSERT_NE(block, list.blocks.end());
            bool is_said = std::find(block->at_base.begin(), block->at_base.end(), neighbour) != block->at_base.end();
            for (const GlueFace& face : block->glue_faces) {
                const bool is_of_cut = std::find(face.cuts.begin(), face.cuts.end(), joint.cut) != face.cuts.end();
                is_said = is_said || (is_of_cut && std::find(face.neighbours.begin(), face.neighbours.end(),
                                                             neighbour) != face.neighbours.end());
            }
            EXPECT_EQ(is_said, all.inputs[self].setup.is_unmilled(joint.cut)) << name << " at cut " << joint.cut;
            named += is_said ? 1 : 0;
        }
    }
    EXPECT_GE(named, all.joints.size());
}

TEST(SawList, OfThePieceThatTheSawAloneMakesHasItsOwnSize) {
    const SawList list = some_list();
    const JobInput& input = sawn_jobs().inputs[sawn_jobs().middle];
    const auto block = std::find_if(list.blocks.begin(), list.blocks.end(),
                                    [&](const SawnBlock& b) { return b.piece == input.piece.name; });
    ASSERT_NE(block, list.blocks.end());
    EXPECT_FALSE(block->job.has_value());
    const Vec3 piece = input.setup.box.size();
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(block->size[axis], piece[axis], 0.051);
    EXPECT_EQ(block->cuts.size(), 3U);
    for (const SawCuts& cut : block->cuts) EXPECT_EQ(cut.count, 2);
    EXPECT_EQ(block->glue_faces.size(), block_faces);
    EXPECT_FALSE(block->at_base.empty());
    const std::string html = saw_list_html(list);
    EXPECT_TRUE(has(html, "<td>" + input.piece.name + "</td><td>sawn only</td>")) << html;
    EXPECT_TRUE(has(html, "both ends: glue face top, base")) << html;

    JobInput without_spoil = input;  // its base is then the underside of the stock
    without_spoil.setup.spoil = 0;
    const SawList other =
        saw_list("x", 0.5, {*sawn_block("A", std::nullopt, without_spoil.setup, job_caps(input), input.cell)});
    EXPECT_FALSE(has(saw_list_html(other), "glue face top, base"));
}

TEST(SawList, IsSortedByStockAndSettingWhateverTheOrderOfTheBlocks) {
    std::vector<SawnBlock> blocks = all_blocks();
    for (std::size_t i = 0; i < 3; ++i) blocks[i].stock_number = 2 - i;
    const SawList list = saw_list("x", 0.5, blocks);
    std::reverse(blocks.begin(), blocks.end());
    const SawList other = saw_list("x", 0.5, blocks);
    EXPECT_EQ(saw_list_html(list), saw_list_html(other));
    EXPECT_EQ(saw_list_json(list), saw_list_json(other));
    for (std::size_t i = 1; i < list.blocks.size(); ++i) {
        const SawnBlock& a = list.blocks[i - 1];
        const SawnBlock& b = list.blocks[i];
        EXPECT_LE(a.stock_number, b.stock_number);
        if (a.stock_number == b.stock_number) {
            EXPECT_LE(a.cuts.front().length, b.cuts.front().length);
        }
    }
}

TEST(SawList, TellsAPersonTheOrderOfTheCutsAndEscapesEveryText) {
    std::vector<SawnBlock> blocks = all_blocks();
    for (SawnBlock& block : blocks) block.stock.name = "<sheet>";
    const SawList list = saw_list("ball & co.ply", 0.5, blocks);
    const std::string html = saw_list_html(list);
    EXPECT_TRUE(has(html, "<h1>Saw list: ball &amp; co.ply</h1>"));
    EXPECT_TRUE(has(html, "Stock &quot;&lt;sheet&gt;&quot; (pu_foam), 1000 x 600 x 500 mm, saw cut 3 mm"));
    EXPECT_FALSE(has(html, "<sheet>"));
    for (const SawnBlock& block : list.blocks) {
        // The cuts as the row names them, in their order.
        std::size_t at = html.find("<td>" + block.piece + "</td>");
        const std::size_t end = html.find("</tr>", at);
        ASSERT_NE(at, std::string::npos);
        for (const SawCuts& cut : block.cuts) {
            const std::string words = std::string(1, "xyz"[cut.axis]) + " from ";
            at = html.find(words, at + 1);
            EXPECT_LT(at, end) << block.piece << words;
        }
    }
}

TEST(SawList, HasNoBlockThatIsNotSawn) {
    const JobInput whole = some_job();
    EXPECT_FALSE(sawn_block("AB", "AB.qjob", whole.setup, {}, whole.cell).has_value());
    const JobInput sawn = tilting_job();
    EXPECT_TRUE(sawn_block("AB", "AB.qjob", sawn.setup, {}, sawn.cell).has_value());
}

}  // namespace
}  // namespace qchopper
