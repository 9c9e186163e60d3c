// Writes and reads the text of a plan: TOML, by toml++.

#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "app/project/plan.h"
#include "base/error.h"

namespace qchopper {
namespace {

constexpr const char* first_line = "# QChopper plan";
constexpr std::int64_t schema = 1;
constexpr double most = 1e15;

// As many digits as give the same bits again; always with a point or an exponent, so that it stays a float.
std::string in_digits(double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.17g", value);
    std::string digits = text.data();
    if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
    return digits;
}

std::string in_digits(Vec3 v) {
    return "[" + in_digits(v.x) + ", " + in_digits(v.y) + ", " + in_digits(v.z) + "]";
}

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
    }
    return out + "\"";
}

std::string word(const PathSide& side) {
    return std::to_string(side.cut) + (side.above ? " above" : " below");
}

std::string in_words(const std::vector<PathSide>& path) {
    std::string text;
    for (const PathSide& side : path) text += (text.empty() ? "" : ", ") + quoted(word(side));
    return "[" + text + "]";
}

// One table, read key by key; every fault names file, line and key.
class Table {
 public:
    Table(const toml::table& table, const std::string& file, std::initializer_list<std::string_view> known)
        : table_(table), file_(file) {
        for (const auto& [key, value] : table_) {
            const bool is_known = std::find(known.begin(), known.end(), key.str()) != known.end();
            if (!is_known) refuse(std::string(key.str()), "no such key");
        }
    }

    [[noreturn]] void refuse(const std::string& key, const std::string& why) const {
        const toml::node* node = table_.get(key);
        const auto line = (node != nullptr ? node->source() : table_.source()).begin.line;
        throw InputError(InputFault::config, file_ + ":" + std::to_string(line) + ": " + key + ": " + why,
                         "mend the plan; docs/plan-file.md explains its keys");
    }

    bool has(const std::string& key) const { return table_.contains(key); }

    double number(const std::string& key) const { return number_in(key, table_.get(key)); }
    double positive(const std::string& key) const {
        const double value = number(key);
        if (!(value > 0)) refuse(key, "must be greater than 0");
        return value;
    }
    std::int64_t whole(const std::string& key, std::int64_t least) const {
        const toml::node* node = table_.get(key);
        const auto value = node != nullptr ? node->value_exact<std::int64_t>() : std::nullopt;
        if (!value || *value < least) refuse(key, "must be a whole number of at least " + std::to_string(least));
        return *value;
    }
    std::string text(const std::string& key) const {
        const toml::node* node = table_.get(key);
        const auto value = node != nullptr ? node->value_exact<std::string>() : std::nullopt;
        if (!value) refuse(key, "must be a text");
        return *value;
    }
    std::vector<double> numbers(const std::string& key) const {
        std::vector<double> values;
        for (const toml::node& node : array(key)) values.push_back(number_in(key, &node));
        return values;
    }
    Vec3 vector(const std::string& key) const {
        const std::vector<double> v = numbers(key);
        if (v.size() != 3) refuse(key, "must be three numbers");
        return {v[0], v[1], v[2]};
    }
    const toml::array& array(const std::string& key) const {
        const toml::node* node = table_.get(key);
        if (node == nullptr || !node->is_array()) refuse(key, "must be a list");
        return *node->as_array();
    }
    const toml::table& table(const std::string& key) const {
        const toml::node* node = table_.get(key);
        if (node == nullptr || !node->is_table()) refuse(key, "must be a table");
        return *node->as_table();
    }

 private:
    double number_in(const std::string& key, const toml::node* node) const {
        std::optional<double> value;
        if (node != nullptr && node->is_number()) value = node->value<double>();
        if (!value || !(std::abs(*value) <= most)) refuse(key, "must be a number");
        return *value;
    }

    const toml::table& table_;
    const std::string& file_;
};

