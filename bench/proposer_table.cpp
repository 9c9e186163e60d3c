// Prints the tables of docs/measurements/proposers.md: what segmentations cost with the planes that methods of regions
// propose, beside those without and those with random planes.
//
// Every run is one greedy search of eight cuts whose state is read after 1, 2, 4 and 8 of them. Runs are kept, one file
// each, so that an interrupted series is continued by the same command.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "app/engine/presets.h"
#include "base/error.h"
#include "base/text.h"
#include "bench/clock.h"
#include "bench/specimens.h"
#include "bench/table_models.h"
#include "segment/access/piece_access.h"
#include "segment/access/sampled_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/regions/methods.h"
#include "segment/regions/region_planes.h"
#include "segment/search/beam.h"
#include "segment/search/search.h"
#include "segment/simplify/simplify.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage =
    R"(bench_proposer_table [--out FOLDER] [--data DIR] [--faces N] [--small] [--print] [MODEL...]
  --out    where the runs are kept, one file each (proposer-table); those that are there are not made again
  --data   where the scans lie
  --faces  of a sample, and to how many a scan with more is simplified (20000)
  --small  the sample vertebra with 8,000 faces, to check that it runs
  --print  prints what is there and makes no run
  MODEL    of bench/table_models.h, or held out: femur-2, skull-2, vertebra-2, diplodocus; all by default
)";

constexpr double fragment_share = 1e-5;  // of the scan's volume, as the program has it
constexpr std::size_t default_faces = 20'000;
constexpr std::array presets{"thesis", "carve"};
constexpr std::array<std::size_t, 4> read_after{1, 2, 4, 8};

struct Choice {
    std::filesystem::path out = "proposer-table";
    std::filesystem::path data = default_data();
    std::vector<std::string> models;
    std::size_t faces = default_faces;
    bool is_small = false;
    bool only_prints = false;
};

// Models by which no setting of this program was chosen: a scan, and the samples stretched and turned.
const std::vector<TableModel>& held_out() {
    static const std::vector<TableModel> all{{"femur-2", "", Specimen::femur},
                                             {"vertebra-2", "", Specimen::vertebra},
                                             {"skull-2", "", Specimen::skull},
                                             {"diplodocus", "nasty/cgal_diplodocus.off", std::nullopt}};
    return all;
}

void stretch_and_turn(TriangleMesh& mesh) {
    constexpr double turn = 0.6;
    for (Vec3& p : mesh.points) {
        const Vec3 q{p.x, 0.75 * p.y, 1.3 * p.z};
        const Vec3 turned{std::cos(turn) * q.x - std::sin(turn) * q.y, std::sin(turn) * q.x + std::cos(turn) * q.y,
                          q.z};
        p = {turned.x, std::cos(turn) * turned.y - std::sin(turn) * turned.z,
             std::sin(turn) * turned.y + std::cos(turn) * turned.z};
    }
}

// After some cuts.
struct State {
    std::size_t cuts = 0;
    std::size_t pieces = 0;
    double cost = 0;
    double unreachable = 0;  // share of the scan's surface
    double to_mill = 0;      // surface of all pieces but their bases, by that of the scan
};

struct Run {
    std::vector<State> states;
    std::size_t planes = 0;  // that were proposed
    std::size_t won = 0;     // cuts by one of them, refined or not
    double proposing_s = 0;  // CPU
    double search_s = 0;     // CPU
};

std::vector<GivenPlane> random_planes(const TriangleMesh& scan) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0, 1);
    std::vector<GivenPlane> planes;
    for (std::size_t i = 0; i < max_region_planes; ++i) {
        const double z = 2 * share(random) - 1;
        const double angle = 2 * std::numbers::pi * share(random);
        const double across = std::sqrt(1 - z * z);
        const Vec3 normal{across * std::cos(angle), across * std::sin(angle), z};
        const Extent range = extent(scan, normal);
        planes.push_back({canonical({normal, range.low + share(random) * range.size()}), "random"});
    }
    return planes;
}

std::vector<GivenPlane> planes_of(const TriangleMesh& scan, const std::string& proposer) {
    if (proposer == "none") return {};
    if (proposer == "random") return random_planes(scan);
    const ScanRegions regions = scan_regions(scan, *region_method(proposer));
    const RegionPlanes found = region_planes(face_graph(regions.copy), regions.labels);
    std::vector<GivenPlane> planes;
    planes.reserve(found.planes.size());
    for (const BorderPlane& border : found.planes) {
        planes.push_back({border.plane, proposer});
    }
    return planes;
}

