// The figures of bench_search, group by group. CPU time of one thread, best of several, unless a figure has "wall" in
// its name.

#pragma once

#include "bench/figures.h"
#include "bench/specimens.h"
#include "segment/search/settings.h"

namespace qchopper::bench {

// The times that the other figures are ratios to, in seconds.
struct Baseline {
    double evaluation_s = 0;  // 3 x 40 candidates, thesis' fragility, on the prepared piece
    double cut_s = 0;         // one cut, both halves: mean over nine planes near the middles of the three normals
};

struct Effort {
    bool cuts = false;  // perform all 120 cuts and score them
    bool clip = false;  // one CGAL clip
    int runs = 5;       // the best of so many counts
};

// Evaluation against one cut, a copy of its bytes, 120 cuts and CGAL's clip.
Baseline measure_evaluation(const Measured& measured, const Effort& effort, Figures& figures);
// A piece with six caps against the uncut mesh, per face.
void measure_caps(const Measured& measured, const Baseline& base, const Effort& effort, Figures& figures);
// 132 normals x 200 offsets, on one and on two threads.
void measure_many(const Measured& measured, const Baseline& base, Figures& figures);

// From a mesh in memory to the first cut, with its steps; the box; new weights.
void measure_decision(const Measured& measured, const Baseline& base, const Effort& effort, Figures& figures);

// CPU seconds of a search until there are so many pieces, on one thread, samples and their rays included if the
// settings ask for them.
double run_s(const Measured& measured, const SearchSettings& settings, std::size_t pieces);
// A search until there are so many pieces, on one and on two threads.
void measure_run(const Measured& measured, std::size_t pieces, Figures& figures);

// How evaluation grows with the faces.
void measure_growth(const Measured& small, const Baseline& small_base, std::size_t faces, Figures& figures);
// Peak memory of a program of its own that reads a scan and decides one cut.
void measure_memory(const std::filesystem::path& program, std::size_t faces, Figures& figures);

// Seconds of the first decision, from a mesh in memory: the best of `runs`.
double first_decision_s(const Measured& measured, int runs);
// Seconds of one evaluation, the best of `runs`.
double evaluation_s(const Measured& measured, int runs);

}  // namespace qchopper::bench
