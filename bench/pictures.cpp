// Measures the two pictures of a project, uncut, beside what they cannot do without: Embree's tree, one coherent ray
// per pixel twelve times, and the PNG. CPU time of all threads; every ratio is between figures of this run.

#include "segment/picture/picture.h"

#include <cmath>
#include <string>
#include <vector>

#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/specimens.h"
#include "segment/mesh/rays.h"
#include "segment/picture/exploded.h"
#include "segment/picture/png.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_pictures [--small] [--data DIR]
  --small  one scan of 69,000 faces only, to check that it runs
  --data   where bunny_bun_zipper.ply and ct_head_1912k.ply lie
)";

constexpr int runs = 3;
constexpr double rays_per_pixel = 12;

std::size_t both_pictures(const std::vector<Piece>& pieces) {
    Scene scene(coloured(pieces));
    std::size_t bytes = render_png(scene).size();
    scene.place(exploded_shifts(pieces));
    return bytes + render_png(scene).size();
}

// A ray through the middle of every pixel, row by row.
std::size_t hits(const RayTree& rays, const Camera& camera, const PictureOptions& options) {
    std::size_t found = 0;
    for (int y = 0; y < options.height; ++y) {
        for (int x = 0; x < options.width; ++x) {
            const Vec3 from = camera.origin + camera.mm_per_pixel * ((x + 0.5 - 0.5 * options.width) * camera.right -
                                                                     (y + 0.5 - 0.5 * options.height) * camera.up);
            found += rays.first_hit(from, camera.forward) ? 1 : 0;
        }
    }
    return found;
}

void measure_pictures(const Measured& measured, double max_s, Figures& figures) {
    const std::vector<Piece> pieces{measured.piece};
    const TriangleMesh& mesh = *measured.piece.mesh;
    const PictureOptions options;
    const Camera camera = framed(coloured(pieces), options);
    Pixels pixels{options.width, options.height, {}};
    pixels.rows.assign(static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height),
                       {200, 120, 40});
    double ours = INFINITY;
    double tree = INFINITY;
    double rays = INFINITY;
    double png = INFINITY;
    for (int i = 0; i < runs; ++i) {
        ours = std::min(ours, best_of(1, process_cpu_s, [&] { return both_pictures(pieces); }));
        tree = std::min(tree, best_of(1, process_cpu_s, [&] { return RayTree(mesh); }));
        const RayTree of_mesh(mesh);
        rays = std::min(rays, best_of(1, process_cpu_s, [&] { return hits(of_mesh, camera, options); }));
        png = std::min(png, best_of(1, process_cpu_s, [&] { return to_png(pixels); }));
    }
    const double beside = tree + rays_per_pixel * rays + png;
    figures.record(measured.name, "both pictures", time_text(ours));
    figures.record(measured.name, "tree, one ray per pixel, PNG of one colour",
                   time_text(tree) + ", " + time_text(rays) + ", " + time_text(png));
    figures.at_most(measured.name, "both pictures, seconds", ours, max_s);
    figures.at_most(measured.name, "both pictures / (tree + 12 rays per pixel + PNG)", ours / beside, 1.5);
}

void measure(const Choice& choice, Figures& figures) {
    if (const auto bunny = scan(choice.data / "bunny_bun_zipper.ply", 1000)) {
        measure_pictures(whole("bunny", *bunny), 1.2, figures);
    }
    if (choice.is_small) return;
    if (const auto head = scan(choice.data / "ct_head_1912k.ply", 1)) {
        measure_pictures(whole("CT head", *head), 2.5, figures);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
