// The parts of which the setup sheet and its details are made: tables, paragraphs, figures and sections of HTML.
//
// Every text is escaped, and nothing comes from elsewhere (tests/cam/job/sheet/setup_sheet_test.cpp).

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "cam/setup/block.h"

namespace qchopper::sheet {

// What stands in a cell of a table. `html` is taken as it is.
struct Entry {
    std::string html;
    bool is_number = false;  // it stands on the right
};

using Rows = std::vector<std::vector<Entry>>;

Entry word(const std::string& text);
Entry number(double value, int decimals);
Entry right(const std::string& text);

// A name behind a patch of its colour, "#5590e2".
Entry key(const std::string& colour, const std::string& name);

// "100 x 60.5 x 50": to tenths of a mm.
std::string size_text(Vec3 size);
// The size of a block: "100.0 x 60 x 50.0", tenths along axes with a glue face.
std::string size_text(Vec3 size, const FlushFaces& flush);
std::string percent(double share, int decimals = 2);

// The first row is the head; its entries stand as those of the second. Precondition: there is a row.
std::string table(const Rows& rows);
std::string paragraph(const std::string& text);
std::string section(const std::string& title, const std::string& html);
// A box that nobody overlooks.
std::string stop(const std::string& text);

// A picture of so many pixels in the same folder, with its caption. It is never stretched, however wide it is drawn.
struct SheetPicture {
    std::string file;
    int width = 0;
    int height = 0;
};
std::string figure(const SheetPicture& picture, const std::string& caption);

// Around what stands on a page, so that it can be taken out of its document again.
constexpr const char* page_begin = "<article class=\"sheet\">\n";
constexpr const char* page_end = "</article>\n";

// A whole document with the style of all sheets: A4, in print one page after the other for each `page_begin`.
std::string document(const std::string& title, const std::string& body);

// Shortened to so many bytes, with "..." where something is left out; characters stay whole.
std::string clipped(const std::string& text, std::size_t most);

}  // namespace qchopper::sheet
