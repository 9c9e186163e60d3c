// The parts of which the setup sheet is made: tables, paragraphs and sections of HTML.
//
// Every text is escaped (tests/cam/job/setup_sheet_test.cpp).

#pragma once

#include <string>
#include <vector>

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

// The first row is the head; its entries stand as those of the second. Precondition: there is a row.
std::string table(const Rows& rows);
std::string paragraph(const std::string& text);
std::string section(const std::string& title, const std::string& html);

}  // namespace qchopper::sheet
