// What explain says of a cut, held against the totals that it lists.

#include "app/report/explanation.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

Ranked ranked(double total, int normal) {
    Ranked r;
    r.normal_index = normal;
    r.plane = {{0, 0, 1}, total};
    r.terms.total = total;
    return r;
}

// A cut by a plane of that kind and total; its place among the others is that of the same plane.
Explanation cut_by_plane(int kind, double total, std::vector<Ranked> among) {
    Explanation e;
    e.cut.number = 1;
    e.cut.piece = "A";
    e.cut.chosen = ranked(total, kind);
    e.chosen = e.cut.chosen;
    e.ranked = std::move(among);
    for (std::size_t i = 0; i < e.ranked.size(); ++i) {
        e.listed.push_back(i);
        if (e.ranked[i].plane == e.chosen.plane) e.place = i;
    }
    return e;
}

bool says(const Explanation& e, const std::string& words) {
    return describe(e).find(words) != std::string::npos;
}

TEST(Explanation, CallsAPlaneTheOperatorsOwnOnlyIfItIs) {
    const std::vector<Ranked> others{ranked(2, 0), ranked(3, 1)};
    EXPECT_TRUE(says(cut_by_plane(own_index, 2.5, others), "the operator's own"));
    EXPECT_TRUE(says(cut_by_plane(own_index, 2.5, {}), "the operator's own"));
    for (const int kind : {0, refined_index, symmetry_index, given_index, mirror_index, refined_given_index}) {
        const Explanation e = cut_by_plane(kind, 2.5, others);
        EXPECT_FALSE(says(e, "operator")) << describe(e);
        EXPECT_FALSE(says(cut_by_plane(kind, 2.5, {}), "operator")) << describe(e);
        for (const std::string& line : lines(e, Project{}, "plot.svg")) {
            EXPECT_EQ(line.find("own"), std::string::npos) << line;
        }
    }
}

TEST(Explanation, CallsAPlaneTheBestOnlyIfNoOtherCostsLess) {
    const Explanation first =
        cut_by_plane(refined_index, 2.5, {ranked(2.5, refined_index), ranked(2, 0), ranked(3, 1)});
    EXPECT_EQ(describe(first).find("The plane is number 2 of 3: the best would cost 0.500 less"), 0U)
        << describe(first);
    const Explanation best = cut_by_plane(0, 2, {ranked(2, 0), ranked(2.5, 1)});
    EXPECT_EQ(describe(best).find("The plane is the best of 2; the next would cost 0.500 more"), 0U) << describe(best);
    const Explanation beside = cut_by_plane(refined_index, 1.5, {ranked(2, 0), ranked(3, 1)});
    EXPECT_TRUE(says(beside, "the best of them would cost 0.500 more")) << describe(beside);
    const Explanation dear = cut_by_plane(own_index, 5, {ranked(2, 0), ranked(3, 1)});
    EXPECT_TRUE(says(dear, "the best of them would cost 3.000 less")) << describe(dear);
    const Explanation only = cut_by_plane(0, 2, {ranked(2, 0)});
    EXPECT_EQ(describe(only), "The plane is the only candidate that parts the piece.");
}

TEST(Explanation, NamesTheMethodThatProposedAPlane) {
    Explanation e = cut_by_plane(refined_given_index, 1, {ranked(2, 0), ranked(3, 1)});
    EXPECT_FALSE(says(e, "proposed"));
    e.proposer = "shlafman";
    EXPECT_TRUE(says(e, "It was proposed by shlafman, along a border between two regions of the scan."));
}

// The row of the chosen plane, from 1; its total puts it there.
std::size_t row_of_chosen(const Explanation& e) {
    const std::vector<std::string> text = lines(e, Project{}, "plot.svg");
    std::size_t head = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i].find("offset mm") != std::string::npos) head = i;
        if (text[i].starts_with("->")) return i - head;
    }
    return 0;
}

TEST(Explanation, ListsThePlaneWhereItsTotalPutsIt) {
    const std::vector<Ranked> others{ranked(2, 0), ranked(3, 1)};
    EXPECT_EQ(row_of_chosen(cut_by_plane(refined_index, 1, others)), 1U);
    EXPECT_EQ(row_of_chosen(cut_by_plane(refined_index, 2.5, others)), 2U);
    EXPECT_EQ(row_of_chosen(cut_by_plane(own_index, 4, others)), 3U);
}

TEST(Explanation, SaysThatSetupsReplacedAPlane) {
    Project project;
    project.review = SetupReview{};
    CutReview of_cut;
    of_cut.cut = 1;
    of_cut.piece = "A";
    of_cut.outcome = ReviewOutcome::replaced;
    of_cut.planes = 3;
    of_cut.before = {30, 100};
    of_cut.best = {10, 100};
    CutReview of_other = of_cut;
    of_other.cut = 2;
    project.review->cuts = {of_other, of_cut};
    std::size_t found = 0;
    for (const std::string& line : lines(cut_by_plane(0, 2, {ranked(1, 1), ranked(2, 0)}), project, "plot.svg")) {
        if (line.find("by their setups another plane leaves") != std::string::npos) ++found;
    }
    EXPECT_EQ(found, 1U);
}

}  // namespace
}  // namespace qchopper
