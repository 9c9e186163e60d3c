// All bodies are moved into setup coordinates, in which the piece lies already. Drawn without ambient light, as the
// pictures of setup_picture.cpp. O(triangles + samples).

#include "cam/job/sheet/envelope_picture.h"

#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "cam/cell/machine_bodies.h"
#include "cam/cell/reach_map.h"
#include "cam/job/sheet/solid_shapes.h"
#include "cam/setup/block_placement.h"
#include "segment/picture/colour.h"
#include "segment/picture/picture.h"

namespace qchopper {
namespace {

constexpr Rgb link_colour{225, 140, 40};
constexpr Rgb axis_colour{120, 125, 135};  // spindle and holder
constexpr Rgb tool_colour{60, 65, 75};
constexpr Rgb block_colour{105, 110, 120};
constexpr Rgb table_colour{185, 190, 195};
constexpr Rgb obstacle_colour{150, 165, 190};
constexpr Rgb tight_colour{200, 45, 20};  // of the bodies that the margin lies between

struct Body {
    std::string name;  // as describe_pair() names it
    Rgb colour;
    TriangleMesh mesh;
};

// The tool whose tip is at the pose with these joints; of others that with the largest stick-out.
const CuttingTool& tool_of(const CellMachine& machine, const ReachabilityPose& pose) {
    const CuttingTool* longest = &machine.tools.front();
    for (const CuttingTool& tool : machine.tools) {
        if (!is_drill(tool) && tool.stick_out > longest->stick_out) longest = &tool;
    }
    if (!machine.robot || !pose.joints || pose.kind != PoseKind::tool_change) return *longest;
    for (const CuttingTool& tool : machine.tools) {
        const ToolArm arm = tool_arm(*machine.robot, machine.spindle, tool);
        const Pose tip = arm.base_in_cell * (forward(arm.geometry, *pose.joints) * arm.tip_in_flange);
        if (norm(tip.shift - pose.tip_in_cell) < 1e-3) return tool;
    }
    return *longest;
}

const char* name_of(BodyPart part) {
    constexpr const char* names[] = {"link", "spindle", "holder", "tool"};
    return names[static_cast<std::size_t>(part)];
}

Rgb colour_of(BodyPart part) {
    return part == BodyPart::tool ? tool_colour : axis_colour;
}

void add_moving(const Cell& cell, const ReachabilityPose& pose, std::vector<Body>& bodies) {
    if (cell.machine->robot && !pose.joints) return;  // not reached
    const CuttingTool& tool = tool_of(*cell.machine, pose);
    const MovingBodies moving = bodies_at(cell, tool, pose.joints.value_or(Joints{}), pose.tip_in_cell);
    for (const LinkCapsule& link : moving.links) {
        bodies.push_back({"link " + std::to_string(link.link), link_colour, capsule_mesh(link.shape)});
    }
    for (const AxisBody& body : moving.on_axis) {
        bodies.push_back({name_of(body.part), colour_of(body.part), cylinder_mesh(body.shape)});
    }
}

void add_standing(const Cell& cell, std::vector<Body>& bodies) {
    StandingBodies standing = standing_bodies(cell);
    if (standing.table) bodies.push_back({"table", table_colour, box_mesh(*standing.table)});
    if (standing.rotary) bodies.push_back({"table", table_colour, cylinder_mesh(*standing.rotary)});
    for (std::size_t i = 0; i < standing.obstacles.size(); ++i) {
        bodies.push_back({cell.machine->obstacles[i].name, obstacle_colour, box_mesh(standing.obstacles[i])});
    }
}

// Whether a pair names the body: "link 3 and the block" names link 3 and the block.
bool names(const std::string& pair, const std::string& body) {
    const std::size_t at = pair.find(body);
    if (at == std::string::npos) return false;
    const bool begins = at == 0 || pair[at - 1] == ' ';
    const std::size_t end = at + body.size();
    return begins && (end == pair.size() || pair[end] == ' ');
}

TriangleMesh bars_of(const Setup& setup) {
    TriangleMesh bars;
    for (const Box& edge : edges_of(setup.block_box())) add_bar(bars, edge, 0.003 * norm(setup.block.size));
    return bars;
}

// Across the vertical plane of the arm and a little from above, so that the arm is seen from its side.
Vec3 view_of(const Cell& cell, const ReachabilityPose& pose, const Pose& setup_in_cell) {
    Vec3 along{1, 0, 0};
    if (cell.machine->robot) along = setup_in_cell.shift - cell.machine->robot->base_in_cell.shift;
    along.z = 0;
    if (norm(along) < 1) along = {1, 0, 0};
    along = normalized(along);
    const Vec3 across{-along.y, along.x, 0};
    const double side = dot(pose.tool_axis_in_cell, across) < 0 ? -1 : 1;  // the side to which the tool leans is behind
    return rotate_inverse(setup_in_cell, side * across + 0.35 * along - Vec3{0, 0, 0.45});
}

std::vector<Body> bodies_of(const JobInput& input, const ReachabilityMargin& margin, const Pose& in_cell) {
    std::vector<Body> bodies;
    add_moving(input.cell, margin.pose, bodies);
    add_standing(input.cell, bodies);
    const Pose cell_in_setup = inverse(in_cell);
    for (Body& body : bodies) {
        for (Vec3& p : body.mesh.points) p = apply(cell_in_setup, p);
    }
    bodies.push_back({"block", block_colour, bars_of(input.setup)});
    return bodies;
}

}  // namespace

Bytes envelope_picture(const JobInput& input, const TriangleMesh& lying) {
    assert(input.machine_reachability.is_arm_checked && input.cell.machine);
    const ReachabilityMargin& margin = input.machine_reachability.tightest();
    const bool has_direction = margin.pose.kind != PoseKind::home && margin.pose.kind != PoseKind::tool_change;
    const Pose in_cell = setup_in_cell(input.cell, input.setup.spoil, input.setup.placement,
                                       has_direction ? margin.pose.orientation : 0);
    const std::vector<Body> bodies = bodies_of(input, margin, in_cell);
    std::vector<ColouredMesh> meshes{{&lying, bone_colour, {}}};
    for (const Body& body : bodies) {
        meshes.push_back({&body.mesh, names(margin.pair, body.name) ? tight_colour : body.colour, {}});
    }
    const Scene scene(meshes, false);
    PictureOptions options;
    options.width = envelope_picture_width;
    options.height = envelope_picture_height;
    options.background = {255, 255, 255};
    options.ambient_rays = 0;
    options.outline = 1;
    options.frame = 0.03;
    options.view = view_of(input.cell, margin.pose, in_cell);
    return render_png(scene, options);
}

}  // namespace qchopper
