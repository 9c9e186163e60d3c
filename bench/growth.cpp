// Times the evaluation of a larger mesh, and measures the memory of the program on a large scan.

#include <iostream>

#include "app/store/project_folder.h"
#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "bench/child.h"
#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/io/write_mesh.h"

namespace qchopper::bench {

namespace fs = std::filesystem;

void measure_growth(const Measured& small, const Baseline& small_base, std::size_t faces, Figures& figures) {
    const Measured large = one_shell("skull " + number_text(static_cast<double>(faces)), Specimen::skull, faces);
    const double seconds = evaluation_s(large, 3);
    const double growth = static_cast<double>(large.faces()) / static_cast<double>(small.faces());
    figures.record(large.name, "evaluation", time_text(seconds));
    figures.at_most(large.name, "growth of evaluation / growth of the faces from " + small.name,
                    seconds / small_base.evaluation_s / growth, 1.2);
}

void measure_memory(const fs::path& program, std::size_t faces, Figures& figures) {
    const std::string name = "skull " + number_text(static_cast<double>(faces));
    const TemporaryFolder folder("qchopper-bench-");
    const fs::path file = folder.path() / "skull.ply";
    {
        SampleOptions options;
        options.faces = faces;
        write_file(file, to_ply(sample(Specimen::skull, options)));
    }
    const ChildResult ended = run({program.string(), "segment", file.string(), "--units", "mm", "--min-cuts", "1",
                                   "--auto", "--quiet", "-o", (folder.path() / "skull.qch").string()});
    const bool is_done = ended.status == 0 && load_project(folder.path() / "skull.qch").cuts.size() == 1;
    if (!is_done) {
        figures.add({name, "peak memory of " + program.string() + " segment",
                     "it ended with status " + std::to_string(ended.status), "at most 200 bytes a face", std::nullopt});
        return;
    }
    figures.record(name, "segment to one cut, reading and writing", "wall " + time_text(ended.wall));
    figures.at_most(name, "peak memory of segment, bytes a face", ended.peak_bytes / static_cast<double>(faces), 200);
}

}  // namespace qchopper::bench
