// One table per stock and, for programs, one per object of the JSON. O(blocks log blocks).

#include "cam/job/sheet/saw_list.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "base/enum_names.h"
#include "base/json_fields.h"
#include "base/text.h"
#include "cam/job/sheet/sheet_html.h"
#include "cam/job/ticket.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

enum class Axis : std::uint8_t { x, y, z };
constexpr auto names_of(Axis) {
    return EnumNames<Axis, 3>{{{Axis::x, "x"}, {Axis::y, "y"}, {Axis::z, "z"}}};
}

std::string name_of(std::size_t axis) {
    const auto a = static_cast<Axis>(axis);
    return names_of(a)(a);
}

// Where there is no spoil layer, the base of a piece that the saw alone makes is a face of the stock.
bool is_base_sawn(const SawnBlock& block) {
    return std::any_of(block.cuts.begin(), block.cuts.end(), [&](const SawCuts& cut) {
        return cut.axis == 2 && cut.count > static_cast<int>(sawn_along(block.flush, 2)) && !block.job;
    });
}

// The glue faces that the cuts across an axis make.
std::vector<std::string> faces_across(const SawnBlock& block, std::size_t axis) {
    std::vector<std::string> names;
    for (const GlueFace& face : block.glue_faces) {
        if (axis_of(face.face) == axis) names.emplace_back(names_of(face.face)(face.face));
    }
    if (axis == 2 && is_base_sawn(block)) names.emplace_back("base");
    return names;
}

}  // namespace

template <class V, Of<Stock> T>
void fields(V& v, T& stock) {
    v("name", stock.name);
    v("material", stock.material);
    v("size_mm", stock.size);
    v("kerf_mm", stock.kerf);
}

template <class V, Of<GlueFace> T>
void fields(V& v, T& face) {
    v("face", face.face);
    v("caps", face.cuts);
    v("area_mm2", face.area_mm2);
    v("glued_to", face.neighbours);
}

template <class V, Of<SawCuts> T>
void fields(V& v, T& cut) {
    v.written("axis", [&] { return static_cast<Axis>(cut.axis); });
    v("from_mm", cut.from);
    v("to_mm", cut.length);
    v("count", cut.count);
    v("offcut_mm", cut.offcut);
}

template <class V, Of<SawnBlock> T>
void fields(V& v, T& block) {
    v("piece", block.piece);
    v("job", block.job);
    v.object("stock", [&](auto& stock) {
        stock("number", block.stock_number);
        fields(stock, block.stock);
    });
    v("block_mm", block.size);
    v("saw", block.cuts);
    v("glue_faces", block.glue_faces);
    v("base_glued_to", block.at_base);
}

template <class V, Of<SawList> T>
void fields(V& v, T& list) {
    v.constant("format", "qchopper saw list", "is not a qchopper saw list");
    v.version("schema", 1);
    v("order", list.order);
    v("accuracy_mm", list.accuracy);
    v("blocks", list.blocks);
}