PlanScan scan_from(const Table& t) {
    PlanScan scan;
    scan.name = t.text("name");
    scan.sha256 = t.text("sha256");
    try {
        scan.unit = unit_named(t.text("units"));
    } catch (const InputError& e) {
        t.refuse("units", e.what());
    }
    scan.scale = t.positive("scale");
    scan.centre = t.vector("centre_mm");
    scan.faces = static_cast<std::size_t>(t.whole("faces", 1));
    scan.volume_mm3 = t.positive("volume_mm3");
    scan.box = {t.vector("box_min_mm"), t.vector("box_max_mm")};
    return scan;
}

// Names cuts before the cut `number`.
std::vector<PathSide> path_from(const Table& t, std::int32_t number) {
    std::vector<PathSide> path;
    for (const toml::node& node : t.array("path")) {
        const std::string text = node.value_exact<std::string>().value_or("");
        std::istringstream in(text);
        PathSide side;
        std::string where;
        std::string rest;
        const bool is_ok = (in >> side.cut >> where) && !(in >> rest) && (where == "above" || where == "below") &&
                           side.cut >= 1 && side.cut < number;
        if (!is_ok) t.refuse("path", "\"" + text + "\" is not like \"1 above\", of an earlier cut");
        side.above = where == "above";
        path.push_back(side);
    }
    return path;
}

// As it was before the cut `number`.
PlanPiece piece_from(const Table& t, std::int32_t number) {
    return {t.text("piece"), path_from(t, number), t.vector("inside_mm"), t.positive("volume_mm3")};
}

PlanCut cut_from(const Table& t, std::int32_t expected, Vec3 centre) {
    if (t.whole("number", 1) != expected) t.refuse("number", "must count 1, 2, ... in the order of the cuts");
    PlanCut cut{piece_from(t, expected), expected, {}, 0, {}};
    const Vec3 normal = t.vector("normal");
    if (!(norm(normal) > 0)) t.refuse("normal", "must not be zero");
    const Plane direction = canonical({normal, 0});
    const double turned = dot(direction.normal, normal) < 0 ? -1 : 1;
    cut.plane = {direction.normal, turned * t.number("offset_mm")};
    cut.from_centre = cut.plane.offset - height(cut.plane.normal, centre);
    if (t.has("offset_from_centre_mm")) {
        const double exact = turned * t.number("offset_from_centre_mm");
        if (std::abs(exact - cut.from_centre) > 1e-6) {
            t.refuse("offset_from_centre_mm", "says another plane than offset_mm; delete the line to move the plane");
        }
        cut.from_centre = exact;
    }
    cut.makes_mm3 = t.numbers("makes_mm3");
    return cut;
}

std::vector<PlanCut> cuts_from(const Table& top, const std::string& file, Vec3 centre) {
    std::vector<PlanCut> cuts;
    if (!top.has("cut")) return cuts;
    for (const toml::node& node : top.array("cut")) {
        if (!node.is_table()) top.refuse("cut", "must be tables: [[cut]]");
        const Table t(*node.as_table(), file,
                      {"number", "piece", "path", "normal", "offset_mm", "offset_from_centre_mm", "inside_mm",
                       "volume_mm3", "makes_mm3"});
        cuts.push_back(cut_from(t, static_cast<std::int32_t>(cuts.size()) + 1, centre));
    }
    return cuts;
}

std::vector<PlanDiscard> discards_from(const Table& top, const std::string& file, std::size_t cuts) {
    std::vector<PlanDiscard> discards;
    if (!top.has("discard")) return discards;
    for (const toml::node& node : top.array("discard")) {
        if (!node.is_table()) top.refuse("discard", "must be tables: [[discard]]");
        const Table t(*node.as_table(), file, {"after", "piece", "path", "inside_mm", "volume_mm3"});
        const std::int64_t after = t.whole("after", discards.empty() ? 0 : discards.back().after);
        if (after > static_cast<std::int64_t>(cuts)) t.refuse("after", "there is no such cut");
        const auto number = static_cast<std::int32_t>(after);
        discards.push_back({piece_from(t, number + 1), number});
    }
    return discards;
}

