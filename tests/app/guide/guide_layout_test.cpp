#include <gtest/gtest.h>

#include "app/guide/guide_html.h"
#include "app/guide/guide_pdf.h"
#include "base/error.h"
#include "segment/picture/png.h"

namespace qchopper {
namespace {

GuidePicture picture() {
    const Pixels pixels{30, 20, std::vector<Rgb>(600, Rgb{10, 200, 30})};
    return {to_png(pixels), pixels.width, pixels.height, "A picture"};
}

AssemblyGuide guide_with(std::vector<GuideBlock> blocks) {
    AssemblyGuide guide{"Guide: a <bone> & \"co\"", {{"", {GuideText{"First."}}, true}}};
    guide.sections.push_back({"Blocks", std::move(blocks), true});
    return guide;
}

GuideTable long_table(std::size_t rows) {
    GuideTable table{{{"piece", "cm2"}}, {false, true}};
    for (std::size_t i = 0; i < rows; ++i) table.rows.push_back({"P" + std::to_string(i), "12.5"});
    return table;
}

std::size_t count_of(const std::string& text, const std::string& words) {
    std::size_t count = 0;
    for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
    return count;
}

std::string text_of(const Bytes& bytes) {
    return {bytes.begin(), bytes.end()};
}

TEST(GuideHtml, EscapesEveryTextAndHoldsItsPictures) {
    const std::string html = guide_html(
        guide_with({GuideText{"<script>alert(1)</script>", true},
                    GuideTable{{{"<b>", "x"}, {"'\"", "1"}}, {false, true}}, GuidePictures{{picture(), picture()}}}));
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("<bone>"), std::string::npos);
    EXPECT_EQ(count_of(html, "src=\"data:image/png;base64,"), 2U);
    EXPECT_EQ(count_of(html, "src="), 2U) << "nothing from elsewhere";
    EXPECT_EQ(count_of(html, "<article class=\"sheet\">"), 2U) << "a page for each section that begins one";
    EXPECT_EQ(count_of(html, "class=\"stop\""), 1U);
}

TEST(GuidePdf, HasEveryTextAndTheSameBytes) {
    const AssemblyGuide guide = guide_with({GuideText{"Hold it."}, long_table(3), GuidePictures{{picture()}}});
    const Bytes bytes = guide_pdf(guide);
    EXPECT_EQ(bytes, guide_pdf(guide));
    const std::string pdf = text_of(bytes);
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_EQ(count_of(pdf, "/Type /Page\n"), 2U);
    for (const char* text : {"(First.)", "(Hold it.)", "(P2)", "(12.5)", "(A picture)", "(Blocks)"}) {
        EXPECT_EQ(count_of(pdf, text), text == std::string("(12.5)") ? 3U : 1U) << text;
    }
    EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
}

TEST(GuidePdf, ALongTableGoesOnWithItsHead) {
    const std::string pdf = text_of(guide_pdf(guide_with({long_table(200)})));
    const std::size_t pages = count_of(pdf, "/Type /Page\n");
    EXPECT_GE(pages, 4U);
    EXPECT_EQ(count_of(pdf, "(piece)"), pages - 1) << "one head on each page but the first";
    EXPECT_EQ(count_of(pdf, "(12.5)"), 200U);
}

TEST(GuidePdf, WhatIsWiderThanThePageIsBroken) {
    const GuideTable table{{{"a", "b"}, {std::string(300, 'x'), "1"}}, {false, true}};
    const std::string pdf = text_of(guide_pdf(guide_with({GuideText{std::string(500, 'y')}, table})));
    std::size_t all = 0;
    for (std::size_t i = 0; i < pdf.size(); ++i) all += pdf[i] == 'y' ? 1 : 0;
    EXPECT_GE(all, 500U);
    EXPECT_EQ(pdf.find(std::string(200, 'y')), std::string::npos);
}

TEST(GuidePdf, OtherCharactersThanThoseOfItsFontAreMarked) {
    const std::string pdf =
        text_of(guide_pdf(guide_with({GuideText{"Sch\xc3\xa4"
                                                "del \xe9\xaa\xa8"}})));
    EXPECT_EQ(count_of(pdf, "(Sch?del ?)"), 1U);
}

TEST(GuidePdf, APictureThatIsNoneIsAnError) {
    GuidePicture broken = picture();
    broken.png.assign(40, 7);
    EXPECT_THROW(guide_pdf(guide_with({GuidePictures{{broken}}})), InputError);
}

}  // namespace
}  // namespace qchopper
