#include "segment/search/recut.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/mesh/measure.h"
#include "segment/search/cut_list.h"
#include "segment/search/piece_names.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Cut planned(std::int32_t number, const std::string& piece, Vec3 normal, double offset) {
    Cut cut;
    cut.number = number;
    cut.piece = piece;
    cut.chosen.plane = {normal, offset};
    return cut;
}

// A torus about z, ring radius 30, tube radius 10, beside a ball: cut 1 halves the ring into two arcs, cuts 2 and 3
// each arc along its bend, cut 4 the ball.
const TriangleMesh& scan() {
    static const TriangleMesh mesh =
        shapes::joined({shapes::ball({100, 0, 0}, 12), shapes::torus({0, 0, 0}, 30, 10, 24)});
    return mesh;
}

Segmentation made(const std::vector<Cut>& cuts) {
    Segmentation s = uncut(scan(), 0);
    for (const Cut& cut : cuts) EXPECT_TRUE(apply(s, cut, 0)) << cut.number << " " << cut.piece;
    return s;
}

std::vector<Cut> four_cuts() {
    // Uncut: A and B. Cut 1 makes C, D; cut 2 makes E, F; cut 3 G, H; cut 4 I, J.
    const Segmentation uncut_scan = uncut(scan(), 0);
    const bool is_ball_first = uncut_scan.pieces.front().mesh->points.front().x > 60;
    const std::string ball = is_ball_first ? "A" : "B";
    const std::string ring = is_ball_first ? "B" : "A";
    return {planned(1, ring, {1, 0, 0}, 0.123), planned(2, "C", {0, 0, 1}, 0.4), planned(3, "D", {0, 0, 1}, -0.3),
            planned(4, ball, {1, 0, 0}, 100.2)};
}

void expect_same(const Segmentation& a, const Segmentation& b) {
    EXPECT_EQ(a.cuts, b.cuts);
    EXPECT_EQ(a.names_given, b.names_given);
    EXPECT_EQ(a.warnings, b.warnings);
    ASSERT_EQ(a.fragments.size(), b.fragments.size());
    for (std::size_t i = 0; i < a.fragments.size(); ++i) {
        EXPECT_EQ(a.fragments[i].cut, b.fragments[i].cut);
        EXPECT_EQ(*a.fragments[i].mesh, *b.fragments[i].mesh);
    }
    ASSERT_EQ(a.pieces.size(), b.pieces.size());
    for (std::size_t i = 0; i < a.pieces.size(); ++i) {
        EXPECT_EQ(a.pieces[i].name, b.pieces[i].name);
        EXPECT_EQ(a.pieces[i].half_spaces, b.pieces[i].half_spaces);
        EXPECT_EQ(*a.pieces[i].mesh, *b.pieces[i].mesh);
    }
}

// Replaces cut `number` by another plane and compares with all cuts applied to the scan.
void expect_as_if_chosen_at_once(std::int32_t number, Vec3 normal, double offset, std::size_t pieces,
                                 double fragment_volume_mm3 = 0) {
    Segmentation s = uncut(scan(), fragment_volume_mm3);
    Piece divided;
    for (const Cut& cut : four_cuts()) {
        for (const Piece& piece : s.pieces) {
            if (cut.number == number && piece.name == cut.piece) divided = piece;
        }
        ASSERT_TRUE(apply(s, cut, fragment_volume_mm3));
    }
    const auto alone = cut_alone(s, divided, planned(number, divided.name, normal, offset), fragment_volume_mm3);
    ASSERT_TRUE(alone);
    ASSERT_EQ(alone->pieces.size(), pieces);
    const Segmentation replaced = recut(s, *alone);
    Segmentation fresh = uncut(scan(), fragment_volume_mm3);
    for (const Cut& cut : replaced.cuts) ASSERT_TRUE(apply(fresh, cut, fragment_volume_mm3));
    expect_same(replaced, fresh);
    for (std::size_t i = 0; i < s.pieces.size(); ++i) {
        if (made_by(s.pieces[i]) < number) {
            EXPECT_EQ(replaced.pieces[i].mesh, s.pieces[i].mesh) << "others are shared";
        }
    }
}

TEST(Recut, IsAsIfThePlaneHadBeenChosenAtOnce) {
    expect_as_if_chosen_at_once(2, {0, 0, 1}, -3.3, 2);
    expect_as_if_chosen_at_once(3, {0, 0, 1}, 5.5, 2);
    expect_as_if_chosen_at_once(4, {0, 1, 0}, 0.4, 2);
}

