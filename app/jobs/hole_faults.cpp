// Holes of one cap are paired by distance, each hole of the project with the nearest one of the job that is free: equal
// ones first, so that a hole that is missing never takes the mate of another. Numbers are not compared, because
// they count through the holes of a job.

#include "app/jobs/hole_faults.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text.h"

namespace qchopper {
namespace {

constexpr double tolerance = 1e-3;  // mm, and of the axis; a manifest holds doubles
constexpr double max_shifted = 10;  // mm; farther away it is another hole: dowels stand at least 12 mm apart

// A hole with its joint.
struct JointHole {
    std::int32_t cut = 0;
    std::string neighbour;
    JobHole hole;
    bool is_paired = false;
};

std::vector<JointHole> listed(const std::vector<JobCap>& caps) {
    std::vector<JointHole> all;
    for (const JobCap& cap : caps) {
        for (const CapJoint& joint : cap.joints) {
            for (const JobHole& hole : joint.holes) all.push_back({cap.cut, joint.neighbour, hole});
        }
    }
    return all;
}

std::string at_joint(const JointHole& own) {
    return "the joint with piece " + own.neighbour + " at cut " + std::to_string(own.cut);
}

class HoleComparison {
 public:
    HoleComparison(const std::string& piece, const std::vector<JobCap>& job, const std::vector<JobCap>& project)
        : piece_("piece " + piece), job_(listed(job)), project_(listed(project)) {
        compare_joints(job, project);
        pair_within(tolerance);
        pair_within(max_shifted);
        for (const JointHole& due : project_) {
            if (!due.is_paired)
                add("other_hole", "hole " + std::to_string(due.hole.number) + " of the project, of " + at_joint(due) +
                                      ", is missing");
        }
        for (const JointHole& own : job_) {
            if (!own.is_paired)
                add("other_hole", name_of(own) + ", at " + at_joint(own) + ", is none of the project's");
        }
    }

    std::vector<ProofFinding> take() { return std::move(faults_); }

 private:
    static std::string name_of(const JointHole& own) { return "hole " + std::to_string(own.hole.number); }

    void add(const char* kind, const std::string& text) { faults_.push_back({kind, "", 0, piece_ + ": " + text}); }

    void compare_joints(const std::vector<JobCap>& job, const std::vector<JobCap>& project) {
        const auto names = [](const std::vector<JobCap>& caps) {
            std::vector<std::string> all;
            for (const JobCap& cap : caps) {
                for (const CapJoint& joint : cap.joints) all.push_back(at_joint({cap.cut, joint.neighbour, {}}));
            }
            std::sort(all.begin(), all.end());
            return all;
        };
        const std::vector<std::string> own = names(job);
        const std::vector<std::string> due = names(project);
        std::vector<std::string> odd;
        std::set_difference(due.begin(), due.end(), own.begin(), own.end(), std::back_inserter(odd));
        for (const std::string& joint : odd) add("other_joint", joint + " is missing");
        odd.clear();
        std::set_difference(own.begin(), own.end(), due.begin(), due.end(), std::back_inserter(odd));
        for (const std::string& joint : odd) add("other_joint", joint + " is none of the project's");
    }

    void pair_within(double most) {
        for (JointHole& due : project_) {
            if (due.is_paired) continue;
            JointHole* nearest = nullptr;
            double least = most;
            for (JointHole& own : job_) {
                const double away = norm(own.hole.point - due.hole.point);
                if (own.is_paired || own.cut != due.cut || !(away <= least)) continue;
                if (nearest != nullptr && away == least) continue;
                least = away;
                nearest = &own;
            }
            if (nearest == nullptr) continue;
            nearest->is_paired = due.is_paired = true;
            compare(*nearest, due, least);
        }
    }

    void compare(const JointHole& own, const JointHole& due, double away) {
        const std::string name = name_of(own);
        if (own.neighbour != due.neighbour)
            add("other_hole", name + " is listed for " + at_joint(own) + ", it belongs to " + at_joint(due));
        if (away > tolerance)
            add("other_hole", name + " stands " + fixed(away, 3) + " mm from its place in " + at_joint(due));
        if (norm(own.hole.axis - due.hole.axis) > tolerance)
            add("other_hole", name + " has another axis than " + at_joint(due));
        compare_length(name, "wide", own.hole.diameter, due.hole.diameter, due);
        compare_length(name, "deep", own.hole.depth, due.hole.depth, due);
    }

    void compare_length(const std::string& name, const std::string& word, double own, double due, const JointHole& of) {
        if (std::abs(own - due) <= tolerance) return;
        add("other_hole",
            name + " is " + fixed(own, 3) + " mm " + word + ", in " + at_joint(of) + " it is " + fixed(due, 3) + " mm");
    }

    std::string piece_;
    std::vector<JointHole> job_;
    std::vector<JointHole> project_;
    std::vector<ProofFinding> faults_;
};

}  // namespace

std::vector<ProofFinding> hole_faults(const std::string& piece, const std::vector<JobCap>& job,
                                      const std::vector<JobCap>& project) {
    return HoleComparison(piece, job, project).take();
}

}  // namespace qchopper