Run run_of(const TriangleMesh& scan, SearchSettings settings, const std::string& proposer) {
    Run run;
    const double started = process_cpu_s();
    settings.candidates.given = planes_of(scan, proposer);
    run.planes = settings.candidates.given.size();
    run.proposing_s = process_cpu_s() - started;
    settings.objectives.fragment_volume_mm3 = fragment_share * volume_mm3(scan);
    settings.stop = {};
    settings.stop.min_cuts = static_cast<int>(read_after.back());
    Segmentation segmentation = uncut(scan, settings.objectives.fragment_volume_mm3);
    sample_uncut(segmentation.pieces);
    EvaluationCache cache(settings.objectives, settings.candidates);
    double reading_s = 0;
    const auto read = [&](const Segmentation& now) {
        if (std::ranges::find(read_after, now.cuts.size()) == read_after.end()) return;
        const double reads = process_cpu_s();
        State state{now.cuts.size(), now.pieces.size(), cost(now, settings.objectives, cache), 0, 0};
        const double scan_mm2 = scan_area_mm2(now.pieces.front());
        for (const Piece& piece : now.pieces) {
            const AreaOnBase access = area_on_best_base(piece, settings.objectives.tilt_deg);
            state.unreachable += access.unreachable_mm2;
            state.to_mill += access.area_mm2;
        }
        state.unreachable /= scan_mm2;
        state.to_mill /= scan_mm2;
        run.states.push_back(state);
        reading_s += process_cpu_s() - reads;
    };
    const double searches = process_cpu_s();
    search(segmentation, settings, cache, {}, read, {});
    run.search_s = process_cpu_s() - searches - reading_s;
    run.won = static_cast<std::size_t>(std::ranges::count_if(
        segmentation.cuts, [&](const Cut& cut) { return !proposer_of(cut.chosen, settings.candidates).empty(); }));
    return run;
}

std::filesystem::path file_of(const Choice& choice, const std::string& model, const std::string& preset_name,
                              const std::string& proposer) {
    return choice.out / (model + "." + preset_name + "." + proposer + ".txt");
}

void write_run(const std::filesystem::path& file, const Run& run) {
    std::ofstream out(file);
    out.precision(10);
    out << run.planes << ' ' << run.won << ' ' << run.proposing_s << ' ' << run.search_s << '\n';
    for (const State& s : run.states) {
        out << s.cuts << ' ' << s.pieces << ' ' << s.cost << ' ' << s.unreachable << ' ' << s.to_mill << '\n';
    }
}

std::optional<Run> read_run(const std::filesystem::path& file) {
    std::ifstream in(file);
    Run run;
    if (!(in >> run.planes >> run.won >> run.proposing_s >> run.search_s)) return std::nullopt;
    State s;
    while (in >> s.cuts >> s.pieces >> s.cost >> s.unreachable >> s.to_mill) run.states.push_back(s);
    return run;
}

std::vector<std::string> proposers() {
    std::vector<std::string> names{"none", "random"};
    names.reserve(names.size() + region_methods().size());
    for (const RegionMethod& method : region_methods()) names.emplace_back(method.name);
    return names;
}

std::optional<TriangleMesh> scan_of(const Choice& choice, const std::string& name) {
    const std::size_t faces = choice.is_small ? 8'000 : choice.faces;
    const bool is_held_out = std::ranges::find(held_out(), name, &TableModel::name) != held_out().end();
    const std::vector<TableModel>& list = is_held_out ? held_out() : table_models();
    const auto model = std::ranges::find(list, name, &TableModel::name);
    if (model == list.end()) return std::nullopt;
    std::optional<TriangleMesh> mesh = mesh_of(*model, choice.data, faces);
    if (mesh && mesh->triangles.size() > faces) simplify(*mesh, {std::nullopt, faces, true});
    if (mesh && is_held_out) stretch_and_turn(*mesh);
    return mesh;
}

