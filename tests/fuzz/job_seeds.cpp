// Job files, the texts of their tickets and manifests, and cell files.

#include <memory>
#include <utility>

#include "base/files/file.h"
#include "base/files/zip.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "tests/fuzz/seeds.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Small, with an entry in every list. The setup is written down, not computed.
JobInput some_job() {
    JobInput input;
    const TriangleMesh box = shapes::box({-10, -5, 0}, {10, 5, 8}, 1);
    input.piece = {"AB", std::make_shared<TriangleMesh>(box), {{4, {{0, 0, 1}, 0}, true}}};
    input.piece_no = 2;
    input.piece_count = 5;
    input.program_version = "0.1.0";
    input.project_id.fill(0x11);
    input.scan_sha256.bytes.fill(0x22);
    input.cell.name = "test";
    input.cell.id = 1;
    input.cell.stock = {{"small", {100, 60, 50}, Material::eps}};
    input.cell.tool = {1, "ball", 20, 18000, 9000, 24000};
    input.setup.base = 4;
    input.setup.base_description = "the cap of cut 4";
    input.setup.box = {{-10, -5, 0}, {10, 5, 8}};
    input.setup.block.size = {100, 60, 50};
    input.setup.block.is_sawn = true;
    input.setup.block.offcuts = {{200, 60, 50}};
    input.setup.spoil = 10;
    input.setup.warnings = {"a warning"};
    DrawnCap cap;
    cap.cap.cut = 4;
    cap.cap.cap_in_piece.row = {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}};
    cap.cap.joints = {{"C", 200, "", {{1, 6, 16, {1, 2}, {1, -2, 0}, {0, 0, 1}, false, "no drill"}}}};
    cap.outline = {{{-10, -5}, {10, -5}, {10, 5}, {-10, 5}}};
    cap.names_at = {{0, 0}};
    cap.size = {20, 10};
    input.caps = {cap};
    SurfaceAccess& access = input.setup.access;
    access.method = AccessMethod::mapped;
    access.orientations = {{{0, 0, 1}, 0, 0.75, 20}};
    access.further = ToolOrientation{{0, 1, 0}, 90, 0.125, 10};
    access.area_mm2 = 600;
    access.hidden_mm2 = 30;
    access.foam_mm3 = 1000;
    input.alternatives = {input.setup};
    input.stock_fit.margins = {{"piece in block, height", "too high", 42}};
    input.warnings = {"scaled by 0.5 on request"};
    return input;
}

// The same with two caps more: the block ends at one, the other is milled.
JobInput sawn_job() {
    JobInput input = some_job();
    input.piece.half_spaces.push_back({5, {{1, 0, 0}, 10}, false});
    input.piece.half_spaces.push_back({6, {{1, 0, 0}, -10}, true});
    input.cell.stock[0].is_sawn = true;
    input.cell.stock[0].kerf = 3;
    Setup& setup = input.setup;
    setup.piece_in_setup.shift = {2.5, 0, 0};
    setup.box = {{-7.5, -5, 0}, {12.5, 5, 8}};
    setup.block.size = {25, 20, 21};
    setup.flush_caps = {{5, BlockFace::plus_x, 80}};
    setup.milled_caps_mm2 = 80;
    setup.access.allowed_mm2 = 576;
    input.alternatives = {setup};
    input.caps.clear();
    return input;
}

// The job packed, and its texts one after the other.
std::pair<Bytes, Bytes> packed(const JobInput& input) {
    Bytes whole = job_file(input);
    parse_job(whole, "seed");  // throws if the seed is refused
    std::map<std::string, Bytes> files = unzip(whole, "seed");
    Bytes texts = files["ticket.json"];
    texts.push_back(0);
    texts.insert(texts.end(), files["manifest.json"].begin(), files["manifest.json"].end());
    texts.push_back(0);
    texts.insert(texts.end(), files["envelope.json"].begin(), files["envelope.json"].end());
    return {std::move(whole), std::move(texts)};
}

}  // namespace

std::vector<Encoded> job_seeds() {
    auto [whole, texts] = packed(some_job());
    auto [sawn, sawn_texts] = packed(sawn_job());
    const auto cell = [](const std::string& name) { return read_file(QCHOPPER_SOURCE_DIR "/cells/" + name + ".toml"); };
    std::string small =
        "version = 2\nname = \"test\"\nid = 7\n[margin]\nspoil = 0\n"
        "[reach]\nmin = [-1200, -1200, 0]\nmax = [1200, 1200, 1400]\n"
        "[table]\ncentre = [0, 50]\nsize = [2200, 1600]\nheight = 150\n"
        "[[stock]]\nname = \"small\"\nsize = [300, 200, 100]\nmaterial = \"eps\"\n"
        "[[tool]]\nnumber = 3\nname = \"ball 20\"\nshape = \"ball\"\ndiameter = 20\nflute_length = 100\n"
        "stick_out = 150\nholder = [[40, 50]]\nfeed_mm_per_s = [20, 150]\nrpm = [6000, 18000]\nmass_kg = "
        "1\nremoval_mm3_per_s = 24000\n"
        "length_measured = true\n[link]\nto = \"[::1]:15020\"\ndrop = \"drop\"\n";
    parse_cell(small, "small");
    return {{"job", "packed", whole},
            {"job", "texts", texts},
            {"job", "sawn", sawn},
            {"job", "sawn-texts", sawn_texts},
            {"cell", "foam-1", cell("foam-1")},
            {"cell", "robot", cell("kr120-r2500-pro-rotary")},
            {"cell", "gantry", cell("gantry-3axis")},
            {"cell", "small", {small.begin(), small.end()}}};
}

}  // namespace qchopper
