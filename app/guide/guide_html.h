// An assembly guide as one HTML document with its pictures inside, in the style of the setup sheets: a section a page
// in print.
//
// Every text is escaped, and nothing comes from elsewhere (tests/app/guide/guide_layout_test.cpp).

#pragma once

#include <string>

#include "app/guide/guide.h"

namespace qchopper {

std::string guide_html(const AssemblyGuide& guide);

}  // namespace qchopper
