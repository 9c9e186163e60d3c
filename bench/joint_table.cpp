// Prints the table of docs/measurements/joints.md: how well the pieces of five models can be joined after the same
// number of cuts by several presets, and what no tilting tool reaches of them, judged on the really cut pieces.

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/presets.h"
#include "base/error.h"
#include "base/text.h"
#include "bench/clock.h"
#include "bench/reach_judge.h"
#include "bench/specimens.h"
#include "bench/table_models.h"
#include "segment/access/sampled_piece.h"
#include "segment/joint/piece_joints.h"
#include "segment/joint/seam.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/seam_cost.h"
#include "segment/search/search.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage =
    R"(bench_joint_table [--model NAME]... [--method NAME]... [--beam B]... [--cuts N] [--connector W] [--seam W] [--data DIR] [--small]
  --model      vertebra, bunny, igea, gorilla, ct_head_371k; all by default
  --method     bunny, chopper, carve, joined (carve with connector and seam); all by default
  --beam       1 and 4 by default
  --cuts       12 by default
  --connector  weight of connector in the method joined, 0.3 by default
  --seam       weight of seam in the method joined, 0.1 by default
  --data       where the scans lie
  --small      the sample vertebra with 8,000 faces and two cuts, to check that it runs
)";

constexpr double fragment_share = 1e-5;  // of the scan's volume, as the program has it
constexpr Vec3 print_volume{400, 400, 400};
constexpr double tilt_deg = 60;

struct TableChoice {
    std::filesystem::path data = default_data();
    std::vector<std::string> models;
    std::vector<std::string> methods;
    std::vector<std::size_t> beams;
    int cuts = 12;
    double connector = 0.3;
    double seam = 0.1;
    std::size_t specimen_faces = 60'000;
    std::size_t samples = 20'000;  // of the search, and of the judge over all pieces
};

// False for an unknown option, a missing value and a value that is no number.
bool parse_table(int argc, char** argv, TableChoice& choice) {
    try {
        for (int i = 1; i < argc; ++i) {
            const std::string option = argv[i];
            if (option == "--small") {
                choice.models = {"vertebra"};
                choice.cuts = 2;
                choice.specimen_faces = 8000;
                choice.samples = 2000;
                continue;
            }
            if (++i == argc) return false;
            const std::string value = argv[i];
            if (option == "--model")
                choice.models.push_back(value);
            else if (option == "--method")
                choice.methods.push_back(value);
            else if (option == "--beam")
                choice.beams.push_back(std::stoul(value));
            else if (option == "--cuts")
                choice.cuts = std::stoi(value);
            else if (option == "--connector")
                choice.connector = std::stod(value);
            else if (option == "--seam")
                choice.seam = std::stod(value);
            else if (option == "--data")
                choice.data = value;
            else
                return false;
        }
    } catch (const std::logic_error&) {  // of std::stoi and its like
        return false;
    }
    if (choice.models.empty()) choice.models = {"vertebra", "bunny", "igea", "gorilla", "ct_head_371k"};
    if (choice.methods.empty()) choice.methods = {"bunny", "chopper", "carve", "joined"};
    if (choice.beams.empty()) choice.beams = {1, 4};
    return true;
}

// Nothing for an unknown name.
std::optional<SearchSettings> settings_of(const std::string& method, const TableChoice& choice) {
    std::optional<SearchSettings> settings = preset(method == "joined" ? "carve" : method);
    if (!settings) return std::nullopt;
    if (method == "joined") {
        settings->objectives.weights.connector = choice.connector;
        settings->objectives.weights.seam = choice.seam;
    }
    settings->objectives.tilt_deg = tilt_deg;
    settings->objectives.print_volume = print_volume;
    settings->stop = {};
    settings->stop.min_cuts = choice.cuts;
    return settings;
}

Segmentation segmented(const TriangleMesh& scan, SearchSettings settings, std::size_t samples) {
    settings.objectives.fragment_volume_mm3 = fragment_share * volume_mm3(scan);
    Segmentation segmentation = uncut(scan, settings.objectives.fragment_volume_mm3);
    if (settings.takes_samples()) sample_uncut(segmentation.pieces, {}, samples);
    if (settings.candidates.takes_symmetry) {
        settings.candidates.symmetry = symmetry_plane(scan);
        if (settings.candidates.symmetry) settings.objectives.symmetry_plane = settings.candidates.symmetry->plane;
    }
    if (settings.measures_scan()) segmentation.scan = measure_scan(segmentation);
    if (settings.objectives.needs_seam()) find_seam_costs(segmentation.pieces);
    EvaluationCache cache(settings.objectives, settings.candidates);
    search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
    return segmentation;
}

