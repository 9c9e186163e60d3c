// Lines are broken by the widths of the font; columns get what their longest entry needs, and where that is too much
// the widest are broken. O(characters + bytes of the pictures).

#include "app/guide/guide_pdf.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

#include "segment/picture/pdf.h"

namespace qchopper {
namespace {

// mm
constexpr double margin = 15;
constexpr double footer = 10;  // above the margin below
constexpr double width = 210 - 2 * margin;
constexpr double text_height = 3.6;
constexpr double small_height = 3;
constexpr double title_height = 6;
constexpr double section_height = 4.6;
constexpr double line_factor = 1.35;
constexpr double gap = 2;
constexpr double column_gap = 4;
constexpr double largest_picture = 80;  // its height: two steps on a page

class PdfLayout {
 public:
    explicit PdfLayout(const AssemblyGuide& guide) : guide_(guide) { begin_page(); }

    Bytes bytes() {
        lines(guide_.title, title_height, Pdf::Font::bold);
        bool is_first = true;
        for (const GuideSection& section : guide_.sections) {
            if (!is_first) begin_section(section);
            is_first = false;
            for (const GuideBlock& block : section.blocks) {
                std::visit([this](const auto& one) { add(one); }, block);
                y_ -= gap;
            }
        }
        return pdf_.bytes();
    }

 private:
    void begin_page() {
        pdf_.add_page(a4);
        ++page_;
        y_ = a4.y - margin;
        const std::string number = std::to_string(page_);
        pdf_.draw_text({margin, margin}, small_height, guide_.title);
        pdf_.draw_text({a4.x - margin - pdf_.text_width(small_height, number), margin}, small_height, number);
    }

    double room() const { return y_ - margin - footer; }
    double full_room() const { return a4.y - 2 * margin - footer; }
    void need(double height) {
        if (room() < height && room() < full_room()) begin_page();
    }

    void begin_section(const GuideSection& section) {
        double height = 2 * section_height * line_factor;
        for (const GuideBlock& block : section.blocks) {
            height += gap + std::visit([this](const auto& one) { return this->height_of(one); }, block);
        }
        if (section.begins_page) {
            begin_page();
        } else {
            y_ -= section_height;
            need(std::min(height, full_room()));
        }
        lines(section.title, section_height, Pdf::Font::bold);
        y_ -= gap / 2;
    }

    std::vector<std::string> broken(const std::string& text, double height, double limit, Pdf::Font font) const {
        std::vector<std::string> result;
        limit += 0.05;  // widths are sums of single-precision numbers
        std::istringstream words(text);
        for (std::string word; words >> word;) {
            while (word.size() > 1 && pdf_.text_width(height, word, font) > limit) {
                std::size_t fits = word.size() - 1;
                while (fits > 1 && pdf_.text_width(height, word.substr(0, fits), font) > limit) --fits;
                result.push_back(word.substr(0, fits));
                word.erase(0, fits);
            }
            const std::string longer = result.empty() ? word : result.back() + " " + word;
            if (result.empty() || pdf_.text_width(height, longer, font) > limit) {
                result.push_back(word);
            } else {
                result.back() = longer;
            }
        }
        if (result.empty()) result.emplace_back();
        return result;
    }

    void lines(const std::string& text, double height, Pdf::Font font) {
        for (const std::string& line : broken(text, height, width, font)) {
            need(height * line_factor);
            y_ -= height * line_factor;
            pdf_.draw_text({margin, y_}, height, line, font);
        }
    }

    static Pdf::Font font_of(const GuideText& text) { return text.is_warning ? Pdf::Font::bold : Pdf::Font::plain; }
    double height_of(const GuideText& text) const {
        const auto count = broken(text.text, text_height, width, font_of(text)).size();
        return static_cast<double>(count) * text_height * line_factor;
    }
    void add(const GuideText& text) { lines(text.text, text_height, font_of(text)); }