Plan plan_from(const toml::table& root, const std::string& file) {
    const Table top(root, file, {"schema", "scan", "weights", "cut", "discard"});
    if (top.whole("schema", 1) != schema) top.refuse("schema", "this version reads schema 1");
    Plan plan;
    plan.scan = scan_from(
        Table(top.table("scan"), file,
              {"name", "sha256", "units", "scale", "centre_mm", "faces", "volume_mm3", "box_min_mm", "box_max_mm"}));
    const Table w(top.table("weights"), file, {"face_ratio", "fragility", "piece_count", "undercut"});
    plan.weights = {w.number("face_ratio"), w.number("fragility"), w.number("piece_count"), w.number("undercut")};
    plan.cuts = cuts_from(top, file, plan.scan.centre);
    plan.discards = discards_from(top, file, plan.cuts.size());
    return plan;
}

}  // namespace

std::string to_text(const Plan& plan) {
    const PlanScan& s = plan.scan;
    std::ostringstream out;
    out << first_line << ": the cuts of a segmentation, to be made again on another version of the same specimen by\n"
        << "#   qchopper segment SCAN --units UNIT --replay THIS_FILE -o NAME.qch\n"
        << "# Lengths are millimetres in the scan's own frame: coordinates of its file times unit and scale.\n"
        << "schema = " << schema << "\n\n[scan]\nname = " << quoted(s.name) << "\nsha256 = " << quoted(s.sha256)
        << "\nunits = " << quoted(name_of(s.unit)) << "\nscale = " << in_digits(s.scale)
        << "\ncentre_mm = " << in_digits(s.centre) << "\nfaces = " << s.faces
        << "\nvolume_mm3 = " << in_digits(s.volume_mm3) << "\nbox_min_mm = " << in_digits(s.box.min)
        << "\nbox_max_mm = " << in_digits(s.box.max)
        << "\n\n[weights]\nface_ratio = " << in_digits(plan.weights.face_ratio)
        << "\nfragility = " << in_digits(plan.weights.fragility)
        << "\npiece_count = " << in_digits(plan.weights.piece_count)
        << "\nundercut = " << in_digits(plan.weights.undercut) << "\n";
    for (const PlanCut& cut : plan.cuts) {
        out << "\n[[cut]]\nnumber = " << cut.number << "\npiece = " << quoted(cut.piece)
            << "\npath = " << in_words(cut.path) << "\nnormal = " << in_digits(cut.plane.normal)
            << "\noffset_mm = " << in_digits(cut.plane.offset)
            << "\noffset_from_centre_mm = " << in_digits(cut.from_centre) << "\ninside_mm = " << in_digits(cut.inside)
            << "\nvolume_mm3 = " << in_digits(cut.volume_mm3) << "\nmakes_mm3 = [";
        for (std::size_t i = 0; i < cut.makes_mm3.size(); ++i) {
            out << (i > 0 ? ", " : "") << in_digits(cut.makes_mm3[i]);
        }
        out << "]\n";
    }
    for (const PlanDiscard& discard : plan.discards) {
        out << "\n[[discard]]\nafter = " << discard.after << "\npiece = " << quoted(discard.piece)
            << "\npath = " << in_words(discard.path) << "\ninside_mm = " << in_digits(discard.inside)
            << "\nvolume_mm3 = " << in_digits(discard.volume_mm3) << "\n";
    }
    return out.str();
}

Plan plan_from_text(std::string_view text, const std::string& file) {
    try {
        return plan_from(toml::parse(text, file), file);
    } catch (const toml::parse_error& e) {
        throw InputError(InputFault::config,
                         file + ":" + std::to_string(e.source().begin.line) + ": not TOML from column " +
                             std::to_string(e.source().begin.column) +
                             " on: a value, bracket, comma or quotation mark is missing or too many",
                         "mend the plan; docs/plan-file.md explains its keys");
    }
}

bool looks_like_a_plan(std::string_view text) {
    return text.starts_with(first_line);
}

}  // namespace qchopper
