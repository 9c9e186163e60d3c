#include "tests/sim/replay/krl_writer.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "base/text.h"
#include "cam/cell/kuka_angles.h"
#include "cam/cell/reach_map.h"
#include "sim/replay/carried_load.h"

namespace qchopper {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Vec3 column(const Pose& pose, int j) {
    return {pose.row[0][j], pose.row[1][j], pose.row[2][j]};
}

std::string frame_text(const Pose& pose, int lengths, int angles) {
    const KukaAngles abc = kuka_angles(pose);
    const auto number = [](double value, int decimals) { return fixed(value, decimals); };
    return "{X " + number(pose.shift.x, lengths) + ",Y " + number(pose.shift.y, lengths) + ",Z " +
           number(pose.shift.z, lengths) + ",A " + number(abc.a * degrees, angles) + ",B " +
           number(abc.b * degrees, angles) + ",C " + number(abc.c * degrees, angles) + "}";
}

std::string axes_text(const Joints& joints, const std::optional<double>& e1) {
    std::string text = "PTP {";
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        text += "A" + std::to_string(axis + 1) + " " + fixed(joints[axis] * degrees, 3) + (axis < 5 ? "," : "");
    }
    return text + (e1 ? ",E1 " + fixed(*e1 * degrees, 3) : "") + "}\r\n";
}

class Writer {
 public:
    Writer(const Cell& cell, const WrittenJob& job) : machine_(*cell.machine), job_(job) {}
    std::vector<ProgramFile> write() const {
        std::vector<ProgramFile> files{{"qc_1.src", main_text()},
                                       {"qc_1.dat", "DEFDAT qc_1\r\n;nothing\r\nENDDAT\r\n"}};
        for (std::size_t i = 0; i < job_.chunks.size(); ++i) {
            files.push_back({name(i) + ".src",
                             head(name(i)) + operation_text(job_.chunks[i]) + chunk_text(job_.chunks[i]) + "END\r\n"});
        }
        return files;
    }

 private:
    static std::string name(std::size_t i) {
        const std::string number = std::to_string(i + 1);
        return "qc_1_" + std::string(3 - number.size(), '0') + number;
    }
    static std::string head(const std::string& name) {
        return "&ACCESS RVP\r\n&REL 1\r\n&PARAM EDITMASK = *\r\nDEF " + name + "( )\r\n";
    }
    static std::string operation_text(const WrittenChunk& chunk) {
        return chunk.operation.empty() ? "" : ";operation " + chunk.operation + "\r\n";
    }
    const CuttingTool& tool(std::uint16_t number) const {
        for (const CuttingTool& tool : machine_.tools) {
            if (tool.number == number) return tool;
        }
        throw std::runtime_error("no such tool");
    }
    std::optional<double> e1(std::size_t orientation) const {
        if (!machine_.rotary_table) return std::nullopt;
        return job_.orientations[orientation].table_angle;
    }
    std::string main_text() const;
    std::string load_text(const WrittenChunk& chunk) const;
    static std::string axis_text();
    std::string chunk_text(const WrittenChunk& chunk) const;
    Pose tip_in_setup(const WrittenChunk& chunk, Vec3 tip) const;
    Joints joints_at(const WrittenChunk& chunk) const;

    const CellMachine& machine_;
    const WrittenJob& job_;
};

std::string Writer::main_text() const {
    std::string text = head("qc_1") + ";FOLD INI\r\nBAS(#INITMOV,0)\r\n;ENDFOLD\r\n$ADVANCE = 5\r\n" + axis_text();
    std::uint16_t last = 0;
    text += load_text(job_.chunks.front()) + axes_text(machine_.start.joints, e1(0));
    for (std::size_t i = 0; i < job_.chunks.size(); ++i) {
        const WrittenChunk& chunk = job_.chunks[i];
        if (chunk.tool != last) {
            if (i > 0) text += "$OUT[1] = FALSE\r\n$OUT[2] = FALSE\r\n" + axes_text(machine_.start.joints, e1(0));
            text += ";ASK tool " + std::to_string(chunk.tool) + " (" + tool(chunk.tool).name +
                    ") is in the spindle, its length of " + fixed(gauge_length(tool(chunk.tool)), 2) +
                    " mm checked?\r\nHALT\r\n";
        }
        last = chunk.tool;
        text += name(i) + "( )\r\n";
    }
    text += axes_text(machine_.start.joints, e1(job_.chunks.back().orientation));
    return text + "$OUT[1] = FALSE\r\n$OUT[2] = FALSE\r\n$APO.CDIS = 0\r\n$ADVANCE = 3\r\nEND\r\n";
}

std::string Writer::axis_text() {
    std::string text;
    for (int axis = 1; axis <= 6; ++axis) {
        text += "$VEL_AXIS[" + std::to_string(axis) + "] = 30\r\n$ACC_AXIS[" + std::to_string(axis) + "] = 30\r\n";
    }
    return text;
}

// In the ready cells the axes of the spindle are those of the flange.
std::string Writer::load_text(const WrittenChunk& chunk) const {
    const CarriedLoad load = carried_load(machine_.spindle, tool(chunk.tool));
    return "$LOAD = {M " + fixed(load.mass_kg, 2) + ",CM " + frame_text({Pose{}.row, load.centre}, 3, 4) + ",J {X " +
           fixed(load.inertia[0].x, 4) + ",Y " + fixed(load.inertia[1].y, 4) + ",Z " + fixed(load.inertia[2].z, 4) +
           "}}\r\n";
}

