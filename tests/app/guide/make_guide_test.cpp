#include "app/guide/make_guide.h"

#include <gtest/gtest.h>

#include "tests/app/guide/cut_box.h"

namespace qchopper {
namespace {

const GuideSection* section_named(const AssemblyGuide& guide, const std::string& title) {
    const auto found = std::find_if(guide.sections.begin(), guide.sections.end(),
                                    [&](const GuideSection& section) { return section.title == title; });
    return found == guide.sections.end() ? nullptr : &*found;
}

template <class Block>
std::vector<Block> all_of(const GuideSection& section) {
    std::vector<Block> found;
    for (const GuideBlock& block : section.blocks) {
        if (const auto* one = std::get_if<Block>(&block)) found.push_back(*one);
    }
    return found;
}

OrderContent jobs_of(const CutBox& box) {
    OrderContent jobs;
    for (const Piece& piece : box.pieces()) {
        SheetOfOrder sheet;
        sheet.file = piece.name + ".qjob";
        sheet.piece = piece.name;
        sheet.block_name = "large";
        sheet.block = {120, 110, 90};
        sheet.holes_by_hand = 2;
        jobs.sheets.push_back(sheet);
    }
    return jobs;
}

TEST(MakeGuide, HasAStepForEachStepAndEveryJointInOneOfThem) {
    const CutBox box;
    const OrderContent jobs = jobs_of(box);
    const AssemblyGuide guide = make_guide({"box.ply", box.pieces(), box.joints, jobs}, {});
    std::size_t joints = 0;
    for (std::size_t i = 1; i <= 2; ++i) {
        const GuideSection* step = section_named(guide, "Step " + std::to_string(i) + " of 2");
        ASSERT_NE(step, nullptr);
        EXPECT_EQ(all_of<GuidePictures>(*step).size(), 1U);
        for (const GuideTable& table : all_of<GuideTable>(*step)) joints += table.rows.size() - 1;
        EXPECT_EQ(all_of<GuideText>(*step).front().text.substr(0, 5), "Move ");
    }
    EXPECT_EQ(joints, box.joints.joints.size());
    EXPECT_EQ(section_named(guide, "Step 3 of 2"), nullptr);
}

TEST(MakeGuide, SaysOnEveryPieceWhatToWriteAndWhatIsLeftToTheHand) {
    const CutBox box;
    const OrderContent jobs = jobs_of(box);
    const AssemblyGuide guide = make_guide({"box.ply", box.pieces(), box.joints, jobs}, {});
    std::size_t names = 0;
    for (const Piece& piece : box.pieces()) {
        const GuideSection* section = section_named(guide, "Piece " + piece.name);
        ASSERT_NE(section, nullptr);
        names += all_of<GuideTable>(*section).front().rows.size() - 1;
        EXPECT_EQ(all_of<GuidePictures>(*section).front().pictures.size(), 2U);
        EXPECT_EQ(all_of<GuideText>(*section).back().text,
                  "Drill 2 holes by hand, by the templates in " + piece.name + ".qjob.");
    }
    EXPECT_EQ(names, 2 * box.joints.joints.size()) << "each joint on both of its faces";
}

TEST(MakeGuide, CountsDowelsAndMassesOfAllPieces) {
    const CutBox box;
    const OrderContent jobs = jobs_of(box);
    const AssemblyGuide guide = make_guide({"box.ply", box.pieces(), box.joints, jobs}, {});
    std::size_t dowels = 0;
    for (const PieceJoint& joint : box.joints.joints) dowels += joint.dowels.size();
    std::size_t counted = 0;
    const GuideTable table = all_of<GuideTable>(guide.sections.front()).front();
    for (std::size_t r = 1; r < table.rows.size(); ++r) counted += std::stoul(table.rows[r][0]);
    EXPECT_EQ(counted, dowels);
    const GuideTable blocks = all_of<GuideTable>(*section_named(guide, "Blocks")).front();
    double grams = 0;
    for (std::size_t r = 1; r < blocks.rows.size(); ++r) grams += std::stod(blocks.rows[r].back());
    EXPECT_NEAR(grams, 200. * 100 * 80 * 1e-9 * 100 * 1000, 2) << "the whole box at 100 kg/m3";
}

TEST(MakeGuide, APieceThatTouchesNothingYetIsToBeHeld) {
    CutBox box;
    box.joints.assembly.steps[0].joints.clear();
    const OrderContent jobs = jobs_of(box);
    const AssemblyGuide guide = make_guide({"box.ply", box.pieces(), box.joints, jobs}, {});
    const std::vector<GuideText> texts = all_of<GuideText>(*section_named(guide, "Step 1 of 2"));
    ASSERT_EQ(texts.size(), 2U);
    EXPECT_TRUE(texts[1].is_warning);
    EXPECT_EQ(texts[1].text, "Hold it: it touches nothing yet.");
}

TEST(MakeGuide, CanBeCancelled) {
    const CutBox box;
    const std::atomic<bool> cancelled = true;
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(make_guide({"box.ply", box.pieces(), box.joints, jobs_of(box)}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
