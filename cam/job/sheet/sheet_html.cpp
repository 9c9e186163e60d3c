// Text between tags; every word is escaped. O(characters).

#include "cam/job/sheet/sheet_html.h"

#include <cmath>

#include "base/text.h"
#include "segment/picture/svg.h"

namespace qchopper::sheet {
namespace {

constexpr const char* style = R"(
  body { font: 10pt/1.3 sans-serif; color: #111; max-width: 190mm; margin: 6mm auto; padding: 0 4mm; }
  h1 { font-size: 15pt; margin: 0 0 1mm; }
  h2 { font-size: 11pt; margin: 4mm 0 1mm; border-bottom: 0.3mm solid #999; break-after: avoid; }
  p { margin: 0.7mm 0; }
  ul { margin: 0.7mm 0; padding-left: 6mm; }
  table { border-collapse: collapse; margin: 1mm 0; break-inside: avoid; }
  th, td { text-align: left; vertical-align: top; padding: 0.3mm 3mm 0.3mm 0; border-bottom: 0.1mm solid #ccc; }
  th { font-weight: 600; }
  .n { text-align: right; font-variant-numeric: tabular-nums; }
  .stop { border: 0.8mm solid #a00; padding: 1mm 2mm; margin: 1.5mm 0; font-weight: 700; }
  .key { display: inline-block; width: 4mm; height: 3mm; border: 0.2mm solid #333; }
  img { max-width: 100%; height: auto; }
  figure { margin: 1mm 0; break-inside: avoid; }
  .sides { display: flex; gap: 2%; justify-content: center; break-inside: avoid; }
  .sides figure { width: 48%; }
  figcaption, footer { font-size: 8.5pt; color: #444; }
  footer { margin-top: 2mm; overflow-wrap: anywhere; }
  @page { size: A4; margin: 10mm; }
  @media print {
    body { max-width: none; margin: 0; padding: 0; font-size: 8pt; line-height: 1.2; }
    h1 { font-size: 13pt; }
    h2 { font-size: 9pt; margin: 1.5mm 0 0.5mm; }
    p, ul { margin: 0.4mm 0; }
    th, td { padding: 0.2mm 2mm 0.1mm 0; }
    .sides { display: block; float: right; width: 31%; margin-left: 3mm; }
    .sides figure { width: 100%; margin: 0 0 1mm; }
    figcaption, footer { font-size: 7.5pt; }
    .key { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
    section { break-inside: avoid; display: flow-root; }
    .sheet + .sheet { break-before: page; }
  }
)";

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

Entry key(const std::string& colour, const std::string& name) {
    return {"<span class=\"key\" style=\"background:" + colour + "\"></span> " + svg_text(name)};
}

std::string size_text(Vec3 size) {
    const auto length = [](double mm) { return significant(std::round(10 * mm) / 10, 8); };
    return length(size.x) + " x " + length(size.y) + " x " + length(size.z);
}

std::string size_text(Vec3 size, const FlushFaces& flush) {
    const auto length = [&](int axis, bool is_flush) {
        return is_flush ? fixed(size[axis], 1) : significant(std::round(10 * size[axis]) / 10, 8);
    };
    return length(0, flush[0] || flush[1]) + " x " + length(1, flush[2] || flush[3]) + " x " + length(2, flush[4]);
}

std::string percent(double share, int decimals) {
    return fixed(100 * share, decimals) + " %";
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

std::string stop(const std::string& text) {
    return "<p class=\"stop\">" + svg_text(text) + "</p>\n";
}

std::string figure(const SheetPicture& picture, const std::string& caption) {
    return "<figure><img src=\"" + picture.file + "\" width=\"" + std::to_string(picture.width) + "\" height=\"" +
           std::to_string(picture.height) + "\" alt=\"" + svg_text(caption) + "\"><figcaption>" + svg_text(caption) +
           "</figcaption></figure>\n";
}

std::string document(const std::string& title, const std::string& body) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" + svg_text(title) +
           "</title>\n<style>" + style + "</style>\n</head>\n<body>\n" + body + "</body>\n</html>\n";
}

std::string clipped(const std::string& text, std::size_t most) {
    if (text.size() <= most) return text;
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // inside of a character
    return text.substr(0, end) + "...";
}

}  // namespace qchopper::sheet
