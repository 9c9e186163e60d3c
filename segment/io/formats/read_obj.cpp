// One pass over the lines, as the Advanced Visualizer manual (Wavefront, 1990), appendix B1, defines them; faces that
// name later points are added at the end. O(bytes); add_face.cpp states the cost of polygons.

#include "segment/io/formats/read_obj.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/error.h"
#include "segment/io/formats/add_face.h"
#include "segment/io/formats/text.h"

namespace qchopper {
namespace {

// Keywords of the format whose lines make no face and are ignored.
constexpr std::array<std::string_view, 38> ignored_words{
    "vt",    "vn",    "vp",     "p",        "l",        "g",    "s",      "mg",        "o",      "deg",
    "bmat",  "step",  "cstype", "parm",     "trim",     "hole", "scrv",   "sp",        "end",    "con",
    "call",  "csh",   "bevel",  "c_interp", "d_interp", "lod",  "maplib", "usemap",    "usemtl", "mtllib",
    "ctech", "stech", "cdc",    "cdp",      "bzp",      "bsp",  "res",    "shadow_obj"};
// Keywords of curves and curved surfaces, which are not converted to triangles.
constexpr std::array<std::string_view, 3> curved_words{"surf", "curv", "curv2"};

template <std::size_t n>
bool has(const std::array<std::string_view, n>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Whether a word can begin a line of text above the first OBJ line, as some programs write it: "$WaveFront *.obj file".
bool is_like_a_title(std::string_view word) {
    const auto is_text = [](char c) { return static_cast<unsigned char>(c) > 0x20 && c != 0x7f; };
    const char first = word.front();
    return std::all_of(word.begin(), word.end(), is_text) && (first < '0' || first > '9') && first != '-' &&
           first != '+' && first != '.';
}

// Whether an unknown first word can be the keyword of another program: "attr", "xyzrgb". A word that begins like a
// number or holds bytes that are no text is damage, and skipping its line could lose a face.
bool is_like_a_keyword(std::string_view word) {
    const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
    return is_like_a_title(word) && std::all_of(word.begin(), word.end(), is_ascii);
}

bool is_obj_word(std::string_view word) {
    return word == "v" || word == "f" || word == "fo" || word == "trace_obj" || has(ignored_words, word) ||
           has(curved_words, word);
}

std::string quoted(std::string_view word) {
    return "\"" + std::string(word.substr(0, 40)) + "\"";
}

// Lines without comments; a line that ends in a backslash is joined with the next.
class Lines {
 public:
    explicit Lines(std::string_view text) : text_(text) {}

    std::optional<std::string_view> next() {
        if (text_.at_end()) return {};
        number_ = next_number_;
        std::string_view line = next_part();
        if (!line.ends_with('\\')) return line;
        joined_.clear();
        while (line.ends_with('\\')) {
            joined_ += line.substr(0, line.size() - 1);
            joined_ += ' ';
            line = next_part();
        }
        joined_ += line;
        return joined_;
    }

    // Of the line that next() returned last, from 1.
    std::size_t number() const { return number_; }

 private:
    std::string_view next_part() {
        const std::string_view line = text_.rest_of_line();
        ++next_number_;
        return line.substr(0, line.find('#'));
    }

    Text text_;
    std::string joined_;
    std::size_t number_ = 1;
    std::size_t next_number_ = 1;
};

class ObjReader {
 public:
    ObjReader(std::string_view text, const std::string& name) : lines_(text), name_(name) {}

    RawMesh read() {
        scan_.format = MeshFormat::obj;
        while (const std::optional<std::string_view> line = lines_.next()) read_line(*line);
        add_early_faces();
        if (scan_.mesh.triangles.size() > max_triangles) refuse("more than 1.4 billion triangles");
        warn_of_unknown_lines();
        if (curved_ > 0) {
            scan_.warnings.push_back(std::to_string(curved_) +
                                     " curved surfaces and curves were left out, the first in line " +
                                     std::to_string(first_curved_) + ": only faces are read.");
        }
        return std::move(scan_);
    }

 private:
    void read_line(std::string_view line) {
        Text words(line);
        const std::string_view word = words.word();
        if (word.empty()) return;
        if (is_above_ && is_obj_word(word)) is_above_ = false;
        if (has(ignored_words, word) || word == "trace_obj") return;
        if (word == "v") return read_point(words);
        if (word == "f" || word == "fo") return read_face(words);
        if (has(curved_words, word)) {
            if (curved_++ == 0) first_curved_ = lines_.number();
            return;
        }
        if (!(is_above_ ? is_like_a_title(word) : is_like_a_keyword(word)))
            refuse("begins with " + quoted(word) + ", which no OBJ line does");
        if (unknown_++ > 0) return;
        first_unknown_ = lines_.number();
        unknown_word_ = quoted(word);
    }

    void warn_of_unknown_lines() {
        if (unknown_ == 0) return;
        scan_.warnings.push_back(std::to_string(unknown_) +
                                 (unknown_ == 1 ? " line of unknown kind was" : " lines of unknown kind were") +
                                 " skipped, the first is line " + std::to_string(first_unknown_) +
                                 ", which begins with " + unknown_word_ + ".");
    }

    // x y z; a weight or a colour may follow and is ignored.
    void read_point(Text& words) {
        if (scan_.mesh.points.size() == max_points) refuse("more than 4 billion points");
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = words.word();
            if (word.empty()) refuse("a point needs three coordinates");
            const std::optional<double> value = number(word);
            if (!value) refuse("a coordinate cannot be " + quoted(word));
            if (!std::isfinite(*value)) refuse("a coordinate is not a finite number");
            point[axis] = *value;
        }
        scan_.mesh.points.push_back(point);
    }

    void read_face(Text& words) {
        corners_.clear();
        bool is_early = false;
        for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
            if (corners_.size() == static_cast<std::size_t>(max_corners)) {
                refuse("a face has more than " + std::to_string(max_corners) + " corners");
            }
            corners_.push_back(corner(word));
            is_early |= corners_.back() >= scan_.mesh.points.size();
        }
        if (is_early) {
            early_.keep(corners_, static_cast<std::int64_t>(lines_.number()));
        } else {
            add_face(scan_, corners_);
        }
    }

