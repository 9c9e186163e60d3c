// Two sentences, and a table of what holds. What its formulas mean has room in the details only.

#include "cam/job/sheet/holding_section.h"

#include "base/text.h"
#include "cam/job/sheet/sheet_html.h"

namespace qchopper {

using namespace sheet;

namespace {

std::string workholding_text(const Workholding& check) {
    const Holding& holding = check.holding;
    Rows rows{{word("what holds"), word("parts or breaks at"), right("N"), right("cutting force, N"), word("holds")}};
    rows.push_back({word("tape or glue of " + significant(holding.strength, 3) + " N/mm2"),
                    word("F = s k^3 W / (h + t)"), number(check.joint_force, 1), number(holding.cutting_force, 1),
                    word(check.joint_holds() ? "yes" : "NO")});
    rows.push_back({word("foam of " + significant(check.foam_strength, 3) + " N/mm2, " +
                         fixed(check.narrowest_mm2 / 100, 1) + " cm2 at z = " + fixed(check.narrowest_z, 1)),
                    word("F = b W(z) / (h - z)"), number(check.foam_force, 1), number(holding.cutting_force, 1),
                    word(check.foam_holds() ? "yes" : "NO")});
    std::string html = table(rows);
    html += paragraph("Slenderness: " + fixed(check.height, 1) + " mm high on a base of " +
                      fixed(check.base_mm2 / 100, 1) + " cm2 that is " + fixed(check.base_width, 1) +
                      " mm wide at least; at most " + significant(holding.max_slenderness, 3) +
                      " times as high as wide: " + (check.is_stout() ? "yes" : "NO") +
                      ". details.html explains the formulas.");
    if (!check.passes()) html += paragraph("To do: " + workholding_remedy(check) + ".");
    return html;
}

}  // namespace

std::string holding_section(const Setup& setup) {
    std::string html;
    if (setup.spoil > 0) {
        html += paragraph(
            "Glue or clamp the underside of the spoil layer, which is the underside of the block, to the "
            "table. Clamps must stay within the lowest " +
            fixed(setup.spoil, 1) + " mm: above that the tool works.");
    } else {
        html += paragraph(
            "There is no spoil layer. Glue the base of the piece, which is the underside of the block, to "
            "the table: the tool works down to the table, so no clamp may hold the sides.");
    }
    if (setup.workholding) html += workholding_text(*setup.workholding);
    return section("3. Holding", html);
}

std::string formula_section(const Setup& setup) {
    constexpr const char* title = "Formulas of the holding";
    if (!setup.workholding) return section(title, paragraph("Not checked: the cell file tells no strengths."));
    const Workholding& check = *setup.workholding;
    return section(
        title,
        paragraph("The force acts sideways at the top. h = " + fixed(check.height, 1) +
                  " mm: height of the piece over its base; t = " + fixed(setup.spoil, 1) +
                  " mm: spoil layer; s, b: the strengths.") +
            paragraph("W: section modulus in the weakest direction, of the base or of the section at z, the weakest of "
                      "the lowest third; 1 / W is the largest |J^-1 p| of its points p from its centroid, J its second "
                      "moments. k = 1 + t / r, r the farthest point of the base from its centroid. Where the whole "
                      "block on its underside holds less, that counts."));
}

}  // namespace qchopper
