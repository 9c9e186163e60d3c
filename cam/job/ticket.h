// The job ticket: what the cell is told about one job before it starts.
//
// A ticket template lies in every job file. Dispatch adds what only it can know: the facts of the file itself, the
// job id and the time. Lengths are millimetres in setup coordinates (the base frame of the program).

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/box.h"
#include "base/sha256.h"
#include "base/uuid.h"
#include "cam/cell/material.h"

namespace qchopper {

constexpr std::uint16_t no_base_plane = 0xFFFF;

// Known when the job is written. The same piece, setup and cell give the same template.
struct TicketTemplate {
    std::string piece;           // name of the piece
    std::uint16_t piece_no = 0;  // 1..piece_count
    std::uint16_t piece_count = 0;
    Uuid project_id{};  // first 16 bytes of a SHA-256 over scan and decisions
    Box box;            // of the piece in setup coordinates
    Vec3 stock;         // size of the block
    Material material = Material::unspecified;
    std::uint16_t tool_no = 0;
    double tool_diameter = 0;
    std::uint16_t spindle_max_rpm = 0;
    std::uint32_t feed_max_mm_per_min = 0;
    std::uint32_t estimated_time_s = 0;
    std::uint16_t base_plane = no_base_plane;  // number of the cut whose cap lies on the table
    bool operator==(const TicketTemplate&) const = default;
};

// A template bound to one job file.
struct JobTicket {
    TicketTemplate about;
    std::string file_name;  // is_portable_name
    std::uint32_t file_size = 0;
    Sha256 file_sha256{};
    bool operator==(const JobTicket&) const = default;
};

// The template as a JSON text of one object, and back; forth and back is identity (tests/cam/job/ticket_test.cpp).
// from_json throws InputError (mesh) that names `source` and the key.
std::string to_json(const TicketTemplate& about);
TicketTemplate ticket_template_from_json(std::string_view text, const std::string& source);

// Foam to be taken away over the removal rate, in whole seconds, at least 1. Crude: it knows no finishing, no travel
// and no acceleration.
std::uint32_t crude_time_s(double stock_mm3, double piece_mm3, double removal_mm3_per_s);

}  // namespace qchopper
