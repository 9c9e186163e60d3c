// The frames of the arm are chained from axis to axis. Inverse: the wrist centre decides the angles 1 to 3, up to four
// ways, by the triangle of shoulder, elbow and wrist centre; what is left of the rotation decides 4 to 6. The paper
// takes both corners of the triangle by acos, which near a stretched arm loses half of the digits in each; here the
// corner at the shoulder follows from the one at the elbow, and angle 6 from angle 4, so that the loss in one is made
// up by the other and the pose stays exact. O(1): about 20 inverse functions for 8 answers. Joint speeds: Gaussian
// elimination with partial pivoting.

#include "cam/cell/arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double full_turn = 2 * pi;
constexpr double smallest_sine = 1e-9;      // of angle 5; below, the wrist is singular
constexpr double smallest_distance = 1e-9;  // mm; a wrist centre nearer to axis 1 has no direction from it
constexpr double largest_excess = 1e-9;     // of a cosine, by rounding
constexpr double smallest_pivot = 1e-9;

bool is_finite(Vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool is_finite(const Pose& pose) {
    return is_finite(pose.row[0]) && is_finite(pose.row[1]) && is_finite(pose.row[2]) && is_finite(pose.shift);
}

bool is_finite(const Joints& joints) {
    return std::all_of(joints.begin(), joints.end(), [](double joint) { return std::isfinite(joint); });
}

// To -pi..pi.
double wrapped(double angle) {
    return std::abs(angle) <= pi ? angle : std::remainder(angle, full_turn);
}

double angle_of(const ArmGeometry& arm, const Joints& joints, std::size_t axis) {
    return arm.sign[axis] * joints[axis] - arm.offset[axis];
}

double joint_of(const ArmGeometry& arm, double angle, std::size_t axis) {
    return wrapped(arm.sign[axis] * (angle + arm.offset[axis]));
}

// A rotation by its columns: the axes of a frame in the base.
struct Columns {
    Vec3 x;
    Vec3 y;
    Vec3 z;
};

Columns columns_of(const Pose& pose) {
    const auto& r = pose.row;
    return {{r[0].x, r[1].x, r[2].x}, {r[0].y, r[1].y, r[2].y}, {r[0].z, r[1].z, r[2].z}};
}

Columns turned_about_z(const Columns& f, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * f.x + s * f.y, c * f.y - s * f.x, f.z};
}

Columns turned_about_y(const Columns& f, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * f.x - s * f.z, f.y, s * f.x + c * f.z};
}

// Where the parts of the arm are.
struct ArmFrames {
    Columns shoulder;  // turned by angle 1
    Columns forearm;   // turned by angles 1 to 3
    Columns wrist;     // turned by angles 1 to 4
    Columns flange;
    Vec3 axis_2;  // a point of it
    Vec3 axis_3;  // a point of it
    Vec3 wrist_centre;
    Vec3 tip;  // origin of the flange
};

ArmFrames frames_of(const ArmGeometry& arm, const Joints& joints) {
    const auto angle = [&](std::size_t axis) { return angle_of(arm, joints, axis); };
    ArmFrames frames;
    frames.shoulder = turned_about_z({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, angle(0));
    const Columns upper = turned_about_y(frames.shoulder, angle(1));
    frames.forearm = turned_about_y(upper, angle(2));
    frames.wrist = turned_about_z(frames.forearm, angle(3));
    frames.flange = turned_about_z(turned_about_y(frames.wrist, angle(4)), angle(5));
    frames.axis_2 = arm.a1 * frames.shoulder.x + arm.c1 * frames.shoulder.z;
    frames.axis_3 = frames.axis_2 + arm.c2 * upper.z;
    frames.wrist_centre =
        frames.axis_3 + arm.a2 * frames.forearm.x + arm.b * frames.forearm.y + arm.c3 * frames.forearm.z;
    frames.tip = frames.wrist_centre + arm.c4 * frames.flange.z;
    return frames;
}

// From axis 3 to the wrist centre, seen along axis 3.
struct Forearm {
    explicit Forearm(const ArmGeometry& arm) : length(std::hypot(arm.a2, arm.c3)), bend(std::atan2(arm.a2, arm.c3)) {}
    double length;  // mm
    double bend;    // angle between the axis of the forearm and the line to the wrist centre
};

// What all configurations of one inverse have in common.
struct InverseQuery {
    const ArmGeometry& arm;
    Forearm forearm;
    Columns flange;
    double height;  // of the wrist centre above axis 2, mm
    double free_4;  // angle 4 of the neighbour
};

void add(const ArmGeometry& arm, const std::array<double, axes_of_arm>& angles, ArmConfiguration configuration,
         ArmAnswers& answers) {
    ArmAnswer answer;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) answer.joints[axis] = joint_of(arm, angles[axis], axis);
    answer.configuration = configuration;
    answers.push_back(answer);
}

