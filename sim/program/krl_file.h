// A .src or .dat file cut into lines, with what does not depend on its meaning checked.
//
// O(bytes) (tests/sim/program/krl_reader_test.cpp).

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/program/parsed_program.h"

namespace qchopper {

struct KrlFile {
    const std::string* name = nullptr;    // with ending, as given
    std::string stem;                     // in lower case, without ending
    bool is_source = false;               // .src; else .dat
    std::vector<std::string_view> lines;  // without their ends
    std::size_t first = 0;                // line after DEF or DEFDAT, counted from 0
    std::size_t end = 0;                  // the line with END or ENDDAT, counted from 0
};

// Refused, with the line: a name that is not a letter, then letters, digits and _, at most 24 characters, then .src or
// .dat; a character outside of 32..126; a line that does not end with CR LF; a head other than &ACCESS RVP, &REL and
// &PARAM lines (of a .dat it may be missing); a DEF or DEFDAT with another name; no END or ENDDAT, or anything behind
// it. The file must outlive the result.
KrlFile read_krl_file(const ProgramFile& file);

// Letters A-Z made small.
std::string lower_case(std::string_view text);

// Whether a line says nothing: it is empty or a comment.
bool is_krl_comment(std::string_view line);

}  // namespace qchopper
