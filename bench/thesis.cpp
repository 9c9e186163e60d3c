// The four cases of Nicholson 2016, chapter 5, with the thesis' settings: table 5.1 beside ours, as Markdown.
//
// Only the bunny is public. Meshes of the same size stand in for the other three.

#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>

#include "app/engine/presets.h"
#include "base/error.h"
#include "base/parallel.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/specimens.h"
#include "segment/mesh/measure.h"
#include "segment/picture/exploded.h"
#include "segment/search/search.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

struct Case {
    const char* name;
    const char* mesh;
    std::array<double, 3> minutes;  // of the thesis: first, second, third cut
};
constexpr Case bunny{"bunny", "the same bunny", {0.65, 0.24, 0.15}};
constexpr Case femur{"femur", "sample femur", {5.47, 3.76, 2.28}};
constexpr Case vertebrae{"vertebrae", "sample vertebra", {17.67, 10.92, 8.44}};
constexpr Case skull{"skull", "sample skull", {22.17, 22.47, 15.31}};
constexpr Case head{"skull", "CT head", {22.17, 22.47, 15.31}};

struct Result {
    Case which;
    std::size_t faces = 0;
    Segmentation segmentation;
    SearchEnd end;
    std::vector<double> wall;  // per cut, seconds: from the last cut, or the mesh in memory, to this one
    std::string folder_name() const {
        std::string name = std::string(which.name) + "-" + which.mesh;
        for (char& c : name) c = c == ' ' ? '-' : c;
        return name;
    }
};

Result segment(const Case& which, const TriangleMesh& scan) {
    std::cerr << which.mesh << ": " << scan.triangles.size() << " faces" << std::endl;
    Result result{which, scan.triangles.size(), {}, {}, {}};
    SearchSettings settings = *preset(which.name);
    settings.objectives.fragment_volume_mm3 = 1e-5 * volume_mm3(scan);
    double before = wall_s();
    result.segmentation = uncut(scan, settings.objectives.fragment_volume_mm3);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const auto on_round = [&](const Segmentation& now) {
        result.wall.push_back(wall_s() - before);
        before = wall_s();
        std::cerr << "cut " << now.cuts.size() << ": " << time_text(result.wall.back()) << std::endl;
    };
    result.end = search(result.segmentation, settings, cache, {}, on_round, Context{});
    return result;
}

void draw(const Result& result, const fs::path& folder) {
    const std::vector<Piece>& pieces = result.segmentation.pieces;
    write_file(folder / (result.folder_name() + ".png"), render_png(coloured(pieces)));
    const std::vector<Vec3> apart = exploded_shifts(pieces);
    write_file(folder / (result.folder_name() + "-exploded.png"), render_png(coloured(pieces, apart)));
}

// As table 5.1 has them.
std::string minutes(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

std::string three(const std::vector<double>& seconds) {
    std::string text;
    for (std::size_t i = 0; i < 3; ++i) {
        text += (i > 0 ? " | " : "") + (i < seconds.size() ? time_text(seconds[i]) : std::string("-"));
    }
    return text;
}

void print_table(const std::vector<Result>& results) {
    std::cout << "| case | ours | faces | thesis, min: first | second | third | ours: first | second | third | first, "
                 "times faster |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Result& r : results) {
        const auto& m = r.which.minutes;
        std::cout << "| " << r.which.name << " | " << r.which.mesh << " | " << r.faces << " | " << minutes(m[0])
                  << " | " << minutes(m[1]) << " | " << minutes(m[2]) << " | " << three(r.wall) << " | "
                  << (r.wall.empty() ? "-" : number_text(60 * m[0] / r.wall[0])) << " |\n";
    }
}

void print_cuts(const Result& r) {
    const Segmentation& s = r.segmentation;
    double sum = 0;
    for (const double t : r.wall) sum += t;
    std::cout << "\n### " << r.which.name << ": " << r.which.mesh << "\n\n"
              << s.pieces.size() << " pieces and " << s.fragments.size() << " fragments after " << s.cuts.size()
              << " cuts in " << time_text(sum) << "; " << r.end.sentence << ".\n\nFaces of the pieces:";
    for (const Piece& piece : s.pieces) std::cout << " " << piece.name << " " << piece.mesh->triangles.size();
    std::cout << ".\n\n| cut | piece | makes | face ratio | fragility | piece count | undercut | total | time |\n"
                 "|---|---|---|---|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < s.cuts.size(); ++i) {
        const Cut& cut = s.cuts[i];
        const Terms& t = cut.chosen.terms;
        std::string made;
        for (const std::string& name : cut.pieces) made += (made.empty() ? "" : ", ") + name;
        std::cout << "| " << cut.number << " | " << cut.piece << " | " << made << " | " << number_text(t.face_ratio)
                  << " | " << number_text(t.fragility) << " | " << number_text(t.piece_count) << " | "
                  << number_text(t.undercut) << " | " << number_text(t.total) << " | " << time_text(r.wall[i])
                  << " |\n";
    }
    std::cout << "\nPictures: " << r.folder_name() << ".png, " << r.folder_name() << "-exploded.png\n";
}

int run(const fs::path& data, const fs::path& out) {
    fs::create_directories(out);
    std::vector<Result> results;
    const auto run_case = [&](const Case& which, const TriangleMesh& mesh) {
        results.push_back(segment(which, mesh));
        draw(results.back(), out);
    };
    const auto make = [](Specimen specimen, std::size_t faces) { return sample(specimen, {faces, 0}); };
    if (const auto mesh = scan(data / "bunny_bun_zipper.ply", 1000)) run_case(bunny, *mesh);
    run_case(femur, make(Specimen::femur, 644'620));
    run_case(vertebrae, make(Specimen::vertebra, 1'823'276));
    run_case(skull, make(Specimen::skull, 1'881'226));
    if (const auto mesh = scan(data / "ct_head_1912k.ply", 1)) run_case(head, *mesh);
    print_table(results);
    for (const Result& r : results) print_cuts(r);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2 || argc > 3) {
        std::cerr << "bench_thesis OUT_FOLDER [DATA_FOLDER]\n";
        return 64;
    }
    try {
        return run(argc == 3 ? fs::path(argv[2]) : default_data(), argv[1]);
    } catch (const InputError& e) {
        std::cerr << e.what() << std::endl;
        return 65;
    }
}
