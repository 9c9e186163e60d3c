// Measures simplification to a number of faces, and its deviation, beside meshoptimizer, and vertex clustering beside
// simplification: every figure is taken in this one run, on one thread, and the ratios are between figures of this run.

#include "segment/simplify/simplify.h"

#include <string>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_simplifiers.h"
#include "segment/sample/sample.h"
#include "segment/simplify/collapse.h"
#include "segment/simplify/collapse_passes.h"
#include "segment/simplify/sampled_deviation.h"
#include "segment/simplify/vertex_clustering.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_simplify [--small] [--only GROUP]...
  --small  20,000 and 190,000 faces instead, to check that it runs; the targets do not apply
  --only   passes, queue or clustering; all if none is named. queue is the slower way, for its deviation
)";

constexpr int runs = 3;

std::string mm(double length) {
    return number_text(length) + " mm";
}

double deviation_of(const TriangleMesh& mesh, const TriangleMesh& fewer) {
    return std::max(farthest_sample(mesh, fewer), farthest_sample(fewer, mesh));
}

void measure_passes(const std::string& name, const TriangleMesh& mesh, std::size_t faces, Figures& figures) {
    SimplifyOptions options;
    options.max_faces = faces;
    double whole = INFINITY;
    double deviation = INFINITY;
    double theirs = INFINITY;
    for (int i = 0; i < runs; ++i) {
        TriangleMesh fewer = mesh;
        whole = std::min(whole, best_of(1, cpu_s, [&] { return simplify(fewer, options).faces_after; }));
        deviation = std::min(deviation, best_of(1, cpu_s, [&] { return deviation_of(mesh, fewer); }));
        const std::optional<OtherSimplified> other = meshoptimizer_simplify(mesh, faces);
        if (other) theirs = std::min(theirs, other->seconds);
        if (i > 0) continue;
        figures.record(name, "faces left", std::to_string(fewer.triangles.size()));
        figures.record(name, "deviation", mm(deviation_of(mesh, fewer)));
        if (!other) continue;
        figures.record(name, "faces left by meshoptimizer", std::to_string(other->mesh.triangles.size()));
        figures.record(name, "its deviation", mm(deviation_of(mesh, other->mesh)));
    }
    const double ours = whole - deviation;
    figures.record(name, "simplified in, and the deviation measured in",
                   time_text(ours) + " and " + time_text(deviation));
    figures.at_most(name, "deviation / simplification", deviation / ours, 1);
    if (theirs == INFINITY) {
        figures.add({name, "simplification / by meshoptimizer", "meshoptimizer was not there when this was built",
                     "at most 3", std::nullopt});
        return;
    }
    figures.record(name, "simplified by meshoptimizer", time_text(theirs));
    figures.at_most(name, "simplification / by meshoptimizer", ours / theirs, 3);
}

void measure_queue(const std::string& name, const TriangleMesh& mesh, std::size_t faces, Figures& figures) {
    TriangleMesh fewer = mesh;
    CollapseLimits limits;
    limits.max_faces = faces;
    const double seconds = best_of(1, cpu_s, [&] { return collapse_edges(fewer, {}, limits); });
    figures.record(name, "simplified by the queue", time_text(seconds));
    figures.record(name, "deviation of the queue", mm(deviation_of(mesh, fewer)));
}

void measure_clustering(const std::string& name, const TriangleMesh& mesh, std::size_t faces, Figures& figures) {
    ClusteredMesh clustered;
    const double ours = best_of(runs, cpu_s, [&] {
        clustered = cluster_to(faces, mesh);
        return clustered.mesh.triangles.size();
    });
    const double passes = best_of(runs, cpu_s, [&] { return collapse_in_passes(mesh, {}, faces).triangles.size(); });
    figures.record(name, "faces left by clustering", std::to_string(clustered.mesh.triangles.size()));
    figures.record(name, "clustered, and collapsed in passes, in", time_text(ours) + " and " + time_text(passes));
    figures.at_most(name, "clustering / passes", ours / passes, 0.5);
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const std::size_t faces = choice.is_small ? 5'000 : 50'000;
    for (const std::size_t before : {std::size_t{200'000}, std::size_t{1'900'000}}) {
        SampleOptions options;
        options.faces = choice.is_small ? before / 10 : before;
        const TriangleMesh skull = sample(Specimen::skull, options);
        const std::string name = "skull " + number_text(static_cast<double>(skull.triangles.size()));
        if (choice.wants("passes")) measure_passes(name, skull, faces, figures);
        if (choice.wants("queue")) measure_queue(name, skull, faces, figures);
        if (choice.wants("clustering")) measure_clustering(name, skull, 2 * faces, figures);
    }
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
