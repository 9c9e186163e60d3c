// One pass over the lines of the header after G. Turk, "The PLY Polygon File Format", 1994. O(bytes of the header).

#include "segment/io/formats/ply_header.h"

#include <array>
#include <optional>

#include "base/error.h"
#include "segment/io/formats/text.h"

namespace qchopper {
namespace {

struct TypeName {
    std::string_view old_name;
    std::string_view new_name;
    PlyType type;
    std::size_t size;
};
// In the order of PlyType.
constexpr std::array<TypeName, 8> type_names{{{"char", "int8", PlyType::i8, 1},
                                              {"uchar", "uint8", PlyType::u8, 1},
                                              {"short", "int16", PlyType::i16, 2},
                                              {"ushort", "uint16", PlyType::u16, 2},
                                              {"int", "int32", PlyType::i32, 4},
                                              {"uint", "uint32", PlyType::u32, 4},
                                              {"float", "float32", PlyType::f32, 4},
                                              {"double", "float64", PlyType::f64, 8}}};

constexpr std::size_t max_elements = 100;

// Reads the header line by line; every fault is refused with its line.
class HeaderReader {
 public:
    HeaderReader(std::string_view file, const std::string& name) : file_(file), name_(name) {}

    PlyHeader read() {
        // Lines end in CR alone only if the first one does: a binary body may begin with the byte of an LF.
        const std::size_t end_of_first = file_.find_first_of("\r\n");
        if (end_of_first == std::string_view::npos) refuse("the file ends in the first line");
        line_end_ = file_[end_of_first];
        if (file_.substr(end_of_first, 2) == "\r\n") line_end_ = '\n';
        at_ = file_.find(line_end_) + 1;
        bool has_format = false;
        while (true) {
            const std::string_view line = next_line();
            Text words(line);
            const std::string_view keyword = words.word();
            if (keyword == "end_header") break;
            if (keyword == "format") {
                read_format(words);
                has_format = true;
            } else if (keyword == "element") {
                read_element(words);
            } else if (keyword == "property") {
                read_property(words);
            } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
                refuse("unknown word \"" + std::string(keyword.substr(0, 40)) + "\"");
            }
        }
        if (!has_format) refuse("no \"format\" line");
        header_.size = at_;
        header_.lines = line_;
        return std::move(header_);
    }

 private:
    std::string_view next_line() {
        ++line_;
        const std::size_t end = file_.find(line_end_, at_);
        if (end == std::string_view::npos) refuse("the file ends before \"end_header\"");
        const std::string_view line = file_.substr(at_, end - at_);
        at_ = end + 1;
        return line;
    }

    void read_format(Text& words) {
        const std::string_view kind = words.word();
        if (kind == "ascii") {
            header_.format = MeshFormat::ply_ascii;
        } else if (kind == "binary_little_endian") {
            header_.format = MeshFormat::ply_little_endian;
        } else if (kind == "binary_big_endian") {
            header_.format = MeshFormat::ply_big_endian;
        } else {
            refuse("unknown format \"" + std::string(kind.substr(0, 40)) + "\"");
        }
    }

    void read_element(Text& words) {
        PlyElement element;
        element.name = words.word();
        const std::optional<std::int64_t> count = integer(words.word());
        if (header_.elements.size() == max_elements) refuse("more than 100 elements");
        if (element.name.empty() || !count || *count < 0) refuse("an element needs a name and a count");
        for (const PlyElement& other : header_.elements) {
            if (other.name == element.name) refuse("a second element \"" + element.name + "\"");
        }
        element.count = static_cast<std::uint64_t>(*count);
        element.line = line_;
        header_.elements.push_back(std::move(element));
    }

    void read_property(Text& words) {
        if (header_.elements.empty()) refuse("a property before any element");
        PlyProperty property;
        std::string_view type = words.word();
        if (type == "list") {
            property.is_list = true;
            property.count_type = type_named(words.word());
            if (!is_integer(property.count_type)) refuse("the count of a list must be an integer type");
            type = words.word();
        }
        property.type = type_named(type);
        property.name = words.word();
        if (property.name.empty()) refuse("a property without a name");
        header_.elements.back().properties.push_back(std::move(property));
    }

    PlyType type_named(std::string_view word) const {
        for (const TypeName& known : type_names) {
            if (word == known.old_name || word == known.new_name) return known.type;
        }
        refuse("unknown type \"" + std::string(word.substr(0, 40)) + "\"");
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw InputError(InputFault::mesh, name_ + ": line " + std::to_string(line_) + " of the PLY header: " + why,
                         export_again);
    }

    std::string_view file_;
    const std::string& name_;
    char line_end_ = '\n';
    std::size_t at_ = 0;
    std::size_t line_ = 1;
    PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyType type) {
    return type_names[static_cast<std::size_t>(type)].size;
}

PlyHeader read_ply_header(std::string_view file, const std::string& name) {
    return HeaderReader(file, name).read();
}

}  // namespace qchopper
