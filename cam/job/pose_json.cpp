// Three rows and a shift. O(1).

#include "cam/job/pose_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/json.h"

namespace qchopper {

using namespace json_values;

Json from_pose(const Pose& pose) {
    Json rows = Json::array();
    for (const Vec3& row : pose.row) rows.push_back(from_vector(row));
    return {{"rows", rows}, {"shift", from_vector(pose.shift)}};
}

Pose to_pose(const Json& json, const std::string& key) {
    const Json& rows = member(json, "rows");
    if (!rows.is_array() || rows.size() != 3) throw wrong("rows", "is not three rows");
    Pose pose;
    for (std::size_t i = 0; i < 3; ++i) pose.row[i] = to_vector(rows[i], "rows");
    pose.shift = vector(json, "shift");
    // A mirror image would pass all other checks and be milled.
    const double turn = dot(pose.row[0], cross(pose.row[1], pose.row[2]));
    if (!(std::abs(turn - 1) < 1e-6)) throw wrong(key, "is not a rotation");
    return pose;
}

}  // namespace qchopper
