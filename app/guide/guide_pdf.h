// An assembly guide as a PDF of A4 pages, with the number of each page and the title of the guide below.
//
// Same guide, same bytes (tests/app/guide/guide_layout_test.cpp). Throws what Pdf (segment/picture/pdf.h) throws.

#pragma once

#include "app/guide/guide.h"

namespace qchopper {

Bytes guide_pdf(const AssemblyGuide& guide);

}  // namespace qchopper
