#include "tests/data_flow/data_flow.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <set>

#include "app/dispatch/simulated_limits.h"
#include "cam/job/read_job.h"
#include "cam/job/write_job.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/setup.h"
#include "cam/setup/stock_fit.h"
#include "devices/hand_off/dispatch.h"
#include "devices/wire/modbus_tcp.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "sim/cell/cell_sim.h"

namespace qchopper::walk {
namespace {

namespace fs = std::filesystem;

void expect_closed(const TriangleMesh& mesh, const std::string& what) {
    EXPECT_TRUE(edges(mesh).faults.is_closed()) << what;
    EXPECT_GT(volume_mm3(mesh), 0) << what;
}

void expect_nothing_is_lost(const Segmentation& segmentation, double scan_volume) {
    double sum = 0;
    std::set<std::string> names;
    for (const Piece& piece : segmentation.pieces) {
        expect_closed(*piece.mesh, "piece " + piece.name);
        EXPECT_TRUE(names.insert(piece.name).second) << piece.name;
        sum += volume_mm3(*piece.mesh);
    }
    for (const Fragment& fragment : segmentation.fragments) {
        expect_closed(*fragment.mesh, "a fragment of cut " + std::to_string(fragment.cut));
        EXPECT_EQ(fragment.volume_mm3, volume_mm3(*fragment.mesh));
        sum += fragment.volume_mm3;
    }
    EXPECT_NEAR(sum, scan_volume, 1e-9 * scan_volume);
    for (const Cut& cut : segmentation.cuts) {
        // A piece that was cut is no piece any more, and its name is not given again.
        EXPECT_FALSE(names.contains(cut.piece)) << cut.piece;
    }
}

// The solid in the file is the piece, turned and in single precision.
void expect_same_solid(const ReadJob& job, const Piece& piece) {
    const RawMesh carved = parse_mesh(job.files.at("piece.stl"), piece.name + "/piece.stl");
    EXPECT_EQ(carved.faces_in_file, piece.mesh->triangles.size());
    const double volume = volume_mm3(*piece.mesh);
    const double size = norm(bounds(*piece.mesh).size());
    // A float holds 2^-24 of a coordinate; moved over the whole surface that is so much volume at most.
    const double tolerance = area_mm2(*piece.mesh) * size * std::ldexp(1.0, -24);
    EXPECT_NEAR(volume_mm3(carved.mesh), volume, tolerance) << piece.name;
    EXPECT_EQ(job.volume_mm3, volume);
    EXPECT_GE(bounds(carved.mesh).min.z, -1e-3) << "the base lies on the table";
}

void expect_sound(const ReadJob& job, const fs::path& file) {
    EXPECT_EQ(job.file_sha256, sha256(read_file(file)));
    EXPECT_EQ(job.entries.size() + 1, job.files.size()) << "the manifest lists every file but itself";
    for (const JobEntry& entry : job.entries) {
        EXPECT_EQ(entry.sha256, sha256(job.files.at(entry.name))) << entry.name;
        EXPECT_EQ(entry.size, job.files.at(entry.name).size()) << entry.name;
    }
}

}  // namespace

Cell foam_cell() {
    return read_cell(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "foam-1.toml");
}

Segmentation cut_up(const TriangleMesh& scan, SearchSettings settings) {
    const double volume = volume_mm3(scan);
    settings.objectives.fragment_volume_mm3 = 1e-5 * volume;
    Segmentation segmentation = uncut(scan, settings.objectives.fragment_volume_mm3);
    expect_nothing_is_lost(segmentation, volume);
    const auto on_cut = [&](const Segmentation& s) { expect_nothing_is_lost(s, volume); };
    EvaluationCache cache(settings.objectives, settings.candidates);
    const SearchEnd end = search(segmentation, settings, cache, {}, on_cut, {});
    EXPECT_TRUE(end.is_finished()) << end.sentence;
    return segmentation;
}

std::vector<PieceJob> write_jobs(const Segmentation& segmentation, const ImportedScan& scan, const Cell& cell,
                                 const fs::path& folder) {
    std::vector<PieceJob> jobs;
    JobInput input;
    input.piece_no = 0;
    input.piece_count = static_cast<std::uint16_t>(segmentation.pieces.size());
    input.program_version = "0.0.0";
    input.project_id.fill(3);
    input.scan_sha256 = scan.sha256;
    input.cell = cell;
    for (const Piece& piece : segmentation.pieces) {
        ++input.piece_no;
        input.piece = piece;
        input.setup = choose_setup(piece, cell).setups.front();
        input.stock_fit = check_stock_fit(input.setup, cell);
        EXPECT_TRUE(input.stock_fit.fits()) << describe_stock_fit(piece.name, input.stock_fit);
        const Bytes bytes = job_file(input);
        EXPECT_EQ(bytes, job_file(input)) << "same input, same bytes";
        jobs.push_back({piece.name, folder / job_file_name(piece.name)});
        write_file(jobs.back().file, bytes);
        const ReadJob job = parse_job(read_job(jobs.back().file), jobs.back().file.string());
        EXPECT_EQ(job.setup, input.setup);
        EXPECT_EQ(job.scan_sha256, scan.sha256);
        expect_sound(job, jobs.back().file);
        expect_same_solid(job, piece);
    }
    return jobs;
}

void run_jobs(const std::vector<PieceJob>& jobs, const Cell& cell, const fs::path& folder) {
    const fs::path drop = folder / "drop";
    fs::create_directory(drop);
    CellSimOptions options;
    options.limits = simulated_limits(cell);
    options.limits.speed = 100'000;
    options.limits.acting_ms = 20;
    options.drop_folder = drop;
    CellSim sim(options);
    sim.start();
    ModbusTcpBus bus({"127.0.0.1", sim.port()});
    DispatchOptions dispatch;
    dispatch.cell_id = cell.id;
    dispatch.drop_folder = drop;
    dispatch.timings.poll_s = 0.02;
    std::uint32_t started = 0;
    for (const PieceJob& job : jobs) {
        const Bytes file = read_job(job.file);
        const JobTicket ticket = job_ticket(parse_job(file, job.file.string()), job.file.filename().string());
        EXPECT_EQ(ticket.about.piece, job.piece);
        const JobOutcome outcome = dispatch_job(bus, ticket, file, dispatch, {});
        EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << job.piece << ": " << outcome.why;
        EXPECT_EQ(outcome.job_state, JobState::ended) << outcome.why;
        EXPECT_EQ(outcome.job_result, JobResult::complete);
        EXPECT_TRUE(outcome.starts_known);
        EXPECT_EQ(outcome.starts, 1U);
        EXPECT_TRUE(outcome.simulated);
        EXPECT_EQ(sim.status().starts_total, ++started);
    }
}

}  // namespace qchopper::walk
