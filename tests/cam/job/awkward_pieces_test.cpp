// Setups and jobs of pieces and cells that are extreme: no crash, finite figures, shares from 0 to 1, and the same
// bytes for any number of threads.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "cam/job/read_job.h"
#include "cam/job/sheet/setup_sheet.h"
#include "cam/job/sheet/sheet_details.h"
#include "cam/job/write_job.h"
#include "segment/access/tool_directions.h"
#include "tests/cam/job/some_job.h"
#include "tests/cam/setup/solids.h"

namespace qchopper {
namespace {

using namespace test_pieces;

Cell robot_cell() {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    cell.machine->max_tilt = 60 * std::numbers::pi / 180;
    return cell;
}

// A piece of a convex mesh: triangles for which `is_cap` is true become caps, one cut for each.
Piece with_caps(TriangleMesh mesh, const std::function<bool(Vec3 normal)>& is_cap) {
    Piece piece{"A", nullptr, {}};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 out = normalized(area_vector(mesh, t));
        if (!is_cap(out)) {
            mesh.cap_of.push_back(no_cap);
            continue;
        }
        const Plane plane{out, dot(out, corners_of(mesh, t)[0])};
        const auto same = std::find_if(piece.half_spaces.begin(), piece.half_spaces.end(),
                                       [&](const HalfSpace& h) { return dot(h.plane.normal, out) > 1 - 1e-9; });
        const auto cut = static_cast<std::int32_t>(same - piece.half_spaces.begin());
        if (same == piece.half_spaces.end()) piece.half_spaces.push_back({cut, plane, false});
        mesh.cap_of.push_back(cut);
    }
    piece.mesh = std::make_shared<TriangleMesh>(std::move(mesh));
    return piece;
}

bool every_side(Vec3) {
    return true;
}
bool underside(Vec3 out) {
    return out.z < -0.999;
}

TriangleMesh tetrahedron(double size) {
    TriangleMesh mesh;
    mesh.points = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}, {0, 0, size}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    return mesh;
}

// Every triangle of the shape a second time: both shells lie in the same place.
TriangleMesh doubled(const TriangleMesh& mesh) {
    return shapes::joined({mesh, mesh});
}

TriangleMesh scaled(TriangleMesh mesh, Vec3 by) {
    for (Vec3& p : mesh.points) p = {p.x * by.x, p.y * by.y, p.z * by.z};
    return mesh;
}

// A box with a triangle without area in one of its edges.
TriangleMesh with_flat_triangles() {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {30, 20, 10});
    const Triangle first = mesh.triangles.front();
    const auto middle = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.push_back(0.5 * (mesh.points[first[0]] + mesh.points[first[1]]));
    mesh.triangles.front() = {middle, first[1], first[2]};
    mesh.triangles.push_back({first[0], middle, first[2]});
    mesh.triangles.push_back({first[0], first[1], middle});
    return mesh;
}

std::vector<Piece> awkward_pieces() {
    std::vector<Piece> pieces;
    const auto add = [&](const char* name, Piece piece) {
        piece.name = name;
        pieces.push_back(std::move(piece));
    };
    add("TETRA", uncut(tetrahedron(40)));
    add("TETRACUT", with_caps(tetrahedron(40), underside));
    add("TETRACAPS", with_caps(tetrahedron(40), every_side));
    add("BOXCAPS", with_caps(shapes::box({0, 0, 0}, {40, 30, 20}), every_side));
    add("SLAB", uncut(shapes::box({0, 0, 0}, {90, 50, 0.1})));
    add("SLABCUT", with_caps(shapes::box({0, 0, 0}, {90, 50, 0.1}), underside));
    add("SLABEDGE", with_caps(shapes::box({0, 0, 0}, {90, 0.1, 45}), underside));
    add("FOIL", with_caps(shapes::box({0, 0, 0}, {90, 50, 1e-6}), underside));
    add("GRAIN", uncut(shapes::box({0, 0, 0}, {0.01, 0.01, 0.01})));
    add("HAIR", with_caps(shapes::box({0, 0, 0}, {0.01, 0.01, 45}), underside));
    add("FARGRAIN", uncut(shapes::box({5000, -5000, 5000}, {5000.01, -4999.99, 5000.01})));
    add("FARBALL", uncut(shapes::ball({5000, -5000, 5000}, 20, 8)));
    add("NEEDLES", uncut(scaled(shapes::ball({0, 0, 0}, 1, 24), {45, 0.02, 20})));
    add("DOUBLED", uncut(doubled(shapes::box({0, 0, 0}, {30, 20, 10}, 3))));
    add("FLATTRIANGLES", uncut(with_flat_triangles()));
    add("NESTED", uncut(shapes::nested()));
    return pieces;
}

