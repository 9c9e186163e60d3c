// Times the evaluation of all candidate planes against one cut, against the copying of as many bytes, against all cuts
// performed and against CGAL's clip.

#include <algorithm>
#include <array>
#include <numbers>

#include "base/parallel.h"
#include "bench/cgal_clip.h"
#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/cut/cut.h"
#include "segment/objectives/sweep/sweep.h"
#include "segment/search/candidates/evaluate.h"
#include "segment/search/piece_names.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"

namespace qchopper::bench {
namespace {

Objectives thesis_form() {
    Objectives objectives;
    objectives.fragility_form = FragilityForm::thesis;
    return objectives;
}

double sweep_s(const PreparedPiece& prepared, const std::vector<Planes>& planes, int runs) {
    return best_of(runs, cpu_s, [&] {
        std::vector<std::vector<std::optional<CutEvaluation>>> evaluations;
        evaluations.reserve(planes.size());
        for (const Planes& p : planes) evaluations.push_back(sweep(prepared, p.normal, p.offsets, thesis_form()));
        return evaluations;
    });
}

double cut_s(const TriangleMesh& mesh, const std::vector<Planes>& planes, int runs) {
    double sum = 0;
    int cuts = 0;
    for (const Planes& p : planes) {
        const auto middle = p.offsets.size() / 2;
        for (const std::size_t i : {middle - 2, middle, middle + 2}) {
            sum += best_of(runs, cpu_s, [&] { return cut(mesh, {p.normal, p.offsets[i]}, 1); });
            ++cuts;
        }
    }
    return sum / cuts;
}

template <class T>
double bytes(const std::vector<T>& v) {
    return static_cast<double>(v.size() * sizeof(T));
}

// What the sweep of one normal must read and write with any method: points, their normals and one neighbour each,
// corners and area vectors of the triangles; height and slab component of every point.
double bytes_to_touch(const PreparedPiece& prepared) {
    const TriangleMesh& mesh = *prepared.piece->mesh;
    const auto points = static_cast<double>(mesh.points.size());
    const double read = bytes(mesh.points) + bytes(prepared.vertex_normals) + points * sizeof(std::uint32_t) +
                        bytes(mesh.triangles) + static_cast<double>(mesh.triangles.size() * sizeof(Vec3));
    const double written = points * (sizeof(double) + sizeof(std::uint32_t));
    return read + written;
}

struct Streams {
    double copy_s = 0;  // copies half as many bytes, so that reading and writing together touch so many
    double read_s = 0;  // adds up so many bytes, eight sums at a time
};

Streams streams(double byte_count, int runs) {
    const std::vector<double> from(static_cast<std::size_t>(byte_count / 2 / sizeof(double)), 1.0);
    std::vector<double> to(from.size(), 0.0);
    double check = 0;
    Streams result;
    result.copy_s = best_of(runs, cpu_s, [&] {
        for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
        check += to[to.size() / 2];
        return 0;
    });
    result.read_s = best_of(runs, cpu_s, [&] {
        std::array<double, 8> sum{};
        for (const std::vector<double>* half : {&from, static_cast<const std::vector<double>*>(&to)}) {
            for (std::size_t i = 0; i + 8 <= half->size(); i += 8) {
                for (std::size_t k = 0; k < 8; ++k) sum[k] += (*half)[i + k];
            }
        }
        check += sum[0] + sum[7];
        return 0;
    });
    return check > 0 ? result : Streams{};
}

double performed_s(const Piece& piece, const std::vector<Candidate>& candidates) {
    const double started = cpu_s();
    std::size_t solids = 0;
    for (const Candidate& c : candidates) {
        if (const auto evaluation = evaluate_by_cutting(piece, c.plane, thesis_form()))
            solids += evaluation->solids.size();
    }
    return solids > 0 ? cpu_s() - started : 0;
}

// Directions evenly over half of the sphere (a Fibonacci spiral).
std::vector<Vec3> directions(int count) {
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i) {
        const double z = (i + 0.5) / count;
        const double r = std::sqrt(1 - z * z);
        const double phi = std::numbers::pi * (3 - std::sqrt(5.0)) * i;
        result.push_back(canonical({{r * std::cos(phi), r * std::sin(phi), z}, 0}).normal);
    }
    return result;
}

// Wall time of reading so many bytes once, on the threads that are allowed now.
double reading_s(double bytes, int runs) {
    constexpr std::size_t at_once = 1 << 16;
    const std::vector<double> numbers(static_cast<std::size_t>(bytes / sizeof(double)), 1.5);
    std::vector<double> sums(numbers.size() / at_once + 1, 0);
    return best_of(runs, wall_s, [&] {
        parallel_for(0, sums.size(), [&](std::size_t part) {
            const std::size_t end = std::min(numbers.size(), (part + 1) * at_once);
            std::array<double, 4> sum{};
            for (std::size_t i = part * at_once; i < end; ++i) sum[i % 4] += numbers[i];
            sums[part] = sum[0] + sum[1] + sum[2] + sum[3];
        });
        return sums;
    });
}

const Piece& most_faces(const Segmentation& s) {
    return *std::max_element(s.pieces.begin(), s.pieces.end(), [](const Piece& a, const Piece& b) {
        return a.mesh->triangles.size() < b.mesh->triangles.size();
    });
}

// Cuts a thin slice off both ends along every normal; the rest has nearly all faces.
Piece with_six_caps(const Measured& measured, const std::vector<Planes>& planes) {
    constexpr int slices = 199;  // half a percent of the extent each
    Segmentation s;
    s.pieces.push_back(measured.piece);
    s.pieces.front().name = piece_name(s.names_given++);
    for (const Planes& p : planes) {
        const std::vector<Candidate> along = candidates_along(measured.piece, p.normal, 0, slices);
        for (const Candidate& end : {along.front(), along.back()}) {
            Cut slice;
            slice.number = static_cast<std::int32_t>(s.cuts.size()) + 1;
            slice.piece = most_faces(s).name;
            slice.chosen.plane = end.plane;
            apply(s, slice, 0);
        }
    }
    return most_faces(s);
}

}  // namespace