namespace {

using namespace sheet;

// Lengths along an axis with a glue face to tenths, others as they are.
std::string length_text(const SawnBlock& block, std::size_t axis, double mm) {
    return faces_across(block, axis).empty() ? significant(mm, 6) : fixed(mm, 1);
}

std::string cuts_text(const SawnBlock& block) {
    std::string text;
    for (const SawCuts& cut : block.cuts) {
        const std::vector<std::string> faces = faces_across(block, cut.axis);
        if (!text.empty()) text += "; ";
        text +=
            name_of(cut.axis) + " from " + significant(cut.from, 6) + " to " + length_text(block, cut.axis, cut.length);
        if (cut.count > 1) text += ", both ends";
        std::string names;
        for (const std::string& face : faces) names += (names.empty() ? "" : ", ") + face;
        if (!names.empty()) text += ": glue face " + names;
    }
    return text;
}

std::string glued_text(const SawnBlock& block) {
    std::string text;
    for (const GlueFace& face : block.glue_faces) {
        text += (text.empty() ? "" : "; ") + std::string(names_of(face.face)(face.face)) + ": " +
                list_of_pieces(face.neighbours);
    }
    if (!block.at_base.empty())
        text += (text.empty() ? "" : "; ") + std::string("base: ") + list_of_pieces(block.at_base);
    return text.empty() ? "-" : text;
}

std::string offcuts_text(const SawnBlock& block) {
    std::string text;
    for (const SawCuts& cut : block.cuts) {
        if (cut.offcut) text += (text.empty() ? "" : ", ") + size_text(*cut.offcut);
    }
    return text.empty() ? "-" : text;
}

std::string stock_section(std::span<const SawnBlock> blocks) {
    const Stock& stock = blocks.front().stock;
    Rows rows{{word("piece"), word("job"), word("block, x x y x z"), word("cuts, in this order"), word("glued to"),
               word("offcuts")}};
    for (const SawnBlock& block : blocks) {
        rows.push_back({word(block.piece), word(block.job ? *block.job : "sawn only"),
                        word(size_text(block.size, block.flush)), word(cuts_text(block)), word(glued_text(block)),
                        word(offcuts_text(block))});
    }
    return section("Stock \"" + stock.name + "\" (" + to_word(stock.material) + "), " + size_text(stock.size) +
                       " mm, saw cut " + significant(stock.kerf, 6) + " mm: " + counted(blocks.size(), "block"),
                   table(rows));
}

std::vector<double> settings_of(const SawnBlock& block) {
    std::vector<double> settings;
    for (const SawCuts& cut : block.cuts) settings.push_back(cut.length);
    return settings;
}

}  // namespace

std::optional<SawnBlock> sawn_block(const std::string& piece, const std::optional<std::string>& job, const Setup& setup,
                                    std::span<const JobCap> caps, const Cell& cell) {
    if (!is_sawn_down(setup)) return std::nullopt;
    const StockBlock& of = setup.block;
    const Stock& stock = cell.stock[of.stock];
    const double parted = job ? 0 : setup.spoil;
    SawnBlock block{piece,
                    job,
                    of.stock,
                    stock,
                    of.size,
                    setup.flush_faces(),
                    {},
                    glue_faces(setup, caps),
                    neighbours_at_base(setup, caps)};
    block.size.z -= parted;
    block.cuts = saw_cuts(stock, of.size, of.offcuts, block.flush, parted);
    return block;
}

SawList saw_list(std::string order, double accuracy, std::vector<SawnBlock> blocks) {
    const auto key = [](const SawnBlock& block) {
        return std::tuple(block.stock_number, settings_of(block), block.piece);
    };
    std::sort(blocks.begin(), blocks.end(), [&](const SawnBlock& a, const SawnBlock& b) { return key(a) < key(b); });
    return {std::move(order), accuracy, std::move(blocks)};
}

std::string saw_list_html(const SawList& list) {
    std::string body = page_begin + ("<h1>" + svg_text("Saw list: " + list.order) + "</h1>\n") +
                       paragraph(
                           "Lengths are in mm. x, y and z are those of the block as it stands on the table, z up: "
                           "write piece, top and +x on each block. Cut in the order of the row; \"both ends\" takes "
                           "two cuts. Glue faces come last, square to the underside and to each other. One that is "
                           "more than " +
                           significant(list.accuracy, 3) +
                           " mm off is sawn again; a glue face is never milled. Each block is cut from a stock of "
                           "its own: nothing is packed, and an offcut that is large enough serves as well.");
    const std::span<const SawnBlock> all(list.blocks);
    for (std::size_t from = 0, to = 0; from < all.size(); from = to) {
        while (to < all.size() && all[to].stock_number == all[from].stock_number) ++to;
        body += stock_section(all.subspan(from, to - from));
    }
    return document("Saw list: " + list.order, body + page_end);
}

std::string saw_list_json(const SawList& list) {
    return json_values::to_document(list);
}

}  // namespace qchopper
