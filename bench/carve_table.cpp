// Prints the tables of docs/measurements/out-of-reach.md: what share of the surface of ten models no tilting tool
// reaches after 0 to 16 cuts by the thesis' objectives and by those of the preset carve, judged on the really cut
// pieces.

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "app/engine/presets.h"
#include "base/error.h"
#include "bench/carve_runs.h"
#include "bench/carve_summary.h"
#include "bench/judge_check.h"
#include "bench/specimens.h"
#include "bench/table_models.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage =
    R"(bench_carve_table [--out FOLDER] [--model NAME...] [--tilt DEGREES...] [--beam B...] [--cuts N] [--data DIR] [--small] [--print]
  --out    where the runs are kept, one file each (carve-table); complete ones are not made again
  --model  femur_3548, vertebra, femur, skull, skull_scan_25k, bunny, igea, gorilla, ct_head_371k, dragon; all by default
  --tilt   60, 30 and 90 by default
  --beam   1 and 4 by default; with 1 comes the thesis
  --cuts   16 by default
  --data   where the scans lie
  --small  the sample vertebra with 8,000 faces and two cuts, to check that it runs, and the judge on a slot
  --print  prints what is there and makes no run
)";

constexpr std::size_t sample_faces = 60'000;

struct TableChoice {
    std::filesystem::path out = "carve-table";
    std::filesystem::path data = default_data();
    std::vector<std::string> models;  // names, in the order of the table
    std::vector<int> tilts;
    std::vector<int> beams;
    RunOptions run;
    bool is_small = false;
    bool only_prints = false;
};

// The words after argv[i] up to the next option.
std::vector<std::string> values_after(int argc, char** argv, int& i) {
    std::vector<std::string> values;
    while (i + 1 < argc && std::string(argv[i + 1]).rfind("--", 0) != 0) values.emplace_back(argv[++i]);
    return values;
}

void make_small(TableChoice& choice) {
    choice.models = {"vertebra"};
    choice.run.cuts = 2;
    choice.run.samples = 2000;
    choice.run.min_samples = 200;
    choice.run.search_samples = 2000;
}

void fill_in(TableChoice& choice) {
    if (choice.is_small) make_small(choice);
    if (choice.tilts.empty()) choice.tilts = {60, 30, 90};
    if (choice.beams.empty()) choice.beams = {1, 4};
    std::vector<std::string> ordered;
    for (const TableModel& model : table_models()) {
        const bool is_named = std::find(choice.models.begin(), choice.models.end(), model.name) != choice.models.end();
        if (choice.models.empty() || is_named) ordered.push_back(model.name);
    }
    choice.models = ordered;
}

// False for an unknown option and a value that is no number.
bool parse_table(int argc, char** argv, TableChoice& choice) {
    const auto numbers = [](const std::vector<std::string>& words) {
        std::vector<int> all;
        all.reserve(words.size());
        for (const std::string& w : words) all.push_back(std::stoi(w));
        return all;
    };
    try {
        for (int i = 1; i < argc; ++i) {
            const std::string option = argv[i];
            const std::vector<std::string> values = values_after(argc, argv, i);
            const bool is_flag = option == "--small" || option == "--print";
            if (values.empty() != is_flag) return false;
            if (option == "--small")
                choice.is_small = true;
            else if (option == "--print")
                choice.only_prints = true;
            else if (option == "--out")
                choice.out = values.front();
            else if (option == "--data")
                choice.data = values.front();
            else if (option == "--cuts")
                choice.run.cuts = static_cast<std::size_t>(std::stoul(values.front()));
            else if (option == "--model")
                choice.models = values;
            else if (option == "--tilt")
                choice.tilts = numbers(values);
            else if (option == "--beam")
                choice.beams = numbers(values);
            else
                return false;
        }
    } catch (const std::logic_error&) {  // of std::stoi
        return false;
    }
    fill_in(choice);
    return true;
}

// Of these tilts, those whose run is not complete.
std::vector<int> missing(const TableChoice& choice, const std::string& model, const std::string& method,
                         const std::vector<int>& tilts) {
    std::vector<int> all;
    for (const int tilt : tilts) {
        if (read_run(choice.out, {model, method, tilt, {}, 0, 0}).max_cuts < choice.run.cuts) all.push_back(tilt);
    }
    return all;
}

void make_runs(const TableChoice& choice, const TableModel& model, int beam, int tilt) {
    const std::string carve = "carve " + std::to_string(beam);
    const std::vector<int> by_carve = missing(choice, model.name, carve, {tilt});
    std::vector<int> by_thesis;  // its cuts do not depend on the tilt: all at once
    if (beam == 1) by_thesis = missing(choice, model.name, "thesis", choice.tilts);
    if (by_carve.empty() && by_thesis.empty()) return;
    const std::optional<TriangleMesh> mesh = mesh_of(model, choice.data, choice.is_small ? 8000 : sample_faces);
    if (!mesh) return;
    if (!by_thesis.empty()) {
        search_and_judge(*mesh, model.name, "thesis", *preset("bunny"), by_thesis, choice.run, choice.out);
    }
    if (!by_carve.empty()) {
        SearchSettings settings = *preset("carve");
        settings.objectives.tilt_deg = tilt;
        settings.beam = static_cast<std::size_t>(beam);
        search_and_judge(*mesh, model.name, carve, settings, by_carve, choice.run, choice.out);
    }
}

void make_table(const TableChoice& choice) {
    if (choice.is_small) print_judge_check(std::cout);
    std::filesystem::create_directories(choice.out);
    for (const int beam : choice.beams) {
        for (const int tilt : choice.tilts) {
            for (const TableModel& model : table_models()) {
                const bool is_wanted =
                    std::find(choice.models.begin(), choice.models.end(), model.name) != choice.models.end();
                if (is_wanted && !choice.only_prints) make_runs(choice, model, beam, tilt);
            }
        }
    }
    print_carve(choice.out, choice.models, choice.tilts, std::cout);
}

}  // namespace

int main(int argc, char** argv) {
    TableChoice choice;
    if (!parse_table(argc, argv, choice)) {
        std::cerr << usage;
        return 64;
    }
    try {
        make_table(choice);
    } catch (const InputError& error) {
        std::cerr << error.what() << ". To do: " << error.to_do.text << std::endl;
        return 65;
    }
    return 0;
}
