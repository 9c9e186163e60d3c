// Runs of the search whose states are judged, and their files: one Markdown table per model, method and tilt.
//
// Shares are of the surface of the scan, 0..1. A file that is complete is not made again, so that an interrupted series
// of runs is continued by the same command.

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "segment/search/segmentation.h"
#include "segment/search/settings.h"

namespace qchopper::bench {

// What a search leaves after so many cuts.
struct CarveState {
    std::size_t cuts = 0;
    std::size_t pieces = 0;
    double measured = 0;    // out of reach, by the judge on the really cut pieces (reach_judge.h)
    double worst = 0;       // the largest share of a piece, of the piece's surface without its base
    double predicted = 0;   // the objective of the cut's candidate, as it was chosen; of a search without: on_samples
    double on_samples = 0;  // of the pieces after the cut, on the samples of the search
};

struct CarveRun {
    std::string model;
    std::string method;
    int tilt_deg = 60;
    std::vector<CarveState> states;  // from the uncut scan on, by cuts
    std::size_t max_cuts = 0;        // that were asked for; 0: the file is not there or not complete
    double seconds = 0;              // of search and judge, from the imported scan on
};

std::filesystem::path file_of(const std::filesystem::path& folder, const CarveRun& run);

// Adds what the file holds to a run with model, method and tilt.
CarveRun read_run(const std::filesystem::path& folder, CarveRun run);

struct RunOptions {
    std::size_t cuts = 16;
    std::size_t samples = 20'000;         // of the judge, over all pieces of a state by their area
    std::size_t min_samples = 1'000;      // of each piece
    std::size_t search_samples = 20'000;  // of the search
};

// Searches from the whole scan on until so many cuts are made, and writes the state after each round to one file per
// tilt. `settings`: the stop rules are replaced. A method without the objective is judged at several tilts. With a beam
// a state is the best of its round, which is what a search for so many cuts ends with.
void search_and_judge(const TriangleMesh& scan, const std::string& model, const std::string& method,
                      SearchSettings settings, const std::vector<int>& tilts, const RunOptions& options,
                      const std::filesystem::path& folder);

}  // namespace qchopper::bench
