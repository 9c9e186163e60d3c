// Prints the table of docs/measurements/setups.md: what share of the surface of the pieces of six models no tool
// reaches, in the four ready cells, with 1, 2, 4 and 8 directions, on the bases that are chosen and on those of the
// thesis.

#include <algorithm>
#include <array>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/text.h"
#include "bench/choice.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/stock_fit.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/search/search.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_setup_table [--small] [--data DIR] [--only MODEL]...
  --small  the vertebra alone
  --data   where bunny_bun_zipper.ply, ct_head_371k.ply and gorilla_skull_159k.ply lie
  --only   bunny, ct_head, gorilla, vertebra, femur or skull, or a cell; all of a kind if none of it is named
)";

constexpr std::array counts{1, 2, 4, 8};  // of directions
constexpr std::array cells{"kr120-r2500-pro-rotary", "kr60-ha", "irb6640-185-2.8", "gantry-3axis"};
constexpr std::size_t samples = 2000;            // per piece
constexpr double map_cell = 2;                   // mm
constexpr double debris_share = 0.001;           // of the volume of the scan
constexpr const char* cell_of_cuts = "kr60-ha";  // with the smallest blocks

struct Model {
    std::string name;
    std::string file;            // empty: the specimen
    double mm_per_unit = 1;      // of the file
    double longest_side_mm = 0;  // 0: as it is
    std::optional<Specimen> specimen;
};

const std::vector<Model>& models() {
    static const std::vector<Model> all{{"bunny", "bunny_bun_zipper.ply", 1000, 1500, std::nullopt},
                                        {"ct_head", "ct_head_371k.ply", 1, 2000, std::nullopt},
                                        {"gorilla", "gorilla_skull_159k.ply", 1, 1000, std::nullopt},
                                        {"vertebra", "", 1, 0, Specimen::vertebra},
                                        {"femur", "", 1, 0, Specimen::femur},
                                        {"skull", "", 1, 0, Specimen::skull}};
    return all;
}

std::optional<TriangleMesh> mesh_of(const Model& model, const Choice& choice) {
    if (model.specimen) return sample(*model.specimen, {});
    const auto read = scan(choice.data / model.file, model.mm_per_unit);
    if (!read) return std::nullopt;
    TriangleMesh mesh = *read;
    const Vec3 size = bounds(mesh).size();
    for (Vec3& p : mesh.points) p = (model.longest_side_mm / std::max({size.x, size.y, size.z})) * p;
    return mesh;
}

// The plane through the middle of the longest side of the oriented box.
Plane middle_of(const Piece& piece) {
    const OrientedBox box = oriented_box(piece.mesh->points);
    return canonical({box.axis[0], (box.min.x + box.max.x) / 2});
}

// Three cuts are chosen by the search. What does not fit the cell then is halved across its longest side, as an
// operator would by hand; debris is left out.
Segmentation cut_to_fit(const TriangleMesh& mesh, const Cell& cell) {
    SearchSettings settings;
    settings.objectives.fragment_volume_mm3 = debris_share * volume_mm3(mesh);
    settings.stop.min_cuts = 3;
    const double fragment_volume_mm3 = settings.objectives.fragment_volume_mm3;
    Segmentation s = uncut(mesh, fragment_volume_mm3);
    EvaluationCache cache(settings.objectives, settings.candidates);
    search(s, settings, cache, {}, [](const Segmentation&) {}, {});
    while (true) {
        const auto piece =
            std::find_if(s.pieces.begin(), s.pieces.end(), [&](const Piece& p) { return !fits_cell(p, cell); });
        if (piece == s.pieces.end()) return s;
        Cut cut;
        cut.number = static_cast<std::int32_t>(s.cuts.size()) + 1;
        cut.piece = piece->name;
        cut.chosen.plane = middle_of(*piece);
        if (!apply(s, cut, fragment_volume_mm3)) return s;
    }
}

struct Area {
    double whole_mm2 = 0;
    double unreachable_mm2 = 0;
    double holder_mm2 = 0;  // of it
    double all_mm2 = 0;     // out of reach of all directions that can be held, by samples
    void add(const Setup& setup) {
        whole_mm2 += setup.access.area_mm2;
        holder_mm2 += setup.access.holder_mm2;
        all_mm2 += setup.access.all_directions_share * setup.access.area_mm2;
        unreachable_mm2 += setup.access.unreachable_mm2();
    }
    void add(const Area& other) {
        whole_mm2 += other.whole_mm2;
        unreachable_mm2 += other.unreachable_mm2;
        holder_mm2 += other.holder_mm2;
        all_mm2 += other.all_mm2;
    }
    std::string percent(double mm2) const { return fixed(whole_mm2 > 0 ? 100 * mm2 / whole_mm2 : 0, 1); }
    std::string percent() const { return percent(unreachable_mm2); }
};

