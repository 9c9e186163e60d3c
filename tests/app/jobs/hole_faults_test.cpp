#include "app/jobs/hole_faults.h"

#include <gtest/gtest.h>

#include <functional>

#include "cam/job/job_caps.h"
#include "segment/joint/piece_joints.h"
#include "tests/segment/joint/cut_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The caps of the piece of a box that touches two others.
std::vector<JobCap> caps_of_corner() {
    Segmentation s = uncut(shapes::box({0, 0, 0}, {200, 100, 80}, 3), 0);
    EXPECT_TRUE(cut_at(s, "A", {{1, 0, 0}, 110}));
    EXPECT_TRUE(cut_at(s, s.pieces[0].name, {{0, 1, 0}, 40}));
    const std::vector<PieceJoint> joints = piece_joints(s.pieces, {});
    Setup setup;
    setup.piece_in_setup.shift = {3, 4, 5};
    std::vector<JobCap> caps;
    for (std::size_t p = 0; p < s.pieces.size() && caps.size() < 2; ++p) {
        caps.clear();
        for (const DrawnCap& drawn : caps_of(s.pieces, p, joints, setup, {})) caps.push_back(drawn.cap);
    }
    return caps;
}

struct Change {
    std::string name;
    std::function<void(std::vector<JobCap>&)> make;
    std::vector<std::string> findings;  // of these words each
};

TEST(HoleFaults, AreNamedWithPieceAndHole) {
    const std::vector<JobCap> made = caps_of_corner();
    ASSERT_EQ(made.size(), 2U);
    ASSERT_EQ(holes_of(made).size(), 4U);
    EXPECT_TRUE(hole_faults("B", made, made).empty());
    const auto holes = [](std::vector<JobCap>& caps) -> std::vector<JobHole>& { return caps[0].joints[0].holes; };
    const std::string mate = made[0].joints[0].neighbour;
    const std::string other = made[1].joints[0].neighbour;
    ASSERT_NE(mate, other);
    const std::vector<Change> changes{
        {"missing",
         [&](auto& c) { holes(c).erase(holes(c).begin()); },
         {"hole 1 of the project, of the joint with piece " + mate}},
        {"too many", [&](auto& c) { holes(c).push_back(holes(c)[0]), holes(c).back().number = 9; }, {"hole 9, at"}},
        {"shifted", [&](auto& c) { holes(c)[1].point.y += 0.01; }, {"hole 2 stands 0.010 mm from its place"}},
        {"far away",
         [&](auto& c) { holes(c)[1].point.y += 500; },
         {"hole 2 of the project, of the joint with piece " + mate, "hole 2, at the joint with piece " + mate}},
        {"wider", [&](auto& c) { holes(c)[0].diameter += 0.5; }, {"hole 1 is 8.500 mm wide"}},
        {"deeper", [&](auto& c) { holes(c)[0].depth += 0.5; }, {"hole 1 is 22.500 mm deep"}},
        {"other axis", [&](auto& c) { holes(c)[0].axis = -1.0 * holes(c)[0].axis; }, {"hole 1 has another axis"}},
        {"other mate",
         [&](auto& c) { c[0].joints[0].neighbour = "Z"; },
         {"the joint with piece " + mate + " at cut", "the joint with piece Z at cut",
          "hole 1 is listed for the joint with piece Z", "hole 2 is listed"}},
        {"no cap",
         [&](auto& c) { c.erase(c.begin()); },
         {"the joint with piece " + mate, "hole 1 of the project", "hole 2 of the project"}},
    };
    for (const Change& change : changes) {
        std::vector<JobCap> caps = made;
        change.make(caps);
        const std::vector<ProofFinding> found = hole_faults("B", caps, made);
        ASSERT_EQ(found.size(), change.findings.size()) << change.name;
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_TRUE(found[i].text.starts_with("piece B: " + change.findings[i]))
                << change.name << ": " << found[i].text;
        }
    }
}

}  // namespace
}  // namespace qchopper
