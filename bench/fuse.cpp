// What fusing ten range scans of a surface takes, beside reading them: CPU time in one run, and the peak of memory.
//
//   bench_fuse MESH MM_PER_UNIT SPACING_MM VOXEL_MM FOLDER
//
// The scans are made by casting rays, with noise of 0.1 mm and one place in fifty empty, and kept in FOLDER.

#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "bench/clock.h"
#include "segment/fuse/fuse.h"
#include "segment/io/read_mesh.h"
#include "segment/io/read_range_scan.h"
#include "tests/segment/fuse/views.h"

namespace {

using namespace qchopper;  // NOLINT(google-build-using-namespace): one program

int measure(char** arguments) {
    TriangleMesh mesh = read_mesh(arguments[1]).mesh;
    for (Vec3& p : mesh.points) p = std::atof(arguments[2]) * p;
    const std::filesystem::path folder = arguments[5];
    std::size_t points = 0;
    {
        const RayTree tree(mesh);
        std::ofstream list(folder / "scans.conf");
        views::ViewOptions options{std::atof(arguments[3])};
        for (const Pose& pose : views::ten_poses()) {
            const std::string name = "view" + std::to_string(options.seed++) + ".ply";
            const RangeScan scan = view_of(mesh, tree, pose, options);
            points += scan.points.size();
            std::ofstream(folder / name) << views::ply_of(scan);
            list << views::list_line(name, pose);
        }
    }
    double begun = bench::process_cpu_s();
    for (int i = 1; i <= 10; ++i) {
        const std::string name = "view" + std::to_string(i) + ".ply";
        parse_range_scan(read_scan(folder / name), name);
    }
    const double reading = bench::process_cpu_s() - begun;
    begun = bench::process_cpu_s();
    const Fused fused = fuse(folder / "scans.conf", {std::atof(arguments[4])});
    const double fusing = bench::process_cpu_s() - begun;
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::printf("%zu points, %zu faces, %d rounds, median %.3f mm\n", points, fused.mesh.triangles.size(),
                fused.report.rounds, fused.report.residual);
    std::printf("reading %.2f CPU-s, fuse %.2f CPU-s, ratio %.1f, peak %ld MB\n", reading, fusing, fusing / reading,
                usage.ru_maxrss / 1024);
    return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** arguments) {
    if (count != 6) {
        std::fputs("bench_fuse MESH MM_PER_UNIT SPACING_MM VOXEL_MM FOLDER\n", stderr);
        return EXIT_FAILURE;
    }
    try {
        return measure(arguments);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
}