// As near as possible to the orientation that the tool has at home.
Pose Writer::tip_in_setup(const WrittenChunk& chunk, Vec3 tip) const {
    const SceneOrientation& orientation = job_.orientations[chunk.orientation];
    const ToolArm arm = tool_arm(*machine_.robot, machine_.spindle, tool(chunk.tool));
    const Pose home = machine_.robot->base_in_cell * (forward(arm.geometry, machine_.start.joints) * arm.tip_in_flange);
    const Vec3 z = -orientation.tool_axis;
    const Vec3 beside = rotate_inverse(orientation.setup_in_cell, column(home, 0));
    const Vec3 x = normalized(beside - dot(beside, z) * z);
    const Vec3 y = cross(z, x);
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, tip};
}

Joints Writer::joints_at(const WrittenChunk& chunk) const {
    const ToolArm arm = tool_arm(*machine_.robot, machine_.spindle, tool(chunk.tool));
    const Pose tip = job_.orientations[chunk.orientation].setup_in_cell * tip_in_setup(chunk, chunk.moves.front().tip);
    const Pose flange = inverse(arm.base_in_cell) * (tip * inverse(arm.tip_in_flange));
    const Joints home = machine_.start.joints;
    double best = std::numeric_limits<double>::infinity();
    Joints joints{};
    for (const ArmAnswer& answer : inverse_within(arm.geometry, arm.ranges, arm.margin, flange, home)) {
        double far = 0;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) far += std::abs(answer.joints[axis] - home[axis]);
        if (far < best) best = far, joints = answer.joints;
    }
    if (std::isinf(best)) throw std::runtime_error("the arm does not hold the first point");
    return joints;
}

std::string Writer::chunk_text(const WrittenChunk& chunk) const {
    const CuttingTool& used = tool(chunk.tool);
    const SceneOrientation& orientation = job_.orientations[chunk.orientation];
    const Pose& nose = machine_.spindle.spindle_in_flange;
    const Pose tool_frame{nose.row, nose.shift + gauge_length(used) * column(nose, 2)};
    std::string text = axis_text() + load_text(chunk);
    text += "$TOOL = " + frame_text(tool_frame, 3, 4) + "\r\n";
    if (machine_.rotary_table) {
        const double angle = orientation.table_angle;
        const Pose turn{
            {Vec3{std::cos(angle), -std::sin(angle), 0}, Vec3{std::sin(angle), std::cos(angle), 0}, Vec3{0, 0, 1}}, {}};
        const Pose in_table = inverse(machine_.rotary_table->table_in_cell * turn) * orientation.setup_in_cell;
        text += "$BASE = EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE," + frame_text(in_table, 3, 4) + ")\r\n";
    } else {
        text +=
            "$BASE = " + frame_text(inverse(machine_.robot->base_in_cell) * orientation.setup_in_cell, 3, 4) + "\r\n";
    }
    text += "$APO.CDIS = " + fixed(job_.rounding, 2) + "\r\n$ACC.CP = " + fixed(job_.acceleration, 4) +
            "\r\n$VEL.ORI1 = 90.0\r\n$VEL.ORI2 = 90.0\r\n";
    text += "$ANOUT[1] = " + fixed(chunk.rpm * machine_.spindle.speed->scale, 5) + "\r\n";
    text += "$OUT[2] = TRUE\r\n$OUT[1] = TRUE\r\nWAIT FOR $IN[1]\r\n";
    double feed = 0;
    bool is_first = true;
    const auto state_feed = [&](double wanted) {
        if (wanted != feed) text += "$VEL.CP = " + fixed(wanted / 1000, 4) + "\r\n";
        feed = wanted;
    };
    state_feed(chunk.moves.front().feed);
    text += axes_text(joints_at(chunk), e1(chunk.orientation));
    for (const WrittenMove& move : chunk.moves) {
        state_feed(move.feed);
        std::string target = frame_text(tip_in_setup(chunk, move.tip), 2, 3);
        if (is_first && machine_.rotary_table)
            target.insert(target.size() - 1, ",E1 " + fixed(*e1(chunk.orientation) * degrees, 3));
        if (!is_first) target = target.substr(0, target.find(",A ")) + "}";
        text += "LIN " + target + (move.is_rounded ? " C_DIS" : "") + "\r\n";
        is_first = false;
    }
    return text;
}

}  // namespace

std::vector<ProgramFile> written(const Cell& cell, const WrittenJob& job) {
    return Writer(cell, job).write();
}

std::vector<SceneChunk> chunks_of(const WrittenJob& job) {
    std::vector<SceneChunk> chunks;
    for (std::size_t i = 0; i < job.chunks.size(); ++i) {
        const std::string number = std::to_string(i + 1);
        chunks.push_back(
            {"qc_1_" + std::string(3 - number.size(), '0') + number, job.chunks[i].tool, job.chunks[i].orientation});
    }
    return chunks;
}

Pose on_table(const Cell& cell, double height, double table_angle) {
    const double c = std::cos(table_angle);
    const double s = std::sin(table_angle);
    const Pose turn{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
    if (cell.machine->rotary_table) {
        return cell.machine->rotary_table->table_in_cell * (turn * Pose{Pose{}.row, {0, 0, height}});
    }
    return {Pose{}.row, {cell.table.centre_x, cell.table.centre_y, cell.table.height + height}};
}

}  // namespace qchopper