void make_runs(const Choice& choice, const std::string& model) {
    std::optional<TriangleMesh> scan;
    for (const char* preset_name : presets) {
        for (const std::string& proposer : proposers()) {
            const std::filesystem::path file = file_of(choice, model, preset_name, proposer);
            if (read_run(file)) continue;
            if (!scan) scan = scan_of(choice, model);
            if (!scan) return;
            const Run run = run_of(*scan, *preset(preset_name), proposer);
            write_run(file, run);
            std::cerr << model << ", " << preset_name << ", " << proposer << ": " << run.planes << " planes, "
                      << run.won << " of " << (run.states.empty() ? 0 : run.states.back().cuts) << " cuts, "
                      << fixed(run.proposing_s, 1) << " + " << fixed(run.search_s, 1) << " s" << std::endl;
        }
    }
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n == 0 ? std::nan("") : 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

// Where a search ends at no cost at all, the other one is as good or infinitely worse.
double ratio(double value, double to) {
    constexpr double none = 1e-12;
    if (to > none) return value / to;
    return value > none ? std::numeric_limits<double>::infinity() : 1;
}

// Of one preset: medians, over the models that have all runs, of the ratio to the run without proposed planes.
void print_table(const Choice& choice, const std::vector<std::string>& models, const char* preset_name,
                 const std::string& title) {
    std::cout << "\n"
              << title << ", preset " << preset_name << "\n\n"
              << "| proposer | cost, 1 cut | 2 | 4 | 8 | out of reach, 8 cuts | to mill | pieces | CPU | planes | cuts "
                 "won |\n"
              << "|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const std::string& proposer : proposers()) {
        std::map<std::size_t, std::vector<double>> costs;
        std::vector<double> reach;
        std::vector<double> mill;
        std::vector<double> pieces;
        std::vector<double> cpu;
        std::vector<double> planes;
        std::size_t won = 0;
        std::size_t cuts = 0;
        for (const std::string& model : models) {
            const std::optional<Run> none = read_run(file_of(choice, model, preset_name, "none"));
            const std::optional<Run> run = read_run(file_of(choice, model, preset_name, proposer));
            if (!none || !run || run->states.empty() || run->states.size() != none->states.size()) continue;
            for (std::size_t i = 0; i < run->states.size(); ++i) {
                costs[run->states[i].cuts].push_back(ratio(run->states[i].cost, none->states[i].cost));
            }
            const State& last = run->states.back();
            const State& before = none->states.back();
            if (before.unreachable > 0) reach.push_back(last.unreachable / before.unreachable);
            mill.push_back(last.to_mill / before.to_mill);
            pieces.push_back(static_cast<double>(last.pieces) / static_cast<double>(before.pieces));
            cpu.push_back((run->proposing_s + run->search_s) / none->search_s);
            planes.push_back(static_cast<double>(run->planes));
            won += run->won;
            cuts += last.cuts;
        }
        if (cpu.empty()) continue;
        std::cout << "| " << proposer;
        for (const std::size_t after : read_after) std::cout << " | " << fixed(median(costs[after]), 3);
        std::cout << " | " << fixed(median(reach), 3) << " | " << fixed(median(mill), 3) << " | "
                  << fixed(median(pieces), 2) << " | " << fixed(median(cpu), 2) << " | " << fixed(median(planes), 0)
                  << " | " << won << " of " << cuts << " |\n";
    }
}

bool parse(int argc, char** argv, Choice& choice) {
    for (int i = 1; i < argc; ++i) {
        const std::string option = argv[i];
        if (option == "--small") {
            choice.is_small = true;
        } else if (option == "--print") {
            choice.only_prints = true;
        } else if ((option == "--out" || option == "--data") && i + 1 < argc) {
            (option == "--out" ? choice.out : choice.data) = argv[++i];
        } else if (option == "--faces" && i + 1 < argc) {
            choice.faces = std::max(1'000UL, std::strtoul(argv[++i], nullptr, 10));
        } else if (option.starts_with("--")) {
            return false;
        } else {
            choice.models.push_back(option);
        }
    }
    return true;
}

void make_table(Choice choice) {
    std::vector<std::string> models;
    std::vector<std::string> others;
    models.reserve(table_models().size());
    others.reserve(held_out().size());
    for (const TableModel& model : table_models()) models.push_back(model.name);
    for (const TableModel& model : held_out()) others.push_back(model.name);
    if (choice.is_small) choice.models = {"vertebra"};
    if (choice.models.empty()) {
        choice.models = models;
        choice.models.insert(choice.models.end(), others.begin(), others.end());
    }
    std::filesystem::create_directories(choice.out);
    if (!choice.only_prints) {
        for (const std::string& model : choice.models) make_runs(choice, model);
    }
    for (const char* preset_name : presets) {
        print_table(choice, models, preset_name, "Models");
        print_table(choice, others, preset_name, "Held out");
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
        make_table(choice);
    } catch (const InputError& error) {
        std::cerr << error.what() << ". To do: " << error.to_do.text << std::endl;
        return 65;
    }
    return 0;
}