    // The widest column gives until all fit.
    std::vector<double> columns_of(const GuideTable& table) const {
        std::vector<double> widths(table.is_number.size(), 0);
        for (const std::vector<std::string>& row : table.rows) {
            for (std::size_t c = 0; c < row.size(); ++c) {
                widths[c] = std::max(widths[c], pdf_.text_width(small_height, row[c], Pdf::Font::bold) + column_gap);
            }
        }
        constexpr double least = 12;
        for (double all = std::accumulate(widths.begin(), widths.end(), 0.0); all > width;) {
            double& widest = *std::max_element(widths.begin(), widths.end());
            const double less = std::min({widest - least, all - width, 0.1 * widest + 1});
            if (less <= 0) break;
            widest -= less;
            all -= less;
        }
        return widths;
    }
    using BrokenRow = std::vector<std::vector<std::string>>;  // per column its lines
    BrokenRow broken_row(const std::vector<std::string>& row, const std::vector<double>& widths, Pdf::Font font) const {
        BrokenRow result;
        for (std::size_t c = 0; c < row.size(); ++c) {
            result.push_back(broken(row[c], small_height, widths[c] - column_gap, font));
        }
        return result;
    }
    static double height_of(const BrokenRow& row) {
        std::size_t most = 1;
        for (const auto& entry : row) most = std::max(most, entry.size());
        return static_cast<double>(most) * small_height * line_factor + 0.6;
    }
    double height_of(const GuideTable& table) const {
        const std::vector<double> widths = columns_of(table);
        double height = 0;
        for (const auto& row : table.rows) height += height_of(broken_row(row, widths, Pdf::Font::plain));
        return height;
    }
    void add(const GuideTable& table) {
        const std::vector<double> widths = columns_of(table);
        pdf_.set_line_width(0.1);
        for (std::size_t r = 0; r < table.rows.size(); ++r) {
            const Pdf::Font font = r == 0 ? Pdf::Font::bold : Pdf::Font::plain;
            const BrokenRow row = broken_row(table.rows[r], widths, font);
            const int page = page_;
            need(height_of(row));
            if (page_ != page && r > 0) {
                draw_row(broken_row(table.rows.front(), widths, Pdf::Font::bold), table, widths, Pdf::Font::bold);
            }
            draw_row(row, table, widths, font);
        }
    }
    void draw_row(const BrokenRow& row, const GuideTable& table, const std::vector<double>& widths, Pdf::Font font) {
        double x = margin;
        for (std::size_t c = 0; c < row.size(); ++c) {
            double y = y_;
            for (const std::string& line : row[c]) {
                y -= small_height * line_factor;
                const double free = widths[c] - column_gap - pdf_.text_width(small_height, line, font);
                pdf_.draw_text({x + (table.is_number[c] ? free : 0), y}, small_height, line, font);
            }
            x += widths[c];
        }
        y_ -= height_of(row);
        const std::array<Point2, 2> rule{{{margin, y_ - 0.4}, {x - column_gap, y_ - 0.4}}};
        pdf_.draw_line(rule);
    }

    static double height_of(const GuidePictures& pictures) {
        const double each = width_of_each(pictures);
        double height = 0;
        for (const GuidePicture& p : pictures.pictures) height = std::max(height, drawn(p, each).y);
        return height + 2 * small_height * line_factor;
    }
    static double width_of_each(const GuidePictures& pictures) {
        const auto count = static_cast<double>(std::max<std::size_t>(pictures.pictures.size(), 1));
        return (width - (count - 1) * column_gap) / count;
    }
    static Point2 drawn(const GuidePicture& picture, double most) {
        const double ratio = static_cast<double>(picture.height) / picture.width;
        const double wide = std::min(most, largest_picture / ratio);
        return {wide, wide * ratio};
    }
    void add(const GuidePictures& pictures) {
        const double height = height_of(pictures);
        need(height);
        const double each = width_of_each(pictures);
        double x = margin;
        for (const GuidePicture& picture : pictures.pictures) {
            const Point2 size = drawn(picture, each);
            pdf_.draw_picture({x, y_ - size.y}, size, picture.png);
            double y = y_ - size.y;
            for (const std::string& line : broken(picture.caption, small_height, each, Pdf::Font::plain)) {
                y -= small_height * line_factor;
                pdf_.draw_text({x, y}, small_height, line);
            }
            x += each + column_gap;
        }
        y_ -= height;
    }

    const AssemblyGuide& guide_;
    Pdf pdf_;
    int page_ = 0;
    double y_ = 0;  // below what is on the page
};

}  // namespace

Bytes guide_pdf(const AssemblyGuide& guide) {
    return PdfLayout(guide).bytes();
}

}  // namespace qchopper
