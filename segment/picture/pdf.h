// A PDF document in memory: pages with lines, circles, text and pictures; the pictures are compressed.
//
// mm from the lower left corner of the page, y upwards. The same calls give the same bytes: no time and no name of a
// machine is in them (tests/segment/picture/pdf_test.cpp).

#pragma once

#include <memory>
#include <span>
#include <string>

#include "base/files/file.h"
#include "segment/mesh/polygon.h"

namespace qchopper {

constexpr Point2 a4{210, 297};  // upright

class Pdf {
 public:
    enum class Font { plain, bold };  // Helvetica

    // Throws InputError (io) if the library has no memory.
    Pdf();
    ~Pdf();
    Pdf(const Pdf&) = delete;
    Pdf& operator=(const Pdf&) = delete;

    // What follows is drawn on it. Precondition of all that draws: there is a page.
    void add_page(Point2 size);
    // Until end_window() only what lies in the rectangle is drawn, moved by `shift`.
    void begin_window(Point2 corner, Point2 size, Point2 shift);
    void end_window();
    void set_line_width(double width);
    void draw_line(std::span<const Point2> points, bool is_closed = false);
    void draw_circle(Point2 middle, double radius);
    // One line that begins at `at`, on its foot, in a font of this height. Characters that are not of ASCII become "?".
    void draw_text(Point2 at, double height, const std::string& text, Font font = Font::plain);
    // Precondition: there is a page.
    double text_width(double height, const std::string& text, Font font = Font::plain) const;
    // A PNG, stretched to the rectangle. Throws InputError (io) for what is none.
    void draw_picture(Point2 corner, Point2 size, const Bytes& png);

    // The whole document. Throws InputError (io) if the library fails.
    Bytes bytes() const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace qchopper