    // The index of the point in point, point/texture, point//normal or point/texture/normal; numbers in the file count
    // from 1, or backwards from -1, the last point so far.
    std::uint32_t corner(std::string_view word) const {
        std::string_view rest = word;
        std::optional<std::int64_t> first;
        for (int part = 0; part < 3; ++part) {
            const std::size_t slash = rest.find('/');
            const std::string_view digits = rest.substr(0, slash);
            const std::optional<std::int64_t> value = integer(digits);
            if (part == 0) first = value;
            if (!value && (part == 0 || !digits.empty())) break;
            if (slash == std::string_view::npos) {
                rest = {};
                break;
            }
            rest.remove_prefix(slash + 1);
        }
        if (!first || !rest.empty()) refuse("a corner cannot be " + quoted(word));
        const auto count = static_cast<std::int64_t>(scan_.mesh.points.size());
        const std::int64_t index = *first > 0 ? *first - 1 : count + *first;
        if (*first == 0 || index < 0 || index >= static_cast<std::int64_t>(max_points))
            refuse(names_point(*first, scan_.mesh.points.size()));
        return static_cast<std::uint32_t>(index);
    }

    void add_early_faces() {
        const std::size_t count = scan_.mesh.points.size();
        for (std::size_t f = 0; f < early_.end.size(); ++f) {
            for (const std::uint32_t c : early_.corners_of(f)) {
                if (c < count) continue;
                refuse_at(static_cast<std::size_t>(early_.note[f]), names_point(std::int64_t{c} + 1, count));
            }
            add_face(scan_, early_.corners_of(f));
        }
    }

    static std::string names_point(std::int64_t point, std::size_t count) {
        return "a face names point " + std::to_string(point) + ", but there are " + std::to_string(count);
    }
    [[noreturn]] void refuse(const std::string& why) const { refuse_at(lines_.number(), why); }
    [[noreturn]] void refuse_at(std::size_t line, const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": line " + std::to_string(line) + " of the OBJ: " + why,
                         export_again);
    }

    Lines lines_;
    const std::string& name_;
    RawMesh scan_;
    std::vector<std::uint32_t> corners_;  // of the face that is being read
    EarlyFaces early_;                    // the note is the line
    std::size_t curved_ = 0;
    std::size_t first_curved_ = 0;
    bool is_above_ = true;  // the first line of OBJ
    std::size_t unknown_ = 0;
    std::size_t first_unknown_ = 0;
    std::string unknown_word_;
};

}  // namespace

bool is_obj(const Bytes& bytes) {
    Lines lines(as_text(bytes));
    bool is_first = true;
    while (const std::optional<std::string_view> line = lines.next()) {
        Text words(*line);
        const std::string_view word = words.word();
        if (word.empty()) continue;
        if (is_first && is_obj_word(word)) return true;
        if (word == "v" && number(words.word()) && number(words.word()) && number(words.word())) return true;
        if (!is_like_a_title(word)) return false;
        is_first = false;
    }
    return false;
}

RawMesh parse_obj(const Bytes& bytes, const std::string& name) {
    return ObjReader(as_text(bytes), name).read();
}

}  // namespace qchopper
