// One pass over the lines, as the Geomview manual defines them. O(bytes); add_face.cpp states the cost of polygons.

#include "segment/io/formats/read_off.h"

#include <cmath>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "segment/io/formats/add_face.h"
#include "segment/io/formats/text.h"

namespace qchopper {
namespace {

// [ST][C][N][4][n]OFF: the letters before OFF announce further numbers of every point.
struct Keyword {
    bool is_off = false;
    bool has_more_dimensions = false;
};

Keyword keyword_of(std::string_view word) {
    Keyword keyword;
    const auto remove = [&](std::string_view letters) {
        if (!word.starts_with(letters)) return false;
        word.remove_prefix(letters.size());
        return true;
    };
    remove("ST");
    remove("C");
    remove("N");
    const bool has_four = remove("4");
    const bool has_n = remove("n");
    keyword.has_more_dimensions = has_four || has_n;
    keyword.is_off = word == "OFF";
    return keyword;
}

// The next line of the text, without its comment.
Text next_words(Text& text) {
    const std::string_view line = text.rest_of_line();
    return Text(line.substr(0, line.find('#')));
}

class OffReader {
 public:
    OffReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

    RawMesh read() {
        scan_.format = MeshFormat::off;
        Text words = next_line("the keyword OFF");
        read_keyword(words);
        read_counts(words);
        read_points();
        read_faces();
        while (!text_.at_end()) {
            ++line_;
            if (next_words(text_).word().empty()) continue;
            refuse("more data follow than line " + std::to_string(counts_line_) + " announces");
        }
        return std::move(scan_);
    }

 private:
    void read_keyword(Text& words) {
        const std::string_view word = words.word();
        if (keyword_of(word).has_more_dimensions) {
            refuse("\"" + std::string(word) + "\" holds points with more than three coordinates");
        }
        Text ahead = words;
        if (equals_ignoring_case(ahead.word(), "binary")) {
            throw InputError(InputFault::mesh, name_ + " is a binary OFF, which is not read",
                             "save it as text, or as PLY");
        }
    }

    // In the line of the keyword or the next. The third count, of edges, is ignored and may be missing.
    void read_counts(Text words) {
        Text ahead = words;
        if (ahead.word().empty()) words = next_line("the counts");
        counts_line_ = line_;
        const std::optional<std::int64_t> points = integer(words.word());
        const std::optional<std::int64_t> faces = integer(words.word());
        const std::string_view edges = words.word();
        if (!points || !faces || *points < 0 || *faces < 0 || !(edges.empty() || integer(edges))) {
            refuse("the counts of points, faces and edges are expected here");
        }
        points_ = static_cast<std::uint64_t>(*points);
        faces_ = static_cast<std::uint64_t>(*faces);
        if (points_ > max_points) refuse("more than 4 billion points");
        // three digits with a separator each for a point, one for a face, at the least
        const std::uint64_t space = text_.left() + 1;
        if (points_ > space / 6 || faces_ > space / 2 || 6 * points_ + 2 * faces_ > space) {
            refuse("announces " + std::to_string(points_) + " points and " + std::to_string(faces_) +
                   " faces, more than the file has room for");
        }
    }

    void read_points() {
        scan_.mesh.points.reserve(points_);
        for (std::uint64_t i = 0; i < points_; ++i) {
            Text words = next_line("point " + std::to_string(i));
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis) {
                const std::string_view word = words.word();
                const std::optional<double> value = number(word);
                if (!value) {
                    refuse("point " + std::to_string(i) + " should have a coordinate where the line " +
                           (word.empty() ? "ends" : "has \"" + std::string(word.substr(0, 40)) + "\""));
                }
                if (!std::isfinite(*value)) {
                    refuse("point " + std::to_string(i) + " has a coordinate that is not a finite number");
                }
                point[axis] = *value;
            }
            scan_.mesh.points.push_back(point);
        }
    }

    void read_faces() {
        scan_.mesh.triangles.reserve(faces_);
        std::vector<std::uint32_t> corners;
        for (std::uint64_t f = 0; f < faces_; ++f) {
            Text words = next_line("face " + std::to_string(f));
            const std::optional<std::int64_t> count = integer(words.word());
            if (!count || *count < 0) refuse("face " + std::to_string(f) + " should begin with its number of corners");
            if (*count > max_corners) {
                refuse("face " + std::to_string(f) + " has " + std::to_string(*count) + " corners; " +
                       std::to_string(max_corners) + " is the most that is read");
            }
            corners.clear();
            for (std::int64_t i = 0; i < *count; ++i) corners.push_back(read_corner(words, f));
            add_face(scan_, corners);
        }
        if (scan_.mesh.triangles.size() > max_triangles) refuse("more than 1.4 billion triangles");
    }

    std::uint32_t read_corner(Text& words, std::uint64_t face) const {
        const std::optional<std::int64_t> corner = integer(words.word());
        if (!corner) refuse("face " + std::to_string(face) + " has fewer corners than it announces");
        if (*corner < 0 || static_cast<std::uint64_t>(*corner) >= points_) {
            refuse("face " + std::to_string(face) + " names point " + std::to_string(*corner) + ", but there are " +
                   std::to_string(points_));
        }
        return static_cast<std::uint32_t>(*corner);
    }

    // The next line that is not empty, without its comment.
    Text next_line(const std::string& wanted) {
        while (!text_.at_end()) {
            ++line_;
            const Text words = next_words(text_);
            if (!Text(words).word().empty()) return words;
        }
        ++line_;
        refuse("the file ends before " + wanted);
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": line " + std::to_string(line_) + " of the OFF: " + why,
                         export_again);
    }

    Text text_;
    const std::string& name_;
    RawMesh scan_;
    std::size_t line_ = 0;
    std::size_t counts_line_ = 0;
    std::uint64_t points_ = 0;
    std::uint64_t faces_ = 0;
};

}  // namespace

bool is_off(const Bytes& bytes) {
    Text text(as_text(bytes));
    while (!text.at_end()) {
        const std::string_view word = next_words(text).word();
        if (!word.empty()) return keyword_of(word).is_off;
    }
    return false;
}

RawMesh parse_off(const Bytes& bytes, const std::string& name) {
    return OffReader(as_text(bytes), name).read();
}

}  // namespace qchopper