// Both wrist configurations. W = forearm^T * flange = Rz(t4) Ry(t5) Rz(t6); its last column gives t4 and t5, and the
// second row of Rz(-t4) W is sin t6, cos t6, 0.
void add_wrists(const InverseQuery& query, double t1, double t2, double t3, ArmConfiguration configuration,
                ArmAnswers& answers) {
    const Columns base{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const Columns forearm = turned_about_y(turned_about_z(base, t1), t2 + t3);
    const double w13 = dot(forearm.x, query.flange.z);
    const double w23 = dot(forearm.y, query.flange.z);
    const double w33 = dot(forearm.z, query.flange.z);
    const double sine = std::sqrt(w13 * w13 + w23 * w23);
    const bool is_singular = sine < smallest_sine;
    const double t4 = is_singular ? query.free_4 : std::atan2(w23, w13);
    const double c4 = is_singular ? std::cos(t4) : w13 / sine;
    const double s4 = is_singular ? std::sin(t4) : w23 / sine;
    const double t5 = std::atan2(c4 * w13 + s4 * w23, w33);
    const Vec3 wrist_y = c4 * forearm.y - s4 * forearm.x;
    const double t6 = std::atan2(dot(wrist_y, query.flange.x), dot(wrist_y, query.flange.y));
    add(query.arm, {t1, t2, t3, t4, t5, t6}, configuration, answers);
    configuration.is_wrist_flipped = true;
    if (is_singular)
        add(query.arm, {t1, t2, t3, t4, t5, t6}, configuration, answers);
    else
        add(query.arm, {t1, t2, t3, t4 + pi, -t5, t6 + pi}, configuration, answers);
}

// Both elbow configurations; none if the triangle of upper arm and forearm does not close. x: of the wrist centre from
// axis 2.
void add_elbows(const InverseQuery& query, double t1, double x, ArmConfiguration configuration, ArmAnswers& answers) {
    const double upper = query.arm.c2;
    const double fore = query.forearm.length;
    const double z = query.height;
    double cosine = (x * x + z * z - upper * upper - fore * fore) / (2 * upper * fore);
    if (!(std::abs(cosine) <= 1 + largest_excess)) return;
    cosine = std::clamp(cosine, -1.0, 1.0);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double at_elbow = std::atan2(sine, cosine);
    const double at_shoulder = std::atan2(fore * sine, upper + fore * cosine);
    const double to_centre = std::atan2(x, z);
    for (const int side : {1, -1}) {
        configuration.is_elbow_negative = side < 0;
        add_wrists(query, t1, to_centre - side * at_shoulder, side * at_elbow - query.forearm.bend, configuration,
                   answers);
    }
}

// The turn of a joint in min..max that is nearest to `wanted`; nothing if none lies there.
std::optional<double> nearest_turn(double joint, double min, double max, double wanted) {
    if (!(min <= max)) return std::nullopt;
    const double aim = std::clamp(wanted, min, max);
    double turned = joint + full_turn * std::nearbyint((aim - joint) / full_turn);
    if (turned > max)
        turned -= full_turn;
    else if (turned < min)
        turned += full_turn;
    if (!(turned >= min && turned <= max)) return std::nullopt;
    return turned;
}

// Whether all joints could be turned into their ranges.
bool turn_into(const JointRanges& ranges, double margin, const Joints& neighbour, Joints& joints) {
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const JointRange& range = ranges[axis];
        const std::optional<double> turned =
            nearest_turn(joints[axis], range.min + margin, range.max - margin, neighbour[axis]);
        if (!turned) return false;
        joints[axis] = *turned;
    }
    return true;
}

// Solves a * x = b for a square a; nothing if a pivot is too small.
std::optional<Joints> solved(Jacobian a, std::array<double, 6> b) {
    constexpr std::size_t n = 6;
    for (std::size_t column = 0; column < n; ++column) {
        std::size_t pivot = column;
        for (std::size_t row = column + 1; row < n; ++row) {
            if (std::abs(a[row][column]) > std::abs(a[pivot][column])) pivot = row;
        }
        if (!(std::abs(a[pivot][column]) > smallest_pivot)) return std::nullopt;
        std::swap(a[column], a[pivot]);
        std::swap(b[column], b[pivot]);
        for (std::size_t row = column + 1; row < n; ++row) {
            const double factor = a[row][column] / a[column][column];
            for (std::size_t i = column; i < n; ++i) a[row][i] -= factor * a[column][i];
            b[row] -= factor * b[column];
        }
    }
    Joints x{};
    for (std::size_t row = n; row-- > 0;) {
        double rest = b[row];
        for (std::size_t i = row + 1; i < n; ++i) rest -= a[row][i] * x[i];
        x[row] = rest / a[row][row];
    }
    return x;
}

}  // namespace

Pose forward(const ArmGeometry& arm, const Joints& joints) {
    const ArmFrames frames = frames_of(arm, joints);
    const auto& [x, y, z] = frames.flange;
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, frames.tip};
}

