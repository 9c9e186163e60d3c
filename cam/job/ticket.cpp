// One table, for writing and reading the template as JSON, and for its schema.

#include "cam/job/ticket.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/json_fields.h"
#include "base/json_schema.h"
#include "cam/job/document_schemas.h"

namespace qchopper {
namespace {

using namespace json_values;

// The range of a ticket's registers: 0.01 mm in 32 bits with a sign, 0.001 mm in 32 bits without.
constexpr double farthest_mm = 21'474'836;
constexpr double widest_tool_mm = 4'294'967;

bool are_lengths(Vec3 v) {
    return std::abs(v.x) <= farthest_mm && std::abs(v.y) <= farthest_mm && std::abs(v.z) <= farthest_mm;
}

}  // namespace

template <class V, Of<TicketTemplate> T>
void fields(V& v, T& about) {
    v.version("ticket_version", 1);
    v("piece", about.piece);
    v("piece_no", about.piece_no);
    v("piece_count", about.piece_count);
    v("project_id", about.project_id);
    v("box", about.box);
    v.check(are_lengths(about.box.min) && are_lengths(about.box.max), "box", "is out of range");
    v("stock", about.stock);
    v.check(are_lengths(about.stock), "stock", "is out of range");
    v("material", about.material);
    v("tool_no", about.tool_no);
    v("tool_diameter", about.tool_diameter, not_negative);
    v.check(about.tool_diameter <= widest_tool_mm, "tool_diameter", "is out of range");
    v("spindle_max_rpm", about.spindle_max_rpm);
    v("feed_max_mm_per_min", about.feed_max_mm_per_min);
    v("estimated_time_s", about.estimated_time_s);
    v("base_plane", about.base_plane);
    v("part", about.part);
    v("parts", about.parts);
    const bool is_part = about.part >= 1 && about.part <= about.parts && about.parts > 1;
    v.check(is_part || (about.part == 0 && about.parts == 0), "part", "is not one of 1 to parts");
}

std::string to_json(const TicketTemplate& about) {
    return to_document(about);
}

std::string ticket_schema() {
    return schema_of_document<TicketTemplate>("ticket template of qchopper");
}

void put_schema(Json& at, Material /*like*/) {
    for (auto word = std::uint16_t{0}; word <= static_cast<std::uint16_t>(Material::other); ++word) {
        add_word(at, to_word(Material{word}).c_str());
    }
}

TicketTemplate ticket_template_from_json(std::string_view text, const std::string& source) {
    try {
        TicketTemplate about;
        from_document(text, about);
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
