// Measures the search: every figure is taken in this one run, and the ratios are between figures of this run.

#include <algorithm>
#include <set>
#include <string>

#include "bench/choice.h"
#include "bench/measures.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_search [--data DIR] [--program QCHOPPER] [--small] [--only GROUP]...
  --data     where bunny_bun_zipper.ply and ct_head_1912k.ply lie
  --program  the program whose memory is measured; without it that figure is left out
  --small    the bunny and 100,000 faces instead, to check that it runs; the targets do not apply
  --only     evaluation, cuts, clip, caps, many, decision, run, growth or memory; all if none is named
)";

std::vector<Measured> meshes(const Choice& choice) {
    std::vector<Measured> all;
    if (choice.is_small) {
        if (const auto bunny = scan(choice.data / "bunny_bun_zipper.ply", 1000)) all.push_back(whole("bunny", *bunny));
        all.push_back(one_shell("skull 100k", Specimen::skull, 100'000));
        return all;
    }
    all.push_back(one_shell("skull 1.9M", Specimen::skull, 1'912'000));
    if (const auto head = scan(choice.data / "ct_head_1912k.ply", 1)) {
        all.push_back(whole("CT head, whole", *head));
        all.push_back(biggest("CT head, biggest piece", *head));
    }
    return all;
}

void measure(const Choice& choice, Figures& figures) {
    const std::size_t large = choice.is_small ? 500'000 : 10'000'000;
    const bool is_memory_alone = choice.only == std::set<std::string>{"memory"};
    const std::vector<Measured> all = is_memory_alone ? std::vector<Measured>{} : meshes(choice);
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Measured& m = all[i];
        figures.record(m.name, "faces", number_text(static_cast<double>(m.faces())));
        Effort effort;
        effort.cuts = choice.wants("cuts");
        effort.clip = choice.wants("clip");
        const Baseline base = measure_evaluation(m, effort, figures);
        if (choice.wants("caps")) measure_caps(m, base, effort, figures);
        if (choice.wants("decision")) measure_decision(m, base, effort, figures);
        const bool is_one_solid = m.name != "CT head, whole";  // else there are many pieces before the first cut
        if (choice.wants("run") && is_one_solid) measure_run(m, choice.is_small ? 6 : 20, figures);
        if (choice.wants("many") && i == 0) measure_many(m, base, figures);
        const bool is_sample = choice.is_small ? i + 1 == all.size() : i == 0;
        if (choice.wants("growth") && is_sample) measure_growth(m, base, large, figures);
    }
    if (choice.wants("memory") && !choice.program.empty()) measure_memory(choice.program, large, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