constexpr double rounding_deg = 1e-5;  // of the angle between nearly equal vectors

void expect_share(double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
}

void expect_direction(const ToolOrientation& orientation, double max_tilt_deg) {
    EXPECT_NEAR(norm(orientation.tool_axis), 1, 1e-9);
    EXPECT_GE(orientation.tilt_deg, 0);
    EXPECT_LE(orientation.tilt_deg, max_tilt_deg + rounding_deg);
    expect_share(orientation.gained_share);
    EXPECT_TRUE(std::isfinite(orientation.depth_mm) && orientation.depth_mm >= 0) << orientation.depth_mm;
}

void expect_sound(const qchopper::Setup& setup, const SetupOptions& options, double max_tilt_deg) {
    const SurfaceAccess& access = setup.access;
    expect_share(access.unreachable_share());
    expect_share(access.all_directions_share);
    expect_share(setup.undercut);
    expect_share(setup.undercut_by_count);
    for (const double part : {access.hidden_mm2, access.steep_mm2, access.holder_mm2, access.too_narrow_mm2}) {
        EXPECT_GE(part, 0);
        EXPECT_LE(part, access.area_mm2 * (1 + 1e-6));
    }
    for (const double value : {access.area_mm2, access.foam_mm3, access.foam_depth_mm, access.rest_material_mm3,
                               setup.base_mm2, setup.projected_area_mm2}) {
        EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
    }
    ASSERT_GE(access.orientations.size(), 1U);
    EXPECT_LE(access.orientations.size(), options.max_directions);
    EXPECT_NEAR(access.orientations.front().tilt_deg, 0, rounding_deg);
    for (const ToolOrientation& orientation : access.orientations) expect_direction(orientation, max_tilt_deg);
    if (access.further) expect_direction(*access.further, max_tilt_deg);
}

JobInput job_of(const Piece& piece, const Cell& cell, SetupChoice choice) {
    JobInput input;
    input.piece = piece;
    input.program_version = "0.1.0";
    input.cell = cell;
    input.setup = choice.setups.front();
    input.stock_fit = check_stock_fit(input.setup, cell);
    input.alternatives.assign(choice.setups.begin() + 1, choice.setups.end());
    input.states = std::move(choice.states);
    return input;
}

// The setups are sound, and so is the job: a figure that is not finite has no form in the manifest and would be
// refused.
void expect_sound(const Piece& piece, const Cell& cell, const SetupOptions& options, double max_tilt_deg) {
    SCOPED_TRACE(piece.name + " in " + cell.name);
    const SetupChoice choice = choose_setup(piece, cell, options);
    ASSERT_FALSE(choice.setups.empty());
    for (const qchopper::Setup& setup : choice.setups) expect_sound(setup, options, max_tilt_deg);
    EXPECT_EQ(choice.states.size(), options.mapped > 0 ? piece.mesh->triangles.size() : 0);
    const JobInput input = job_of(piece, cell, choice);
    const Bytes bytes = job_file(input);
    const ReadJob job = parse_job(bytes, "A.qjob");
    EXPECT_EQ(job.setup.access, input.setup.access);
    if (cell.machine) return;  // what differs in it is not done by several threads

    const ThreadLimit one(1);
    const SetupChoice again = choose_setup(piece, cell, options);
    EXPECT_EQ(again.setups, choice.setups);
    EXPECT_EQ(again.states, choice.states);
    EXPECT_EQ(job_file(job_of(piece, cell, again)), bytes);
}

SetupOptions few_samples() {
    SetupOptions options;
    options.samples = 400;
    return options;
}

