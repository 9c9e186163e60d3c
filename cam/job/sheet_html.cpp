// Text between tags; every word is escaped. O(characters).

#include "cam/job/sheet_html.h"

#include "base/text.h"
#include "segment/picture/svg.h"

namespace qchopper::sheet {
namespace {

std::string row_of(const std::vector<Entry>& entries, const std::string& tag) {
    std::string html = "<tr>";
    for (const Entry& entry : entries) {
        html += "<";
        html += tag;
        html += entry.is_number ? " class=\"n\">" : ">";
        html += entry.html;
        html += "</";
        html += tag;
        html += ">";
    }
    return html + "</tr>\n";
}

}  // namespace

Entry word(const std::string& text) {
    return {svg_text(text)};
}

Entry number(double value, int decimals) {
    return {fixed(value, decimals), true};
}

Entry right(const std::string& text) {
    return {svg_text(text), true};
}

// The first row is the head; its entries stand as those of the second.
std::string table(const Rows& rows) {
    std::string html = "<table>\n<thead>" + row_of(rows.front(), "th") + "</thead>\n<tbody>\n";
    for (std::size_t i = 1; i < rows.size(); ++i) html += row_of(rows[i], "td");
    return html + "</tbody>\n</table>\n";
}

std::string paragraph(const std::string& text) {
    return "<p>" + svg_text(text) + "</p>\n";
}

std::string section(const std::string& title, const std::string& html) {
    return "<section>\n<h2>" + svg_text(title) + "</h2>\n" + html + "</section>\n";
}

}  // namespace qchopper::sheet