ArmConfiguration configuration_of(const ArmGeometry& arm, const Joints& joints) {
    const ArmFrames frames = frames_of(arm, joints);
    ArmConfiguration configuration;
    configuration.is_back = dot(frames.wrist_centre, frames.shoulder.x) < 0;
    configuration.is_elbow_negative = std::sin(angle_of(arm, joints, 2) + Forearm(arm).bend) < 0;
    configuration.is_wrist_flipped = std::sin(angle_of(arm, joints, 4)) < 0;
    return configuration;
}

ArmAnswers inverse(const ArmGeometry& arm, const Pose& flange, const Joints& neighbour) {
    ArmAnswers answers;
    if (!is_finite(flange) || !is_finite(neighbour)) return answers;
    const Columns goal = columns_of(flange);
    const Vec3 centre = flange.shift - arm.c4 * goal.z;
    const double square = centre.x * centre.x + centre.y * centre.y;
    const double radicand = square - arm.b * arm.b;
    if (!(radicand >= 0)) return answers;
    const InverseQuery query{arm, Forearm(arm), goal, centre.z - arm.c1, angle_of(arm, neighbour, 3)};
    const double reach = std::sqrt(radicand);
    const bool is_singular = square < smallest_distance * smallest_distance;
    const double aside = std::atan2(arm.b, reach);
    const double azimuth = is_singular ? angle_of(arm, neighbour, 0) + aside : std::atan2(centre.y, centre.x);
    add_elbows(query, azimuth - aside, reach - arm.a1, {.is_back = false}, answers);
    add_elbows(query, azimuth + aside - pi, -reach - arm.a1, {.is_back = true}, answers);
    return answers;
}

ArmAnswers inverse_within(const ArmGeometry& arm, const JointRanges& ranges, double margin, const Pose& flange,
                          const Joints& neighbour) {
    ArmAnswers within;
    for (ArmAnswer answer : inverse(arm, flange, neighbour)) {
        if (turn_into(ranges, margin, neighbour, answer.joints)) within.push_back(answer);
    }
    return within;
}

bool is_within(const JointRanges& ranges, double margin, const Joints& joints) {
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const JointRange& range = ranges[axis];
        if (!(joints[axis] >= range.min + margin && joints[axis] <= range.max - margin)) return false;
    }
    return true;
}

ArmSingularity singularity(const ArmGeometry& arm, const Joints& joints) {
    const ArmFrames frames = frames_of(arm, joints);
    const Vec3 from_axis_2 = frames.wrist_centre - frames.axis_2;
    const double distance = std::hypot(dot(from_axis_2, frames.shoulder.x), dot(from_axis_2, frames.shoulder.z));
    ArmSingularity nearness;
    nearness.wrist = std::abs(std::sin(angle_of(arm, joints, 4)));
    nearness.shoulder = std::abs(dot(frames.wrist_centre, frames.shoulder.x));
    nearness.elbow = std::max(0.0, 1 - distance / (arm.c2 + Forearm(arm).length));
    return nearness;
}

Jacobian jacobian(const ArmGeometry& arm, const Joints& joints) {
    const ArmFrames frames = frames_of(arm, joints);
    struct Axis {
        Vec3 direction;
        Vec3 point;
    };
    const std::array<Axis, axes_of_arm> axes{Axis{frames.shoulder.z, {}},
                                             Axis{frames.shoulder.y, frames.axis_2},
                                             Axis{frames.shoulder.y, frames.axis_3},
                                             Axis{frames.forearm.z, frames.wrist_centre},
                                             Axis{frames.wrist.y, frames.wrist_centre},
                                             Axis{frames.flange.z, frames.wrist_centre}};
    Jacobian rows{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const Vec3 angular = static_cast<double>(arm.sign[axis]) * axes[axis].direction;
        const Vec3 linear = cross(angular, frames.tip - axes[axis].point);
        for (int i = 0; i < 3; ++i) {
            rows[static_cast<std::size_t>(i)][axis] = linear[i];
            rows[static_cast<std::size_t>(i) + 3][axis] = angular[i];
        }
    }
    return rows;
}

std::optional<Joints> largest_joint_speeds(const ArmGeometry& arm, const Joints& joints) {
    if (!is_finite(joints)) return std::nullopt;
    const double scale = 1 / (arm.c2 + Forearm(arm).length);
    Jacobian rows = jacobian(arm, joints);
    for (std::size_t row = 0; row < 3; ++row) {
        for (double& value : rows[row]) value *= scale;
    }
    Joints squares{};
    for (std::size_t direction = 0; direction < 3; ++direction) {
        std::array<double, 6> velocity{};
        velocity[direction] = scale;
        const std::optional<Joints> speeds = solved(rows, velocity);
        if (!speeds) return std::nullopt;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) squares[axis] += (*speeds)[axis] * (*speeds)[axis];
    }
    for (double& square : squares) square = std::sqrt(square);
    return squares;
}

}  // namespace qchopper