double evaluation_s(const Measured& measured, int runs) {
    const ThreadLimit one_thread(1);
    const std::vector<Planes> planes = by_normal(candidate_planes(measured.piece, {}));
    return sweep_s(prepare(measured.piece, thesis_form()), planes, runs);
}

Baseline measure_evaluation(const Measured& m, const Effort& effort, Figures& figures) {
    const ThreadLimit one_thread(1);
    const std::vector<Candidate> candidates = candidate_planes(m.piece, {});
    const std::vector<Planes> planes = by_normal(candidates);
    const PreparedPiece prepared = prepare(m.piece, thesis_form());
    const Baseline base{sweep_s(prepared, planes, effort.runs), cut_s(*m.piece.mesh, planes, effort.runs)};
    figures.record(m.name, "evaluation " + std::to_string(candidates.size()) + " candidates",
                   time_text(base.evaluation_s));
    figures.record(m.name, "one cut, both halves", time_text(base.cut_s));
    figures.at_most(m.name, "evaluation / one cut", base.evaluation_s / base.cut_s, 2.5);
    const double touched = bytes_to_touch(prepared);
    const Streams streamed = streams(touched, effort.runs);
    const auto rate = [&](double seconds) {
        return time_text(seconds) + ", " + number_text(touched / 1e9 / seconds) + " GB/s";
    };
    const std::string amount = number_text(touched / 1e6) + " MB of one normal";
    figures.record(m.name, amount + ", copy loop", rate(streamed.copy_s));
    figures.record(m.name, amount + ", reading loop", rate(streamed.read_s));
    figures.at_most(m.name, "evaluation / copy loop over the bytes of its normals",
                    base.evaluation_s / (static_cast<double>(planes.size()) * streamed.copy_s), 5);
    if (effort.cuts) {
        const double performed = performed_s(m.piece, candidates);
        figures.record(m.name, "all cuts performed and scored", time_text(performed));
        figures.at_least(m.name, "cuts performed and scored / evaluation", performed / base.evaluation_s, 80);
    }
    if (effort.clip) {
        const Planes& first = planes.front();
        const ClipResult clip = cgal_clip(*m.piece.mesh, {first.normal, first.offsets[first.offsets.size() / 2]});
        figures.record(m.name, "CGAL clip of both sides",
                       time_text(clip.cpu_s) + (clip.is_closed ? "" : ", left open"));
        figures.at_least(m.name, "CGAL clip / evaluation", clip.cpu_s / base.evaluation_s, 20);
        figures.at_least(m.name, "CGAL clip / one cut", clip.cpu_s / base.cut_s, 50);
    }
    return base;
}

void measure_caps(const Measured& m, const Baseline& base, const Effort& effort, Figures& figures) {
    const ThreadLimit one_thread(1);
    const Piece capped = with_six_caps(m, by_normal(candidate_planes(m.piece, {})));
    const std::size_t caps = measure(capped).bases.size();
    const Measured with{m.name, capped, m.fragment_volume_mm3};
    const double seconds = evaluation_s(with, effort.runs);
    const double per_face =
        (seconds / static_cast<double>(with.faces())) / (base.evaluation_s / static_cast<double>(m.faces()));
    figures.record(m.name,
                   "evaluate a piece of it with " + std::to_string(caps) + " caps, " +
                       number_text(static_cast<double>(with.faces())) + " faces",
                   time_text(seconds));
    figures.at_most(m.name, "that, per face / evaluate the uncut mesh, per face", per_face, 1.6);
}

void measure_many(const Measured& m, const Baseline& base, Figures& figures) {
    constexpr int normals = 132;
    constexpr int offsets = 200;
    std::vector<Candidate> candidates;
    const std::vector<Vec3> all = directions(normals);
    for (int n = 0; n < normals; ++n) {
        const auto some = candidates_along(m.piece, all[static_cast<std::size_t>(n)], n, offsets);
        candidates.insert(candidates.end(), some.begin(), some.end());
    }
    const auto evaluation = [&] { return evaluate_all(m.piece, candidates, thesis_form(), Context{}); };
    double cpu = 0;
    double one = 0;
    double two = 0;
    double read_one = 0;
    double read_two = 0;
    const double touched = bytes_to_touch(prepare(m.piece, thesis_form()));
    {
        const ThreadLimit one_thread(1);
        read_one = reading_s(touched, 20);
        const double started = wall_s();
        cpu = best_of(1, cpu_s, evaluation);
        one = wall_s() - started;
    }
    {
        const ThreadLimit two_threads(2);
        read_two = reading_s(touched, 20);
        two = best_of(1, wall_s, evaluation);
    }
    const std::string what = std::to_string(candidates.size()) + " candidates of 132 normals, with preparation";
    figures.record(m.name, what, time_text(cpu) + "; wall " + time_text(one) + ", two threads " + time_text(two));
    figures.at_most(m.name, "that / evaluation 3 x 40", cpu / base.evaluation_s, 160);
    figures.at_least(m.name, "that, wall: one thread / two threads", one / two, 1.9);
    figures.record(m.name, "reading the bytes of one normal, wall: one thread / two threads",
                   number_text(read_one / read_two));
    figures.at_least(m.name, "speed-up by two threads / that of the reading loop", (one / two) / (read_one / read_two),
                     0.9);
}

}  // namespace qchopper::bench
