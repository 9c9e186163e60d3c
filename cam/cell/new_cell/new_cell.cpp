// Writes the tables one after another, with the comments that a person needs who edits them. O(bytes of the text),
// after the search for the table's place.

#include "cam/cell/new_cell/new_cell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/cell/kuka_angles.h"
#include "cam/cell/new_cell/new_cell_tools.h"
#include "cam/cell/new_cell/straight_down_box.h"
#include "cam/cell/robot.h"

namespace qchopper {
namespace {

constexpr double light_payload = 30;  // kg; below, the arm is light

struct NewSpindle {
    double nose = 0;    // mm before the flange
    double radius = 0;  // mm
    double mass_kg = 0;
    double table_height = 0;  // least, mm
};

NewSpindle spindle_for(const KnownArm& arm) {
    return arm.payload_kg < light_payload ? NewSpindle{200, 50, 3, 200} : NewSpindle{350, 90, 15, 300};
}

std::string number(double value) {
    const std::string text = significant(value, 10);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string whole(double value) {
    return significant(value, 10);
}

template <typename Values, typename Writer>
std::string list(const Values& values, Writer writer) {
    std::string text = "[";
    for (std::size_t i = 0; i < values.size(); ++i) text += (i == 0 ? "" : ", ") + writer(values[i]);
    return text + "]";
}

std::string vector(Vec3 v) {
    return list(std::array<double, 3>{v.x, v.y, v.z}, number);
}

std::string head(const KnownArm& arm, const NewCell& cell) {
    const MakerOfArms& maker = maker_of(arm);
    std::string text = "# A " + std::string(arm.name) +
                       " with a spindle over a fixed table, made by qchopper cells new: edit it.\n"
                       "# Lengths are millimetres in the frame of the cell: z up, its origin on the floor under the "
                       "robot's first axis.\n"
                       "# docs/user/cell-file.md explains every key. What is marked \"assumed\" is known of no cell: "
                       "measure it and mark it\n# \"measured\". `qchopper cells check` lists what is left.\n";
    if (!maker.notice.empty()) text += "# " + std::string(maker.notice) + "\n";
    return text + "\nversion = 2\nname = \"" + cell.name + "\"\nid = " + std::to_string(cell.id) +
           "  # CELL_ID that the controller shows on the wire\nclearance = 20.0\nmax_tilt_deg = 60.0\n"
           "max_unreachable = 0.02\n";
}

// What the source states, and what is assumed beside it.
std::string robot_origins(const KnownArm& arm) {
    std::string text = "source = \"data sheet\"\nsources = { acceleration_deg_per_s2 = \"assumed\"";
    if (arm.are_limits_assumed) {
        text += ", min_deg = \"assumed\", max_deg = \"assumed\", speed_deg_per_s = \"assumed\"";
    }
    if (arm.is_payload_assumed) text += ", payload_kg = \"assumed\"";
    return text + " }\n";
}

std::string robot(const KnownArm& arm) {
    constexpr std::array<const char*, 7> names{"a1", "a2", "b", "c1", "c2", "c3", "c4"};
    const MakerOfArms& maker = maker_of(arm);
    std::string text =
        "\n# Lengths in the convention of Brandstoetter, Angerer and Hofbaur 2014, after " + std::string(arm.source) +
        ".\n# Compare the poses that qchopper cells show prints with the controller's display before you use it.\n"
        "[robot]\nname = \"" +
        std::string(arm.name) + "\"\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += std::string(names[i]) + " = " + number(arm.lengths[i]) + "\n";
    }
    std::array<double, axes_of_arm> acceleration{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) acceleration[axis] = arm.speed_deg_per_s[axis] / 0.5;
    return text + "offset_deg = " + list(maker.offset_deg, number) + "\nsign = " + list(maker.sign, whole) +
           "\nmin_deg = " + list(arm.min_deg, number) + "\nmax_deg = " + list(arm.max_deg, number) +
           "\nspeed_deg_per_s = " + list(arm.speed_deg_per_s, number) +
           "\nacceleration_deg_per_s2 = " + list(acceleration, number) +
           "  # full speed after 0.5 s\npayload_kg = " + number(arm.payload_kg) + "\n" + robot_origins(arm) +
           "\n[robot.base]\nposition = " + vector({0, 0, arm.base_height}) +
           "\nabc_deg = [0.0, 0.0, 0.0]\nsource = \"assumed\"\n\n# How far hoses and cables let these axes turn.\n"
           "[robot.cable]\naxis_4_deg = [-180.0, 180.0]\naxis_6_deg = [-180.0, 180.0]\nsource = \"assumed\"\n";
}

std::string capsule(int link, Vec3 from, Vec3 to, double radius) {
    return "\n[[robot.capsule]]\nlink = " + std::to_string(link) + "\nfrom = " + vector(from) + "\nto = " + vector(to) +
           "\nradius = " + number(radius) + "\nsource = \"assumed\"\n";
}

// Radii in proportion to the arm: 200, 170 and 120 mm for one of 2,150 mm from axis 2 to the wrist.
std::string capsules(const ArmGeometry& arm) {
    const double scale = (arm.c2 + arm.c3) / 2150;
    const auto radius = [scale](double of_large) { return std::min(of_large, std::round(of_large * scale)); };
    const Vec3 elbow{arm.a1, arm.b, arm.c1 + arm.c2};
    const Vec3 wrist{arm.a1 + arm.a2, arm.b, elbow.z + arm.c3};
    return "\n# The upper arm, the forearm and the wrist, as they lie with the arm straight up, in the frame of the "
           "robot's base.\n# Their radii are guessed from the size of the arm: measure the widest parts." +
           capsule(2, {arm.a1, arm.b, arm.c1}, elbow, radius(200)) +
           capsule(3, {wrist.x, wrist.y, elbow.z}, wrist, radius(170)) +
           capsule(5, wrist, wrist + Vec3{0, 0, arm.c4}, radius(120));
}

std::string spindle(const NewSpindle& s, const MakerOfArms& maker) {
    const bool has_names = maker.dialect == "rapid";
    const auto signal = [has_names](const char* name, int n, bool is_input = false) {
        const std::string target = has_names ? "\"" + std::string(name) + "\"" : std::to_string(n);
        return std::string(is_input ? "{ input = " : "{ output = ") + target;
    };
    return "\n# In line with the flange; its nose is " + whole(s.nose) +
           " mm before it.\n[spindle]\nposition = " + vector({0, 0, s.nose}) +
           "\nabc_deg = [0.0, 0.0, 0.0]\ntool_axis = \"z\"\nbody_radius = " + number(s.radius) +
           "\nbody_length = " + number(s.nose) + "\nbody_offset = 0.0\nmass_kg = " + number(s.mass_kg) +
           "\nsource = \"assumed\"\non = " + signal("spindle_on", 1) + " }\nspeed = " + signal("spindle_speed", 1) +
           ", scale = 0.0000555556 }  # an analogue output, 1 at 18,000 revolutions/min\n" +
           "at_speed = " + signal("spindle_at_speed", 1, true) + " }\noff = " + signal("spindle_on", 1) +
           " }\n\n[extraction]\non = " + signal("extraction", 2) + " }\noff = " + signal("extraction", 2) + " }\n";
}

std::string places(const Box& box) {
    const Vec3 size = box.size();
    return "\n# The box in which the tool tip may work. With a tool of " + whole(new_tool_length) +
           " mm, pointing straight down, the arm reaches the\n# 5 x 5 x 5 points of a grid in it with 3 degrees to "
           "spare at every joint limit.\n[reach]\nmin = " +
           vector(box.min) + "\nmax = " + vector(box.max) +
           "\nsource = \"assumed\"\n\n# A block stands with its underside on the table and its middle over the table's "
           "middle.\n[table]\ncentre = " +
           list(std::array<double, 2>{box.centre().x, box.centre().y}, number) +
           "\nsize = " + list(std::array<double, 2>{size.x, size.y}, number) + "\nheight = " + number(box.min.z) +
           "\nsource = \"assumed\"\n";
}

std::string start(const ArmGeometry& arm) {
    Joints in_degrees = straight_down_joints(arm);
    for (double& joint : in_degrees) joint = std::round(degrees(joint) * 1000) / 1000;
    return "\n[start]\njoints_deg = " + list(in_degrees, number) + "\n";
}

std::string program(const MakerOfArms& maker) {
    return "\n[program]\ndialect = \"" + std::string(maker.dialect) +
           "\"\nmemory_bytes = 3000000\nlines_per_chunk = " + (maker.dialect == "krl" ? "1400" : "5000") +
           "\nlink_feed = 300.0  # mm/s, of moves that remove no foam\ntool_change = \"stop\"\nsource = \"assumed\"\n"
           "\n# Foam around the piece, and the layer under it that stays on the table.\n[margin]\nsides = 5.0\n"
           "top = 3.0\nspoil = 10.0\n\n# What holds the block on the table, and against what (docs/user/setup.md).\n"
           "[holding]\ncutting_force = 20.0   # N\nstrength = 0.1         # N/mm2, of double-sided tape\n"
           "max_slenderness = 4.0  # height of a piece over the smallest width of its base\nsource = \"assumed\"\n";
}

}  // namespace

std::string new_cell_text(const KnownArm& arm, const NewCell& cell) {
    const ArmGeometry geometry = geometry_of(arm);
    const NewSpindle s = spindle_for(arm);
    StraightDownQuestion question{geometry, ranges_of(arm), {}, s.nose + new_tool_length, s.table_height};
    question.base_in_cell.shift = {0, 0, arm.base_height};
    question.ranges =
        ranges_with_cable(question.ranges, CableLimits{{-radians(180), radians(180)}, {-radians(180), radians(180)}});
    const std::optional<Box> box = straight_down_box(question);
    if (!box) {
        throw InputError(InputFault::use,
                         std::string(arm.name) + " with a tool of " + whole(question.tool_length) +
                             " mm before its flange reaches no box of 200 x 200 mm straight down",
                         "choose a larger arm: qchopper cells robots");
    }
    const bool is_light = arm.payload_kg < light_payload;
    return head(arm, cell) + robot(arm) + capsules(geometry) + spindle(s, maker_of(arm)) + places(*box) +
           start(geometry) + program(maker_of(arm)) + new_tools_text(is_light) + new_stock_text(box->size()) +
           "\n# Where the controller listens and where it looks for job files.\n"
           "[link]\nto = \"127.0.0.1:15020\"\ndrop = \"drop\"\n";
}

}  // namespace qchopper