TEST(Recut, MorePiecesGiveThoseOfLaterCutsOtherNames) {
    // Across both arms of an arc: two ends and the bend.
    const Segmentation halved = made({four_cuts().front()});
    const auto c = std::find_if(halved.pieces.begin(), halved.pieces.end(), [](auto& p) { return p.name == "C"; });
    const double side = bounds(*c->mesh).centre().x > 0 ? 1 : -1;
    expect_as_if_chosen_at_once(2, {1, 0, 0}, side * 10.2, 3);
    expect_as_if_chosen_at_once(3, {1, 0, 0}, side * -10.2, 3);
}

TEST(Recut, FragmentsAreThoseOfThePlaneThatIsTaken) {
    expect_as_if_chosen_at_once(4, {1, 0, 0}, 111.0, 1, 100);
    expect_as_if_chosen_at_once(2, {0, 0, 1}, -9.5, 1, 300);
}

// Whatever their texts begin with.
TEST(Recut, WarningsOfTheCutAreReplacedAndThoseOfOthersStayInOrder) {
    std::vector<Cut> cuts = four_cuts();
    Segmentation s = made({cuts[0]});
    const auto divided = std::find_if(s.pieces.begin(), s.pieces.end(), [](auto& p) { return p.name == "C"; });
    const Piece piece = *divided;
    for (std::size_t i = 1; i < cuts.size(); ++i) ASSERT_TRUE(apply(s, cuts[i], 0));
    s.warnings = {{0, "cut 2: of the scan"}, {1, "first"}, {2, "cut 3: old"}, {2, "older"}, {3, "third"}};
    std::optional<Segmentation> alone = cut_alone(s, piece, planned(2, "C", {0, 0, 1}, -3.3), 0);
    ASSERT_TRUE(alone);
    alone->warnings = {{2, "new"}};
    const std::vector<SegmentationWarning> expected{{0, "cut 2: of the scan"}, {1, "first"}, {2, "new"}, {3, "third"}};
    EXPECT_EQ(recut(s, *alone).warnings, expected);
    EXPECT_EQ(texts(expected, 2), (std::vector<std::string>{"new", "third"}));
}

TEST(CutList, NamesOfLaterCutsFollowWhereMorePiecesAreMade) {
    const auto cut = [](std::int32_t number, const char* piece, std::vector<std::string> pieces) {
        Cut c;
        c.number = number;
        c.piece = piece;
        c.pieces = std::move(pieces);
        return c;
    };
    std::vector<Cut> cuts{cut(1, "A", {"B", "C"}), cut(2, "B", {"D", "E"}), cut(3, "C", {"F", "G"}),
                          cut(4, "F", {"H", "I"})};
    EXPECT_FALSE(is_last_of_its_pieces(cuts, 1));
    EXPECT_TRUE(is_last_of_its_pieces(cuts, 2));
    EXPECT_FALSE(is_last_of_its_pieces(cuts, 3));
    EXPECT_FALSE(can_replace(cuts, cut(1, "A", {"B", "C"}))) << "B and C are cut";
    EXPECT_FALSE(can_replace(cuts, cut(5, "A", {"B"})));
    EXPECT_FALSE(can_replace(cuts, cut(0, "A", {"B"})));
    EXPECT_FALSE(can_replace(cuts, cut(2, "C", {"D", "E"}))) << "another piece";
    EXPECT_FALSE(can_replace(cuts, cut(2, "B", {"E", "F"}))) << "other names";
    EXPECT_FALSE(can_replace(cuts, cut(2, "B", {"D", "e"})));
    replace_cut(cuts, cut(2, "B", {"D", "E", "F"}));
    EXPECT_EQ(cuts[2], cut(3, "C", {"G", "H"}));
    EXPECT_EQ(cuts[3], cut(4, "G", {"I", "J"}));
    replace_cut(cuts, cut(2, "B", {"D"}));
    EXPECT_EQ(cuts[2], cut(3, "C", {"E", "F"}));
    EXPECT_EQ(cuts[3], cut(4, "E", {"G", "H"}));
}

TEST(PieceNames, AreReadBack) {
    for (const std::size_t index : {0U, 25U, 26U, 27U, 701U, 702U, 123456U}) {
        EXPECT_TRUE(is_piece_name(piece_name(index)));
        EXPECT_EQ(piece_index(piece_name(index)), index);
    }
    EXPECT_FALSE(is_piece_name(""));
    EXPECT_FALSE(is_piece_name("A1"));
    EXPECT_FALSE(is_piece_name("a"));
}

}  // namespace
}  // namespace qchopper
