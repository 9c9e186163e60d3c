// Projects for the tests of plans.

#pragma once

#include <map>
#include <string>

#include "app/store/project_folder.h"
#include "app/store/replay.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"

namespace qchopper::planned {

// `mesh` is about its own centre, which lay at `centre` in the file.
inline ScanSource source_of(const TriangleMesh& mesh, Vec3 centre) {
    const Bytes bytes = to_ply(mesh);
    return {"/scans/bone.ply", sha256(bytes), Unit::mm, 1, centre, mesh.triangles.size(), volume_mm3(mesh), {}};
}

// Cut by the greedy search.
inline Project project_of(const TriangleMesh& mesh, Vec3 centre, int cuts) {
    Project project;
    project.scan = source_of(mesh, centre);
    project.settings.candidates.offsets_per_normal = 9;
    project.settings.stop.min_cuts = cuts;
    project.settings.objectives.fragment_volume_mm3 = 1e-5 * project.scan.volume_mm3;
    project.history.weights_at_start = project.settings.objectives.weights;
    Segmentation segmentation = uncut(mesh, project.settings.objectives.fragment_volume_mm3);
    EvaluationCache cache(project.settings.objectives, project.settings.candidates);
    search(segmentation, project.settings, cache, {}, [](const Segmentation&) {}, {});
    record(project, segmentation);
    return project;
}

}  // namespace qchopper::planned
