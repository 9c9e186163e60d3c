// An assembly guide as a value: pages of paragraphs, tables and pictures, which guide_html.h and guide_pdf.h lay out.

#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "base/files/file.h"

namespace qchopper {

struct GuideText {
    std::string text;
    bool is_warning = false;  // nobody may overlook it
};

// The first row is the head. Precondition: all rows are as long as it.
struct GuideTable {
    std::vector<std::vector<std::string>> rows;
    std::vector<bool> is_number;  // per column: it stands on the right
};

struct GuidePicture {
    Bytes png;
    int width = 0;  // pixels
    int height = 0;
    std::string caption;
};

// Side by side.
struct GuidePictures {
    std::vector<GuidePicture> pictures;
};

using GuideBlock = std::variant<GuideText, GuideTable, GuidePictures>;

// Stays on one page where it fits.
struct GuideSection {
    std::string title;
    std::vector<GuideBlock> blocks;
    bool begins_page = false;
};

struct AssemblyGuide {
    std::string title;
    std::vector<GuideSection> sections;  // the first one has the title of the guide
};

}  // namespace qchopper