struct PieceResult {
    std::array<Area, counts.size()> chosen;
    std::array<Area, counts.size()> thesis;  // on the base with the least undercut
    std::string why_not;                     // no setup: the sentence of the program
};

// The base with the least undercut of those whose block fits into the cell; the lowest number of equal ones.
int base_of_thesis(const std::vector<Setup>& setups, const Cell& cell) {
    const auto key = [&](const Setup& s) {
        return std::tuple(!check_stock_fit(s, cell).fits(), s.undercut, s.base_number);
    };
    return std::min_element(setups.begin(), setups.end(),
                            [&](const Setup& a, const Setup& b) { return key(a) < key(b); })
        ->base_number;
}

PieceResult result_of(const Piece& piece, const Cell& cell) {
    PieceResult result;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        SetupOptions options;
        if (i > 0 && !cell.machine->robot) {  // a gantry has one direction
            result.chosen[i] = result.chosen[0];
            result.thesis[i] = result.thesis[0];
            continue;
        }
        options.max_directions = counts[i];
        options.samples = samples;
        options.map = {.cell = map_cell, .stock_points = 1U << 16U};
        const std::vector<Setup> setups = choose_setup(piece, cell, options).setups;
        const StockFit stock_fit = check_stock_fit(setups.front(), cell);
        if (!stock_fit.fits()) {
            result.why_not = describe_stock_fit(piece.name, stock_fit);
            return result;
        }
        result.chosen[i].add(setups.front());
        options.base = base_of_thesis(setups, cell);
        result.thesis[i].add(*options.base == setups.front().base_number
                                 ? setups.front()
                                 : choose_setup(piece, cell, options).setups.front());
    }
    return result;
}

void print_row(const Model& model, const Segmentation& s, const Cell& cell) {
    std::vector<PieceResult> results(s.pieces.size());
    parallel_for(0, results.size(), [&](std::size_t i) { results[i] = result_of(s.pieces[i], cell); });
    std::size_t fitting = 0;
    PieceResult sum;
    for (const PieceResult& r : results) {
        if (!r.why_not.empty()) {
            std::cerr << model.name << ", " << cell.name << ": " << r.why_not << std::endl;
            continue;
        }
        ++fitting;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            sum.chosen[i].add(r.chosen[i]);
            sum.thesis[i].add(r.thesis[i]);
        }
    }
    std::cout << "| " << model.name << " | " << s.cuts.size() << " | " << fitting << " of " << results.size() << " | "
              << cell.name;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        std::cout << " | " << sum.chosen[i].percent() << " (" << sum.thesis[i].percent() << ")";
    }
    const Area& last = sum.chosen.back();
    std::cout << " | " << last.percent(last.holder_mm2) << " | " << last.percent(last.all_mm2) << " |" << std::endl;
}

// Whether a name is wanted among those of its kind.
template <class Names>
bool wants(const Choice& choice, const std::string& name, const Names& kind) {
    const bool is_any_named =
        std::any_of(kind.begin(), kind.end(), [&](const std::string& n) { return choice.only.contains(n); });
    return !is_any_named || choice.only.contains(name);
}

void print_table(const Choice& choice) {
    std::vector<std::string> names;
    for (const Model& model : models()) names.push_back(model.name);
    const std::filesystem::path folder = std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells";
    std::cout << "| model | cuts | pieces that fit | cell | 1 | 2 | 4 | 8 | holder | all |\n"
                 "|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Model& model : models()) {
        if (!wants(choice, model.name, names) || (choice.is_small && model.name != "vertebra")) continue;
        const std::optional<TriangleMesh> mesh = mesh_of(model, choice);
        if (!mesh) continue;
        const Segmentation s = cut_to_fit(*mesh, read_cell(folder / (std::string(cell_of_cuts) + ".toml")));
        std::cerr << model.name << ": " << s.cuts.size() << " cuts, " << s.pieces.size() << " pieces" << std::endl;
        for (const std::string name : cells) {
            if (wants(choice, name, cells)) print_row(model, s, read_cell(folder / (name + ".toml")));
        }
    }
}

}  // namespace

int main(int argc, char** argv) {
    Choice choice;
    if (!parse(argc, argv, choice)) {
        std::cerr << usage;
        return 64;
    }
    try {
        print_table(choice);
    } catch (const InputError& error) {
        std::cerr << error.what() << ". To do: " << error.to_do.text << std::endl;
        return 65;
    }
    return 0;
}