TEST(AwkwardPiece, HasASoundSetupAndJob) {
    for (const Piece& piece : awkward_pieces()) expect_sound(piece, cell(), few_samples(), default_tilt_deg);
}

TEST(AwkwardPiece, HasASoundSetupAndJobInARobotCell) {
    SetupOptions options = few_samples();
    options.count_narrow = true;
    const std::vector<Piece> pieces = awkward_pieces();
    for (const std::size_t i : {1U, 5U, 9U, 10U}) expect_sound(pieces[i], robot_cell(), options, 60);
}

TEST(AwkwardPiece, IsJudgedAtBothEndsOfTheTilt) {
    for (const double tilt : {0.0, 90.0}) {
        SetupOptions options = few_samples();
        options.max_tilt_deg = tilt;
        options.mapped = 1;
        for (const char* name : {"TETRACUT", "SLABEDGE", "NEEDLES"}) {
            for (const Piece& piece : awkward_pieces()) {
                if (piece.name != name) continue;
                expect_sound(piece, cell(), options, tilt);
                expect_sound(piece, robot_cell(), options, tilt);
            }
        }
    }
}

TEST(AwkwardPiece, IsMilledFromAboveAloneWhereOneDirectionIsAllowed) {
    SetupOptions options = few_samples();
    options.max_directions = 1;
    options.mapped = 0;
    for (const Piece& piece : awkward_pieces()) expect_sound(piece, cell(), options, default_tilt_deg);
}

// No cut makes a cap that is the whole surface: its area along its normal is zero, and nothing is left to sample.
TEST(AwkwardPiece, MayBeOneCapAllAround) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 20});
    mesh.cap_of.assign(mesh.triangles.size(), 0);
    const Piece piece{"A", std::make_shared<TriangleMesh>(mesh), {{0, {{0, 0, 1}, 0}, true}}};
    expect_sound(piece, cell(), few_samples(), default_tilt_deg);
}

// Stands on its cap, with a shaft 40 mm wide and 110 mm deep.
Piece shaft() {
    TriangleMesh mesh = cell_solid(steps(0, 100, 10), steps(0, 100, 10), {0, 10, 120}, [](Vec3 p) {
        return p.z < 10 || std::abs(p.x - 50) > 20 || std::abs(p.y - 50) > 20;
    });
    return {"A", std::make_shared<TriangleMesh>(std::move(mesh)), {{0, {{0, 0, 1}, 0}, true}}};
}

Cell with_stick_out(double mm) {
    Cell cell = robot_cell();
    for (CuttingTool& tool : cell.machine->tools) tool.stick_out = mm;
    return cell;
}

TEST(ShortTool, DoesNotReachIntoACavityAndTheSheetSaysSo) {
    const Piece piece = shaft();
    const auto chosen = [&](double stick_out) {
        SetupOptions options = few_samples();
        options.base = 0;
        return choose_setup(piece, with_stick_out(stick_out), options);
    };
    const SetupChoice reaching = chosen(250);
    const SetupChoice choice = chosen(60);
    const SurfaceAccess& access = choice.setups.front().access;
    EXPECT_GE(access.holder_mm2, 0.9 * 40 * 40) << "the floor of the shaft at least";
    EXPECT_LT(reaching.setups.front().access.holder_mm2, 0.1 * access.holder_mm2);
    EXPECT_GE(access.unreachable_mm2(), access.holder_mm2) << "it counts";
    EXPECT_NE(std::count(choice.states.begin(), choice.states.end(), SurfaceState::holder), 0);
    JobInput input = job_of(piece, with_stick_out(60), choice);
    input.max_unreachable = 0.02;
    EXPECT_TRUE(is_unreachable(input.setup, input.max_unreachable));
    const std::string sheet = setup_sheet(input, 60);
    EXPECT_NE(sheet_details(input).find("the tool is too short: its holder would touch"), std::string::npos);
    EXPECT_NE(sheet.find("The state of this job is &quot;unreachable&quot;"), std::string::npos);
}

