// Text and JSON from a value, by tables of fields. Lengths in mm, angles in degrees.

#include "app/report/cell/arm_report.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/report/columns.h"
#include "app/report/report_json.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"

namespace qchopper {

struct PoseRow {
    std::vector<double> joints_deg;
    Vec3 position;
    std::vector<double> abc_deg;
};

struct RobotRow {
    std::string id;
    std::string type;
    double reach_mm = 0;
    double payload_kg = 0;
    std::string notice;
    std::string source;
};

struct RobotRows {
    std::vector<RobotRow> robots;
};

struct NewCellRow {
    std::string file;
    std::string drawing;
    RobotRow robot;
    std::vector<PoseRow> poses;
};

struct DeviationRow {
    double mm = 0;
    double degrees = 0;
};

struct TaughtRow {
    bool agrees = false;
    std::vector<DeviationRow> deviations;
    std::vector<ArmFault> faults;
    std::vector<int> still_axes;
};

template <class V, Of<PoseRow> T>
void fields(V& v, T& row) {
    v("joints_deg", row.joints_deg);
    v("position", row.position);
    v("abc_deg", row.abc_deg);
}

template <class V, Of<RobotRow> T>
void fields(V& v, T& row) {
    v("robot", row.id);
    v("type", row.type);
    v("reach_mm", row.reach_mm);
    v("payload_kg", row.payload_kg);
    v("notice", row.notice);
    v("source", row.source);
}

template <class V, Of<RobotRows> T>
void fields(V& v, T& rows) {
    v.constant("schema", "qchopper-robots-1", nullptr);
    v("robots", rows.robots);
}

template <class V, Of<NewCellRow> T>
void fields(V& v, T& row) {
    v.constant("schema", "qchopper-new-cell-1", nullptr);
    v("file", row.file);
    v("drawing", row.drawing);
    v("arm", row.robot);
    v("poses", row.poses);
}

template <class V, Of<DeviationRow> T>
void fields(V& v, T& row) {
    v("mm", row.mm);
    v("degrees", row.degrees);
}

template <class V, Of<ArmFault> T>
void fields(V& v, T& fault) {
    v("parameter", fault.parameter);
    v("axes", fault.axes);
    v("sentence", fault.sentence);
}

template <class V, Of<TaughtRow> T>
void fields(V& v, T& row) {
    v("agrees", row.agrees);
    v("deviations", row.deviations);
    v("faults", row.faults);
    v("still_axes", row.still_axes);
}

namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::vector<std::string>>;

std::string in_degrees(double angle) {
    return fixed(degrees(angle), 2);
}

double rounded(double value) {
    return std::round(value * 1000) / 1000;
}

RobotRow row_of(const KnownArm& arm) {
    return {std::string(arm.id),
            std::string(arm.name),
            rounded(reach_of(arm)),
            arm.payload_kg,
            std::string(maker_of(arm).notice),
            std::string(arm.source)};
}

std::vector<PoseRow> pose_rows(const ArmGeometry& arm) {
    std::vector<PoseRow> rows;
    for (const Joints& joints : comparison_joints(arm)) {
        const Pose flange = forward(arm, joints);
        const KukaAngles abc = kuka_angles(flange);
        PoseRow row;
        for (const double joint : joints) row.joints_deg.push_back(rounded(degrees(joint)));
        row.position = {rounded(flange.shift.x), rounded(flange.shift.y), rounded(flange.shift.z)};
        row.abc_deg = {rounded(degrees(abc.a)), rounded(degrees(abc.b)), rounded(degrees(abc.c))};
        rows.push_back(row);
    }
    return rows;
}

std::string listed(const std::vector<int>& axes) {
    std::string text;
    for (const int axis : axes) text += (text.empty() ? "" : ", ") + std::to_string(axis);
    return text;
}

void add_faults(std::vector<std::string>& text, const TaughtPoseCheck& check) {
    for (const ArmFault& fault : check.faults) text.push_back("wrong        " + fault.sentence);
    if (check.faults.size() > 1) {
        text.emplace_back(
            "Each of these alone explains the poses. Teach poses in which all six axes differ, and check again.");
    }
    if (check.faults.empty()) {
        text.emplace_back(
            "No single value explains the poses. Compare them with the five of qchopper cells show, "
            "and check that no tool and no base is active in the controller.");
    }
}

}  // namespace

