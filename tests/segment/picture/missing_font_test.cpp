// The lettering of a system on which the font is not installed: it is built here with the name of a file that is not
// there.

#include <gtest/gtest.h>

#include <string>

#include "base/error.h"
#include "segment/picture/lettering.h"

namespace qchopper {
namespace {

TEST(MissingFont, IsAnErrorThatNamesThePackage) {
    Pixels pixels{60, 40, std::vector<Rgb>(60 * 40)};
    for (const bool draws : {false, true}) {
        try {
            if (draws) draw_text(pixels, 30, 20, "A", 12);
            if (!draws) check_font();
            FAIL() << "no error";
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::missing);
            EXPECT_EQ(std::string(error.what()), "the font of pictures, " QCHOPPER_HERSHEY_FONT ", is missing");
            EXPECT_NE(error.to_do.text.find("hershey-fonts-data"), std::string::npos);
        }
    }
}

TEST(MissingFont, IsNotAskedForByAnEmptyText) {
    Pixels pixels{60, 40, std::vector<Rgb>(60 * 40)};
    EXPECT_NO_THROW(draw_text(pixels, 30, 20, "", 12));
}

}  // namespace
}  // namespace qchopper
