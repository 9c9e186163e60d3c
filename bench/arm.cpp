// Measures the inverse kinematics of robot arms, all configurations and their turns within the ranges, in calls of
// std::atan2 that are timed in the same run. CPU time of one thread.

#include "cam/cell/arm.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "tests/cam/cell/arms.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_arm [--small]
  --small  a hundredth of the poses, to check that it runs; the target does not apply
)";

constexpr int runs = 7;
constexpr double margin = 0.05;  // radians, about 3 degrees

// Poses that joints within the ranges reach, each with the joints of another pose as its neighbour.
struct Sample {
    std::vector<Pose> poses;
    std::vector<Joints> neighbours;
};

Sample sample_of(const NamedArm& arm, std::size_t count) {
    std::mt19937 random(1);
    Sample sample;
    for (std::size_t i = 0; i < count; ++i) {
        Joints joints{};
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            joints[axis] = std::uniform_real_distribution(arm.ranges[axis].min, arm.ranges[axis].max)(random);
        }
        sample.poses.push_back(forward(arm.geometry, joints));
        sample.neighbours.push_back(joints);
    }
    std::rotate(sample.neighbours.begin(), sample.neighbours.begin() + 1, sample.neighbours.end());
    return sample;
}

// Seconds of one call.
double atan2_s(std::size_t count) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    std::vector<double> y(count);
    std::vector<double> x(count);
    for (std::size_t i = 0; i < count; ++i) {
        y[i] = coordinate(random);
        x[i] = coordinate(random);
    }
    volatile double kept = 0;
    const double seconds = best_of(runs, cpu_s, [&] {
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) sum += std::atan2(y[i], x[i]);
        kept = sum;
        return sum;
    });
    return seconds / static_cast<double>(count);
}

void measure_arm(const NamedArm& arm, std::size_t count, Figures& figures) {
    const Sample sample = sample_of(arm, count);
    std::size_t answers = 0;
    double inverse_s = INFINITY;
    double call_s = INFINITY;
    for (int i = 0; i < runs; ++i) {  // by turns, so that both meet the same load of the machine
        inverse_s = std::min(
            inverse_s, best_of(1, cpu_s, [&] {
                answers = 0;
                for (std::size_t k = 0; k < count; ++k) {
                    answers +=
                        inverse_within(arm.geometry, arm.ranges, margin, sample.poses[k], sample.neighbours[k]).size();
                }
                return answers;
            }));
        call_s = std::min(call_s, atan2_s(count));
    }
    const double calls = static_cast<double>(count);
    figures.record(arm.name, "answers of a pose within the ranges", number_text(static_cast<double>(answers) / calls));
    figures.record(arm.name, "inverse of a pose, and one std::atan2",
                   time_text(inverse_s / calls) + " and " + time_text(call_s));
    figures.at_most(arm.name, "inverse with ranges / std::atan2", inverse_s / calls / call_s, 150);
}

void measure(const Choice& choice, Figures& figures) {
    const std::size_t count = choice.is_small ? 2'000 : 200'000;
    for (const NamedArm& arm : real_arms()) measure_arm(arm, count, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
