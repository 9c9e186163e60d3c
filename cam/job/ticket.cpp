// Reads and writes the template as JSON.

#include "cam/job/ticket.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/json.h"

namespace qchopper {

using namespace json_values;

namespace {

// The range of a ticket's registers: 0.01 mm in 32 bits with a sign, 0.001 mm in 32 bits without.
constexpr double farthest_mm = 21'474'836;
constexpr double widest_tool_mm = 4'294'967;

void check_lengths(const TicketTemplate& about) {
    const auto fits = [](Vec3 v) {
        return std::abs(v.x) <= farthest_mm && std::abs(v.y) <= farthest_mm && std::abs(v.z) <= farthest_mm;
    };
    if (!fits(about.box.min) || !fits(about.box.max)) throw wrong("box", "is out of range");
    if (!fits(about.stock)) throw wrong("stock", "is out of range");
}

}  // namespace

std::string to_json(const TicketTemplate& about) {
    const Json json = {{"ticket_version", 1},
                       {"piece", about.piece},
                       {"piece_no", about.piece_no},
                       {"piece_count", about.piece_count},
                       {"project_id", to_hex(about.project_id)},
                       {"box", from_box(about.box)},
                       {"stock", from_vector(about.stock)},
                       {"material", to_word(about.material)},
                       {"tool_no", about.tool_no},
                       {"tool_diameter", about.tool_diameter},
                       {"spindle_max_rpm", about.spindle_max_rpm},
                       {"feed_max_mm_per_min", about.feed_max_mm_per_min},
                       {"estimated_time_s", about.estimated_time_s},
                       {"base_plane", about.base_plane},
                       {"part", about.part},
                       {"parts", about.parts}};
    return written(json);
}

TicketTemplate ticket_template_from_json(std::string_view text, const std::string& source) {
    try {
        const Json json = parsed(text);
        if (whole<std::uint16_t>(json, "ticket_version") != 1) throw wrong("ticket_version", "is not 1");
        TicketTemplate about;
        about.piece = json_values::text(json, "piece");
        about.piece_no = whole<std::uint16_t>(json, "piece_no");
        about.piece_count = whole<std::uint16_t>(json, "piece_count");
        about.project_id = from_hex<16>(json, "project_id");
        about.box = box(json, "box");
        about.stock = vector(json, "stock");
        const std::optional<Material> material = material_of(json_values::text(json, "material"));
        if (!material) throw wrong("material", "is not one of the known materials");
        about.material = *material;
        about.tool_no = whole<std::uint16_t>(json, "tool_no");
        about.tool_diameter = real_within(json, "tool_diameter", 0, widest_tool_mm);
        about.spindle_max_rpm = whole<std::uint16_t>(json, "spindle_max_rpm");
        about.feed_max_mm_per_min = whole<std::uint32_t>(json, "feed_max_mm_per_min");
        about.estimated_time_s = whole<std::uint32_t>(json, "estimated_time_s");
        about.base_plane = whole<std::uint16_t>(json, "base_plane");
        about.part = whole<std::uint16_t>(json, "part");
        about.parts = whole<std::uint16_t>(json, "parts");
        const bool is_part = about.part >= 1 && about.part <= about.parts && about.parts > 1;
        if (!is_part && (about.part != 0 || about.parts != 0)) throw wrong("part", "is not one of 1 to parts");
        check_lengths(about);
        check_form(json, text);
        return about;
    } catch (const std::runtime_error& error) {
        throw InputError(InputFault::mesh, source + ": ticket template: " + error.what(), "write the job again");
    }
}

std::uint32_t crude_time_s(double stock_mm3, double piece_mm3, double removal_mm3_per_s) {
    return whole_seconds((stock_mm3 - piece_mm3) / removal_mm3_per_s);
}

std::uint32_t whole_seconds(double seconds) {
    const double most = std::numeric_limits<std::uint32_t>::max();
    return static_cast<std::uint32_t>(std::clamp(std::isnan(seconds) ? most : std::ceil(seconds), 1.0, most));
}

}  // namespace qchopper
