// A table of the five faces that stand free, and sentences.

#include "cam/job/sheet/glue_section.h"

#include <vector>

#include "base/text.h"
#include "cam/job/glue_faces.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

std::vector<JobCap> caps_of(const JobInput& input) {
    std::vector<JobCap> caps;
    for (const DrawnCap& drawn : input.caps) caps.push_back(drawn.cap);
    return caps;
}

std::vector<GlueFace> faces_of(const JobInput& input) {
    return glue_faces(input.setup, caps_of(input));
}

std::string name_of(BlockFace face) {
    return names_of(face)(face);
}

std::string table_of_faces(const JobInput& input) {
    const std::vector<double> foam = foam_around(input.setup);
    const std::vector<GlueFace> faces = faces_of(input);
    Rows rows{{word("face"), right("foam"), word("glued to"), right("cm2")}};
    for (std::size_t f = 0; f < block_faces; ++f) {
        const auto face = static_cast<BlockFace>(f);
        rows.push_back({word(name_of(face)), number(foam[f], 1), word("-"), right("-")});
        for (const GlueFace& glued : faces) {
            if (glued.face != face) continue;
            rows.back() = {word(name_of(face)), number(0, 1),
                           key(svg_colour(glue_colour(face)), list_of_pieces(glued.neighbours)),
                           number(glued.area_mm2 / 100, 1)};
        }
    }
    const std::vector<std::string> below = neighbours_at_base(input.setup, caps_of(input));
    rows.push_back({word("under"), number(input.setup.spoil, 1),
                    word(below.empty() ? "-" : "when it is parted: " + list_of_pieces(below)),
                    below.empty() ? right("-") : number(input.setup.base_mm2 / 100, 1)});
    return table(rows);
}

std::string drilled_before(const JobInput& input) {
    std::string text;
    for (const DrawnCap& drawn : input.caps) {
        if (!is_drilled_before(input.setup, drawn.cap)) continue;
        std::string numbers;
        for (const JobHole& hole : holes_of({drawn.cap}))
            numbers += (numbers.empty() ? "" : ", ") + std::to_string(hole.number);
        if (numbers.empty()) continue;
        text += (text.empty() ? "" : "; ") + numbers + " by " + template_name(drawn.cap.cut, "pdf");
    }
    if (text.empty()) return {};
    return paragraph("Drill by hand now, before the block is placed and carved: holes " + text +
                     ". The outer line of a template is the edge of the block.");
}

}  // namespace

bool is_drilled_before(const Setup& setup, const JobCap& cap) {
    for (const FlushCap& flush : setup.flush_caps) {
        if (flush.cut == cap.cut && flush.face != BlockFace::top) return true;
    }
    return false;
}

std::string glue_face_section(const JobInput& input) {
    if (input.setup.flush_caps.empty()) return {};
    return table_of_faces(input) +
           paragraph(
               "Faces that are glued to a piece are glue faces: saw them last, square to the underside and to each "
               "other, where the saw list says (saw-list.html). One that is more than " +
               significant(input.cell.saw.accuracy, 3) + " mm off is sawn again; a glue face is never milled.") +
           drilled_before(input);
}

std::string glue_keys(const JobInput& input) {
    std::string html;
    for (const GlueFace& face : faces_of(input)) {
        html += (html.empty() ? "" : ", ") +
                key(svg_colour(glue_colour(face.face)),
                    "glue face " + name_of(face.face) + " towards " + list_of_pieces(face.neighbours))
                    .html;
    }
    return html;
}

}  // namespace qchopper
