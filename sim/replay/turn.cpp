// The angle from the trace and the antisymmetric part of the rotation matrix; turning back by Rodrigues' formula.

#include "sim/replay/turn.h"

#include <cmath>

#include "cam/cell/kuka_angles.h"

namespace qchopper {

Pose pose_of(const ProgramFrame& frame) {
    return pose_of(KukaAngles{frame.abc.x, frame.abc.y, frame.abc.z}, frame.shift);
}

Pose about_z(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
}

Vec3 column(const Pose& pose, int j) {
    return {pose.row[0][j], pose.row[1][j], pose.row[2][j]};
}

Turn turn_between(const Pose& a, const Pose& b) {
    const Pose r = inverse(Pose{a.row, {}}) * Pose{b.row, {}};
    const Vec3 twice_sine{r.row[2].y - r.row[1].z, r.row[0].z - r.row[2].x, r.row[1].x - r.row[0].y};
    const double trace = r.row[0].x + r.row[1].y + r.row[2].z;
    const double angle = std::atan2(norm(twice_sine), trace - 1);
    if (norm(twice_sine) > 1e-12) return {angle, normalized(twice_sine)};
    return {angle < 1 ? 0.0 : angle, {0, 0, 1}};
}

Pose turned(const Pose& pose, const Turn& turn, double share) {
    const double c = std::cos(share * turn.angle);
    const double s = std::sin(share * turn.angle);
    const Vec3 k = turn.axis;
    const auto row = [&](Vec3 unit) {
        const Vec3 across = cross(unit, k);
        return c * unit + s * across + ((1 - c) * dot(k, unit)) * k;
    };
    const Pose rotation{{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})}, {}};
    return pose * rotation;
}

}  // namespace qchopper
