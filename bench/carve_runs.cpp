// Pieces are judged once for each tilt; the next state keeps what is known of those that it still has.

#include "bench/carve_runs.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "base/text.h"
#include "bench/clock.h"
#include "bench/reach_judge.h"
#include "segment/access/piece_access.h"
#include "segment/mesh/measure.h"
#include "segment/search/search.h"

namespace qchopper::bench {
namespace {

constexpr double fragment_share = 1e-5;  // of the scan's volume, as the program has it

struct Verdict {
    PieceVerdict measured;
    double on_samples_mm2 = 0;
};
using Verdicts = std::map<std::shared_ptr<const TriangleMesh>, Verdict>;

// Judges the states of one search at one tilt and writes them.
class StateWriter {
 public:
    StateWriter(const std::filesystem::path& folder, CarveRun run, const RunOptions& options)
        : run_(std::move(run)), options_(options), out_(file_of(folder, run_)) {
        out_ << "# " << run_.model << ", " << run_.method << ", " << run_.tilt_deg << " degrees\n\n"
             << "| cuts | pieces | measured % | worst piece % | predicted % | on the search's samples % |\n"
             << "|---|---|---|---|---|---|\n";
    }

    void add(const Segmentation& segmentation, bool is_predicted) {
        const double scan_mm2 = scan_area_mm2(segmentation.pieces.front());
        judge_new(segmentation.pieces, scan_mm2);
        CarveState state;
        state.cuts = segmentation.cuts.size();
        state.pieces = segmentation.pieces.size();
        for (const Piece& piece : segmentation.pieces) {
            const Verdict& v = verdicts_.at(piece.mesh);
            state.measured += v.measured.unreachable_mm2 / scan_mm2;
            state.on_samples += v.on_samples_mm2 / scan_mm2;
            state.worst = std::max(state.worst, v.measured.share());
        }
        state.predicted =
            is_predicted && state.cuts > 0 ? segmentation.cuts.back().chosen.terms.unreachable : state.on_samples;
        write(state);
    }

    void complete(double seconds) {
        out_ << "\ncomplete: " << options_.cuts << " cuts asked for, " << fixed(seconds, 1) << " s" << std::endl;
    }

 private:
    void judge_new(const std::vector<Piece>& pieces, double scan_mm2) {
        Verdicts now;
        for (const Piece& piece : pieces) {
            const auto known = verdicts_.find(piece.mesh);
            now[piece.mesh] = known != verdicts_.end() ? known->second : verdict(piece, scan_mm2);
        }
        verdicts_ = std::move(now);
    }

    Verdict verdict(const Piece& piece, double scan_mm2) const {
        const double by_area = static_cast<double>(options_.samples) * uncut_area_mm2(*piece.mesh) / scan_mm2;
        JudgeOptions judging;
        judging.tilt_deg = run_.tilt_deg;
        judging.samples = std::max(options_.min_samples, static_cast<std::size_t>(by_area));
        return {judge(piece, judging), area_on_best_base(piece, run_.tilt_deg).unreachable_mm2};
    }

    void write(const CarveState& s) {
        std::ostringstream line;
        line << "| " << s.cuts << " | " << s.pieces << " | " << fixed(100 * s.measured, 3) << " | "
             << fixed(100 * s.worst, 3) << " | " << fixed(100 * s.predicted, 3) << " | " << fixed(100 * s.on_samples, 3)
             << " |";
        out_ << line.str() << std::endl;
        std::cerr << run_.model << ", " << run_.method << ", " << run_.tilt_deg << ": " << line.str() << std::endl;
    }

    CarveRun run_;
    const RunOptions& options_;
    std::ofstream out_;
    Verdicts verdicts_;
};

std::optional<CarveState> state_of(const std::string& line) {
    CarveState s;
    std::istringstream in(line);
    char bar = 0;
    if (!(in >> bar >> s.cuts >> bar >> s.pieces)) return std::nullopt;
    for (double* share : {&s.measured, &s.worst, &s.predicted, &s.on_samples}) {
        if (!(in >> bar >> *share)) return std::nullopt;
        *share /= 100;
    }
    return s;
}

}  // namespace

std::filesystem::path file_of(const std::filesystem::path& folder, const CarveRun& run) {
    std::string method = run.method;
    std::replace(method.begin(), method.end(), ' ', '-');
    return folder / (run.model + "-" + method + "-" + std::to_string(run.tilt_deg) + ".md");
}

CarveRun read_run(const std::filesystem::path& folder, CarveRun run) {
    std::ifstream in(file_of(folder, run));
    std::string line;
    while (std::getline(in, line)) {
        if (const auto state = state_of(line)) run.states.push_back(*state);
        std::istringstream words(line);
        std::string word;
        if (words >> word && word == "complete:") {
            words >> run.max_cuts >> word >> word >> word >> run.seconds;
        }
    }
    return run;
}

void search_and_judge(const TriangleMesh& scan, const std::string& model, const std::string& method,
                      SearchSettings settings, const std::vector<int>& tilts, const RunOptions& options,
                      const std::filesystem::path& folder) {
    settings.objectives.fragment_volume_mm3 = fragment_share * volume_mm3(scan);
    settings.stop = {};
    settings.stop.min_cuts = static_cast<int>(options.cuts);
    const double started = wall_s();
    Segmentation segmentation = uncut(scan, settings.objectives.fragment_volume_mm3);
    sample_uncut(segmentation.pieces, {}, options.search_samples);
    std::vector<std::unique_ptr<StateWriter>> writers;
    writers.reserve(tilts.size());
    for (const int tilt : tilts) {
        writers.push_back(std::make_unique<StateWriter>(folder, CarveRun{model, method, tilt, {}, 0, 0}, options));
    }
    const auto add = [&](const Segmentation& state) {
        for (const auto& writer : writers) writer->add(state, settings.objectives.weights.unreachable > 0);
    };
    add(segmentation);
    EvaluationCache cache(settings.objectives, settings.candidates);
    search(segmentation, settings, cache, {}, add, {});
    for (const auto& writer : writers) writer->complete(wall_s() - started);
}

}  // namespace qchopper::bench