// What no tool reaches, as a share of the scan's surface.
double unreachable_share(const std::vector<Piece>& pieces, std::size_t samples) {
    double scan_mm2 = 0;
    for (const Piece& piece : pieces) scan_mm2 += uncut_area_mm2(*piece.mesh);
    double out_of_reach = 0;
    for (const Piece& piece : pieces) {
        JudgeOptions judging;
        judging.tilt_deg = tilt_deg;
        const double by_area = static_cast<double>(samples) * uncut_area_mm2(*piece.mesh) / scan_mm2;
        judging.samples = std::max<std::size_t>(samples / 20, static_cast<std::size_t>(by_area));
        out_of_reach += judge(piece, judging).unreachable_mm2;
    }
    return out_of_reach / scan_mm2;
}

std::size_t with_two(const std::vector<Piece>& pieces, std::vector<DowelSize> sizes) {
    JointSettings settings;
    settings.sizes = std::move(sizes);
    const std::vector<PieceJoint> joints = piece_joints(pieces, settings);
    return static_cast<std::size_t>(
        std::count_if(joints.begin(), joints.end(), [](const PieceJoint& j) { return j.dowels.size() >= 2; }));
}

void print_row(const std::string& name, const std::string& method, std::size_t beam, const Segmentation& segmentation,
               const TableChoice& choice, double seconds) {
    const std::vector<Piece>& pieces = segmentation.pieces;
    Objectives printed;
    printed.print_volume = print_volume;
    double boxes = 0;
    for (const Piece& piece : pieces) boxes += print_boxes(oriented_box(piece.mesh->points).size(), printed);
    std::cout << "| " << name << " | " << method << " " << beam << " | " << pieces.size() << " | "
              << fixed(100 * unreachable_share(pieces, choice.samples), 2) << " | "
              << contacts_of(pieces, JointSettings{}.min_mm2).size() << " | ";
    for (const DowelSize& size : default_dowels()) std::cout << with_two(pieces, {size}) << " | ";
    std::cout << with_two(pieces, default_dowels()) << " | " << fixed(seam_length(pieces).visible_mm / 1000, 2) << " | "
              << fixed(boxes, 0) << " | " << fixed(seconds, 0) << " |" << std::endl;
}

void make_table(const TableChoice& choice) {
    std::cout << "| model | preset and beam | pieces | unreachable % | joints | with two of 8 mm | 6 mm | 4 mm | of "
                 "any size | visible seam, m | boxes | s |\n|---|---|---|---|---|---|---|---|---|---|---|---|"
              << std::endl;
    for (const TableModel& model : table_models()) {
        if (std::find(choice.models.begin(), choice.models.end(), model.name) == choice.models.end()) continue;
        const std::optional<TriangleMesh> mesh = mesh_of(model, choice.data, choice.specimen_faces);
        if (!mesh) continue;
        for (const std::string& method : choice.methods) {
            for (const std::size_t beam : choice.beams) {
                SearchSettings settings = *settings_of(method, choice);
                settings.beam = beam;
                const double started = wall_s();
                const Segmentation segmentation = segmented(*mesh, settings, choice.samples);
                print_row(model.name, method, beam, segmentation, choice, wall_s() - started);
            }
        }
    }
}

bool knows_methods(const TableChoice& choice) {
    return std::all_of(choice.methods.begin(), choice.methods.end(),
                       [&](const std::string& method) { return settings_of(method, choice).has_value(); });
}

}  // namespace

int main(int argc, char** argv) {
    TableChoice choice;
    if (!parse_table(argc, argv, choice) || !knows_methods(choice)) {
        std::cerr << usage;
        return 64;
    }
    try {
        make_table(choice);
    } catch (const InputError& error) {
        std::cerr << error.what() << ". To do: " << error.to_do.text << std::endl;
        return 65;
    }
    return 0;
}