// What the holder keeps out of a narrow shaft is not counted a second time as too narrow.
TEST(ShortTool, AndTooWideIsCountedOnce) {
    Cell in = with_stick_out(1);
    for (CuttingTool& tool : in.machine->tools) tool.diameter = 38;
    for (CuttingTool& tool : in.machine->tools) tool.holder = {{200, 300}};
    SetupOptions options = few_samples();
    options.base = 0;
    options.count_narrow = true;
    const SurfaceAccess access = choose_setup(shaft(), in, options).setups.front().access;
    const double parts = access.hidden_mm2 + access.steep_mm2 + access.holder_mm2 + access.too_narrow_mm2;
    EXPECT_GT(access.holder_mm2, 0);
    EXPECT_LE(parts, access.area_mm2 * (1 + 1e-6));
    expect_share(access.unreachable_share());
    expect_sound(shaft(), in, options, 60);
}

// Standing it is 160 mm high, lying 60 mm; both bases are sides of one box.
TEST(BaseThatNoBlockHolds, IsTakenAfterOneThatFits) {
    const Piece piece =
        with_caps(shapes::box({0, 0, 0}, {60, 60, 160}, 4), [](Vec3 out) { return out.z < -0.999 || out.x < -0.999; });
    Cell low = cell();
    low.stock = {{"low", {200, 100, 80}, Material::eps}};
    Cell high = cell();
    high.stock = {{"high", {100, 100, 200}, Material::eps}};
    for (const auto& [in, height] : {std::pair{low, 60.0}, std::pair{high, 160.0}}) {
        const SetupChoice choice = choose_setup(piece, in, few_samples());
        ASSERT_EQ(choice.setups.size(), 2U);
        EXPECT_NEAR(choice.setups[0].box.size().z, height, 1e-9);
        EXPECT_TRUE(check_stock_fit(choice.setups[0], in).fits());
        EXPECT_TRUE(choice.setups[0].block.holds);
        EXPECT_FALSE(check_stock_fit(choice.setups[1], in).fits());
        EXPECT_FALSE(choice.setups[1].block.holds);
        EXPECT_TRUE(fits_cell(piece, in));
    }
}

TEST(LargePiece, ThatNoBlockHoldsIsStillLaidAndTheSentenceSaysWhatLacks) {
    const Piece piece = standing_box({0, 0, 0}, {5000, 4000, 3000}, 0, 4);
    const SetupChoice choice = choose_setup(piece, cell(), few_samples());
    const qchopper::Setup& setup = choice.setups.front();
    EXPECT_FALSE(setup.block.holds);
    EXPECT_FALSE(fits_cell(piece, cell()));
    expect_sound(setup, few_samples(), default_tilt_deg);
    const std::string sentence = describe_stock_fit("A", check_stock_fit(setup, cell()));
    for (const char* word :
         {"piece A does not fit: ", "too long for block", "too wide for block", "too high for block"}) {
        EXPECT_NE(sentence.find(word), std::string::npos) << sentence;
    }
}

TEST(SawnBlock, WhoseSawCutIsWiderThanTheRestIsTakenWholeAndTheSheetSaysSo) {
    JobInput input = some_job();
    input.cell = robot_cell();
    const Vec3 needed = choose_setup(input.piece, input.cell, few_samples()).setups.front().box.size() +
                        Vec3{10, 10, 3 + margins_of(input.cell).spoil};
    // On its side it holds the piece, and there is less beside it than the saw takes.
    input.cell.stock = {{"plank", {needed.z + 2, needed.x + 2, needed.y + 2}, Material::eps, true, 4}};
    const SetupChoice choice = choose_setup(input.piece, input.cell, few_samples());
    input = job_of(input.piece, input.cell, choice);
    const StockBlock& block = input.setup.block;
    EXPECT_TRUE(block.holds);
    EXPECT_TRUE(block.offcuts.empty());
    const std::string sheet = setup_sheet(input, 60);
    EXPECT_EQ(sheet.find("Saw it down"), std::string::npos);
    EXPECT_NE(sheet.find("Not sawn"), std::string::npos);
    EXPECT_EQ(parse_job(job_file(input), "A.qjob").setup.block, block);
}

}  // namespace
}  // namespace qchopper
