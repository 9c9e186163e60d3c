// Tables of what both the worker and the server write as JSON (base/json_fields.h).

#pragma once

#include "app/console/worker/dispatch_plan.h"
#include "app/console/worker/shown_pieces.h"
#include "base/json_fields.h"

namespace qchopper {

template <class V, Of<ShownPiece> T>
void fields(V& v, T& piece) {
    v("name", piece.name);
    v("mesh", piece.mesh);
    v("deviation_mm", piece.deviation_mm);
}

template <class V, Of<PlannedJob> T>
void fields(V& v, T& job) {
    v("piece", job.piece);
    v("part", job.part);
    v("parts", job.parts);
    v("file", job.file);
    v("job", job.job);
    v("block_mm", job.block);
    v("time_s", job.time_s);
    v("proven", job.is_proven);
}

template <class V, Of<DispatchPlan> T>
void fields(V& v, T& plan) {
    v("cell", plan.cell);
    v("jobs", plan.jobs);
    v("refused", plan.refused);
}

}  // namespace qchopper
