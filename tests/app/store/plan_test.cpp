#include "app/store/plan.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/measure.h"
#include "tests/app/engine/planned.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Plan some_plan() {
    const TriangleMesh mesh = shapes::linked_tori();
    return make_plan(planned::project_of(mesh, {12.5, -3.25, 1.0 / 3}, 3), mesh);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(Plan, WrittenAndReadAgainIsTheSamePlan) {
    const Plan plan = some_plan();
    EXPECT_EQ(plan_from_text(to_text(plan), "p.toml"), plan);
    Plan odd = plan;
    odd.scan.name = "a \"bone\" \\ of 3\xC2\xB5m.ply";
    odd.weights = {0, 1e-7, 1e7, 1.0 / 3};
    EXPECT_EQ(plan_from_text(to_text(odd), "p.toml"), odd);
    odd.cuts.clear();
    EXPECT_EQ(plan_from_text(to_text(odd), "p.toml"), odd);
}

TEST(Plan, IsInTheFrameOfTheFile) {
    const Plan plan = some_plan();
    EXPECT_EQ(plan.cuts.size(), 3U);
    EXPECT_TRUE(has_plan_header(to_text(plan)));
    EXPECT_FALSE(has_plan_header("solid"));
    const TriangleMesh mesh = shapes::linked_tori();
    for (const PlanCut& cut : plan.cuts) {
        EXPECT_NEAR(cut.plane.offset - height(cut.plane.normal, plan.scan.centre), cut.from_centre, 1e-12);
        EXPECT_TRUE(is_inside(mesh, cut.inside - plan.scan.centre));
        EXPECT_GE(cut.makes_mm3.size(), 2U);
    }
    EXPECT_TRUE(plan.cuts[0].path.empty());
}

TEST(Plan, AMovedOffsetNeedsNoSecondNumber) {
    const Plan plan = some_plan();
    std::string text = to_text(plan);
    const std::size_t at = text.find("offset_from_centre_mm");
    text.erase(at, text.find('\n', at) + 1 - at);
    const Plan read = plan_from_text(text, "p.toml");
    EXPECT_NEAR(read.cuts[0].from_centre, plan.cuts[0].from_centre, 1e-12);
}

TEST(Plan, EveryFaultIsOneClearErrorWithFileLineAndKey) {
    const std::string text = to_text(some_plan());
    const std::pair<std::string, std::string> faults[] = {
        {"schema = 1", "schema = 2"},
        {"schema = 1", "schema = \"1\""},
        {"units = \"mm\"", "units = \"ell\""},
        {"scale = 1.0", "scale = -1.0"},
        {"scale = 1.0", "scale = nan"},
        {"[weights]", "[weight]"},
        {"number = 1", "number = 7"},
        {"number = 1", "colour = 1"},
        {"normal = [", "normal = [0.0, "},
        {"path = []", "path = [\"1 beside\"]"},
        {"path = []", "path = [\"9 above\"]"},
        {"offset_mm = ", "offset_mm = 9"},
        {"makes_mm3 = [", "makes_mm3 = [true, "},
    };
    for (const auto& [from, to] : faults) {
        try {
            plan_from_text(replaced(text, from, to), "p.toml");
            ADD_FAILURE() << to;
        } catch (const InputError& e) {
            EXPECT_EQ(e.fault, InputFault::config);
            EXPECT_NE(std::string(e.what()).find("p.toml:"), std::string::npos) << e.what();
        }
    }
    for (std::size_t length = 1; length + 2 < text.size(); length += 61) {
        try {
            plan_from_text(std::string_view(text).substr(0, length), "p.toml");
        } catch (const InputError& e) {
            EXPECT_EQ(e.fault, InputFault::config);
        }
    }
}

}  // namespace
}  // namespace qchopper
