// One row per tool and block. O(rows).

#include "cam/cell/new_cell/new_cell_tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/text.h"

namespace qchopper {
namespace {

struct NewTool {
    std::string_view name;
    std::string_view shape;
    double diameter = 0;
    double flute = 0;
    double stick_out = 0;
    std::string_view holder;
    std::string_view feed;
    std::string_view rpm;
    double mass_kg = 0;
    double removal = 0;  // mm3/s
    bool is_for_light_arms = true;
};

constexpr auto tools = std::to_array<NewTool>(
    {{"ball nose 20 mm", "ball", 20, 100, 150, "[[40.0, 50.0]]", "[20.0, 150.0]", "[6000, 18000]", 1.2, 24000},
     {"flat end 20 mm", "flat", 20, 100, 150, "[[40.0, 50.0]]", "[20.0, 150.0]", "[6000, 18000]", 1.2, 24000},
     {"ball nose 12 mm", "ball", 12, 80, 150, "[[32.0, 50.0]]", "[20.0, 120.0]", "[10000, 18000]", 1.0, 8000},
     {"ball nose 6 mm", "ball", 6, 50, 100, "[[20.0, 50.0], [32.0, 50.0]]", "[10.0, 60.0]", "[12000, 18000]", 0.9,
      1500},
     {"drill 8 mm", "drill", 8, 80, 120, "[[20.0, 30.0], [32.0, 50.0]]", "[5.0, 20.0]", "[3000, 9000]", 0.8, 400},
     {"drill 6 mm", "drill", 6, 70, 120, "[[20.0, 30.0], [32.0, 50.0]]", "[5.0, 20.0]", "[3000, 9000]", 0.8, 400},
     {"drill 4 mm", "drill", 4, 60, 120, "[[20.0, 30.0], [32.0, 50.0]]", "[5.0, 20.0]", "[3000, 9000]", 0.8, 400},
     {"flat end 40 mm", "flat", 40, 100, 150, "[[50.0, 50.0]]", "[20.0, 150.0]", "[6000, 18000]", 1.8, 48000, false},
     {"ball nose 20 mm, long", "ball", 20, 100, 300, "[[40.0, 50.0]]", "[20.0, 150.0]", "[6000, 18000]", 1.6, 24000,
      false},
     {"flat end 40 mm, long", "flat", 40, 100, 300, "[[50.0, 50.0]]", "[20.0, 150.0]", "[6000, 18000]", 3.3, 48000,
      false}});

struct NewStock {
    std::string_view name;
    Vec3 size;  // mm
};

constexpr auto blocks =
    std::to_array<NewStock>({{"small", {300, 300, 200}}, {"medium", {600, 400, 400}}, {"large", {1000, 600, 500}}});
constexpr double around = 100;  // mm of the box beside a block, both sides together: margins and the widest tool
constexpr double above = 60;    // mm of the box over a block: clearance and approach

std::string number(double value) {
    return fixed(value, 1);
}

std::string tool_text(const NewTool& tool, std::size_t tool_number) {
    std::string text = "\n[[tool]]\nnumber = " + std::to_string(tool_number) + "\nname = \"" + std::string(tool.name) +
                       "\"\nshape = \"" + std::string(tool.shape) + "\"\ndiameter = " + number(tool.diameter) + "\n";
    if (tool.shape == "drill") text += "tip_angle_deg = 118.0\n";
    return text + "flute_length = " + number(tool.flute) + "\nstick_out = " + number(tool.stick_out) +
           "\nholder = " + std::string(tool.holder) + "\nfeed_mm_per_s = " + std::string(tool.feed) +
           "\nrpm = " + std::string(tool.rpm) + "\nmass_kg = " + number(tool.mass_kg) +
           "\nremoval_mm3_per_s = " + number(tool.removal) + "\nlength_measured = false\nsource = \"assumed\"\n";
}

std::string block_text(const NewStock& block) {
    return "\n[[stock]]\nname = \"" + std::string(block.name) + "\"\nsize = [" + number(block.size.x) + ", " +
           number(block.size.y) + ", " + number(block.size.z) +
           "]\nmaterial = \"pu_foam\"\nbending_strength = 0.6  # N/mm2, of foam of 80 kg/m3\nsource = \"assumed\"\n";
}

bool holds(Vec3 box, Vec3 block) {
    return block.x + around <= box.x && block.y + around <= box.y && block.z + above <= box.z;
}

// The largest block of whole 10 mm, square, that the box holds.
NewStock largest_block(Vec3 box) {
    const auto tens = [](double length) { return 10 * std::floor(length / 10); };
    const double side = std::max(50.0, tens(std::min(box.x, box.y) - around));
    return {"small", {side, side, std::max(50.0, tens(box.z - above))}};
}

}  // namespace

std::string new_tools_text(bool is_light) {
    std::string text =
        "\n# Enter your tools. The first one is that of jobs without a program. Measure every length from the tip to "
        "the holder, then\n# set length_measured. A holder is [diameter, length] from the tool to the spindle nose.";
    std::size_t tool_number = 0;
    for (const NewTool& tool : tools) {
        ++tool_number;
        if (!is_light || tool.is_for_light_arms) text += tool_text(tool, tool_number);
    }
    return text;
}

std::string new_stock_text(Vec3 box) {
    std::string text = "\n# Enter the blocks that you keep, as they stand: the last number is the height.";
    bool has_one = false;
    for (const NewStock& block : blocks) {
        if (!holds(box, block.size)) continue;
        text += block_text(block);
        has_one = true;
    }
    return has_one ? text : text + block_text(largest_block(box));
}

}  // namespace qchopper
