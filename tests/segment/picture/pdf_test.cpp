#include "segment/picture/pdf.h"

#include <gtest/gtest.h>

#include <array>

#include "base/error.h"
#include "segment/picture/png.h"

namespace qchopper {
namespace {

std::string text_of(const Pdf& pdf) {
    const Bytes bytes = pdf.bytes();
    return {bytes.begin(), bytes.end()};
}

TEST(PdfPages, SizesAndPlacesAreInMm) {
    Pdf pdf;
    pdf.add_page({254, 127});
    pdf.draw_line(std::array<Point2, 2>{{{25.4, 50.8}, {76.2, 50.8}}});
    const std::string text = text_of(pdf);
    EXPECT_NE(text.find("/MediaBox [ 0 0 720 360 ]"), std::string::npos) << text;
    EXPECT_NE(text.find("72 144 m"), std::string::npos) << text;
    EXPECT_NE(text.find("216 144 l"), std::string::npos) << text;
}

TEST(PdfPages, ATextIsAsWideAsTheSumOfItsParts) {
    Pdf pdf;
    pdf.add_page(a4);
    const double whole = pdf.text_width(5, "glue faces");
    EXPECT_NEAR(whole, pdf.text_width(5, "glue ") + pdf.text_width(5, "faces"), 1e-3);
    EXPECT_NEAR(pdf.text_width(10, "glue faces"), 2 * whole, 1e-3);
    EXPECT_GT(pdf.text_width(5, "glue faces", Pdf::Font::bold), whole);
}

TEST(PdfPages, APictureIsCompressed) {
    const Pixels pixels{400, 300, std::vector<Rgb>(120'000, Rgb{250, 250, 250})};
    Pdf pdf;
    pdf.add_page(a4);
    pdf.draw_picture({10, 10}, {80, 60}, to_png(pixels));
    EXPECT_LT(text_of(pdf).size(), 20'000U);
    EXPECT_THROW(pdf.draw_picture({10, 10}, {80, 60}, Bytes(100, 1)), InputError);
}

}  // namespace
}  // namespace qchopper