std::vector<std::string> lines(std::span<const KnownArm> arms) {
    Rows rows{{"arm", "type", "reach mm", "payload kg", "programs", "source"}};
    for (const KnownArm& arm : arms) {
        const MakerOfArms& maker = maker_of(arm);
        rows.push_back({std::string(arm.id), std::string(arm.name), fixed(reach_of(arm), 0),
                        significant(arm.payload_kg, 4), std::string(maker.notice.empty() ? maker.dialect : "none"),
                        std::string(arm.source)});
    }
    std::vector<std::string> text = columns(rows);
    text.emplace_back("reach: of the wrist from axis 1. A cell file: qchopper cells new --robot " +
                      std::string(arms[0].id));
    return text;
}

Document document(std::span<const KnownArm> arms) {
    RobotRows rows;
    for (const KnownArm& arm : arms) rows.robots.push_back(row_of(arm));
    return compose(json_of(rows));
}

std::vector<std::string> lines(const MadeCell& made) {
    std::vector<std::string> text{
        made.file + ": a cell of a " + std::string(made.arm.name) + ", after " + std::string(made.arm.source),
        made.drawing + ": a drawing of its lengths a1 to c4"};
    const std::string_view notice = maker_of(made.arm).notice;
    if (!notice.empty()) text.emplace_back(notice);
    for (const std::string& line : pose_lines(geometry_of(made.arm))) text.push_back(line);
    text.push_back("Next: jog the arm to these joints and compare; edit what is assumed: qchopper cells check " +
                   made.file);
    return text;
}

Document document(const MadeCell& made) {
    return compose(json_of(NewCellRow{made.file, made.drawing, row_of(made.arm), pose_rows(geometry_of(made.arm))}));
}

std::vector<std::string> pose_lines(const ArmGeometry& arm) {
    Rows rows{{"J1", "J2", "J3", "J4", "J5", "J6", "X mm", "Y mm", "Z mm", "A deg", "B deg", "C deg"}};
    for (const PoseRow& pose : pose_rows(arm)) {
        std::vector<std::string> row;
        for (const double joint : pose.joints_deg) row.push_back(fixed(joint, 2));
        for (int axis = 0; axis < 3; ++axis) row.push_back(fixed(pose.position[axis], 2));
        for (const double angle : pose.abc_deg) row.push_back(fixed(angle, 2));
        rows.push_back(row);
    }
    std::vector<std::string> text{
        "display    of the controller at these joints: the flange, without a tool, in the robot's base"};
    for (const std::string& line : columns(rows)) text.push_back(line);
    return text;
}

Json pose_json(const ArmGeometry& arm) {
    Json rows = Json::array();
    for (const PoseRow& row : pose_rows(arm)) rows.push_back(json_of(row));
    return rows;
}

std::vector<std::string> lines(const TaughtPoseCheck& check) {
    std::vector<std::string> text;
    for (std::size_t i = 0; i < check.deviations.size(); ++i) {
        text.push_back("pose " + std::to_string(i + 1) + "       the file's arm is " +
                       fixed(check.deviations[i].distance, 2) + " mm and " + in_degrees(check.deviations[i].angle) +
                       " degrees off");
    }
    if (!check.agrees) add_faults(text, check);
    if (check.agrees) text.emplace_back("The poses are those of the arm in the file.");
    if (!check.still_axes.empty()) {
        text.push_back("Axes that do not differ by 5 degrees between the poses, so that their sign is not checked: " +
                       listed(check.still_axes));
    }
    return text;
}

Json json_of(const TaughtPoseCheck& check) {
    TaughtRow row{check.agrees, {}, check.faults, check.still_axes};
    for (const PoseDeviation& d : check.deviations) row.deviations.push_back({d.distance, degrees(d.angle)});
    return json_of<TaughtRow>(row);
}

}  // namespace qchopper
