// Written by libharu, which keeps the document in memory. O(what is drawn).

#include "segment/picture/pdf.h"

#include <hpdf.h>

#include <array>
#include <cassert>

#include "base/error.h"

namespace qchopper {
namespace {

// The page of a PDF counts in points.
constexpr double points_per_mm = 72 / 25.4;

HPDF_REAL to_points(double mm) {
    return static_cast<HPDF_REAL>(mm * points_per_mm);
}

std::string ascii(const std::string& text) {
    std::string result;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80 && byte < 0xc0) continue;  // a character of UTF-8 goes on
        result += byte >= 0x20 && byte < 0x7f ? c : '?';
    }
    return result;
}

}  // namespace

struct Pdf::State {
    State() : document(HPDF_New(nullptr, nullptr)) {
        if (document == nullptr) throw InputError(InputFault::io, "the PDF library has no memory");
        HPDF_SetCompressionMode(document, HPDF_COMP_IMAGE);
        fonts = {HPDF_GetFont(document, "Helvetica", nullptr), nullptr};
    }
    ~State() { HPDF_Free(document); }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    HPDF_Font font(Font font) {
        HPDF_Font& wanted = fonts[static_cast<std::size_t>(font)];
        if (wanted == nullptr) wanted = HPDF_GetFont(document, "Helvetica-Bold", nullptr);
        return wanted;
    }

    HPDF_Doc document;
    HPDF_Page page = nullptr;
    std::array<HPDF_Font, 2> fonts{};
};

Pdf::Pdf() : state_(std::make_unique<State>()) {}
Pdf::~Pdf() = default;

void Pdf::add_page(Point2 size) {
    state_->page = HPDF_AddPage(state_->document);
    HPDF_Page_SetWidth(state_->page, to_points(size.x));
    HPDF_Page_SetHeight(state_->page, to_points(size.y));
}

void Pdf::begin_window(Point2 corner, Point2 size, Point2 shift) {
    HPDF_Page page = state_->page;
    HPDF_Page_GSave(page);
    HPDF_Page_Rectangle(page, to_points(corner.x), to_points(corner.y), to_points(size.x), to_points(size.y));
    HPDF_Page_Clip(page);
    HPDF_Page_EndPath(page);
    HPDF_Page_Concat(page, 1, 0, 0, 1, to_points(shift.x), to_points(shift.y));
}

void Pdf::end_window() {
    HPDF_Page_GRestore(state_->page);
}

void Pdf::set_line_width(double width) {
    HPDF_Page_SetLineWidth(state_->page, to_points(width));
}

void Pdf::draw_line(std::span<const Point2> points, bool is_closed) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto to = i == 0 ? HPDF_Page_MoveTo : HPDF_Page_LineTo;
        to(state_->page, to_points(points[i].x), to_points(points[i].y));
    }
    if (is_closed) HPDF_Page_ClosePath(state_->page);
    HPDF_Page_Stroke(state_->page);
}

void Pdf::draw_circle(Point2 middle, double radius) {
    HPDF_Page_Circle(state_->page, to_points(middle.x), to_points(middle.y), to_points(radius));
    HPDF_Page_Stroke(state_->page);
}

void Pdf::draw_text(Point2 at, double height, const std::string& text, Font font) {
    HPDF_Page_SetFontAndSize(state_->page, state_->font(font), to_points(height));
    HPDF_Page_BeginText(state_->page);
    HPDF_Page_TextOut(state_->page, to_points(at.x), to_points(at.y), ascii(text).c_str());
    HPDF_Page_EndText(state_->page);
}

double Pdf::text_width(double height, const std::string& text, Font font) const {
    HPDF_Page_SetFontAndSize(state_->page, state_->font(font), to_points(height));
    return static_cast<double>(HPDF_Page_TextWidth(state_->page, ascii(text).c_str())) / points_per_mm;
}

void Pdf::draw_picture(Point2 corner, Point2 size, const Bytes& png) {
    HPDF_Image image = HPDF_LoadPngImageFromMem(state_->document, png.data(), static_cast<HPDF_UINT>(png.size()));
    if (image == nullptr) throw InputError(InputFault::io, "the PDF library cannot read a picture");
    HPDF_Page_DrawImage(state_->page, image, to_points(corner.x), to_points(corner.y), to_points(size.x),
                        to_points(size.y));
}

Bytes Pdf::bytes() const {
    HPDF_Doc document = state_->document;
    Bytes bytes;
    HPDF_SaveToStream(document);
    HPDF_ResetStream(document);
    for (;;) {
        std::array<HPDF_BYTE, 4096> block;
        HPDF_UINT32 size = block.size();
        const HPDF_STATUS status = HPDF_ReadFromStream(document, block.data(), &size);
        bytes.insert(bytes.end(), block.begin(), block.begin() + size);
        if (status != HPDF_OK || size == 0) break;
    }
    if (bytes.empty()) throw InputError(InputFault::io, "the PDF library made no document");
    return bytes;
}

}  // namespace qchopper
