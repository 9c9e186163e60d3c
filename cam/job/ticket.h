// The job ticket: the data about one job that are sent to the cell before the job starts.
//
// Every job file holds a ticket template. job_ticket() binds it to the file, and dispatch adds job id and time. Lengths
// in mm in setup coordinates, the base frame of the robot program.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/box.h"
#include "base/sha256.h"
#include "base/uuid.h"
#include "cam/cell/material.h"

namespace qchopper {

constexpr std::uint16_t no_base_plane = 0xFFFF;

// What is known when the job is written. The same piece, setup and cell give the same template.
struct TicketTemplate {
    std::string piece;           // name of the piece
    std::uint16_t piece_no = 0;  // 1..piece_count
    std::uint16_t piece_count = 0;
    Uuid project_id{};  // first 16 bytes of a SHA-256 over scan and decisions
    Box box;            // of the piece in setup coordinates
    Vec3 stock;         // size of the block as it stands
    Material material = Material::unspecified;
    std::uint16_t tool_no = 0;
    double tool_diameter = 0;
    std::uint16_t spindle_max_rpm = 0;
    std::uint32_t feed_max_mm_per_min = 0;
    std::uint32_t estimated_time_s = 0;
    std::uint16_t base_plane = no_base_plane;  // number of the cut whose cap lies on the table
    std::uint16_t part = 0;  // 1..parts of a piece that several jobs mill in one clamping; both 0: undivided
    std::uint16_t parts = 0;
    bool operator==(const TicketTemplate&) const = default;
};

// A template bound to one job file.
struct JobTicket {
    TicketTemplate about;
    std::string file_name;  // is_portable_name
    std::uint32_t file_size = 0;
    Sha256 file_sha256;
    bool operator==(const JobTicket&) const = default;
};

// The words of materials in documents (base/json_fields.h).
struct MaterialNames {
    std::string operator()(Material material) const { return to_word(material); }
    std::optional<Material> operator()(std::string_view word) const { return material_of(word); }
    std::string refusal() const { return "is not one of the known materials"; }
};
inline MaterialNames names_of(Material /*any*/) {
    return {};
}

// The template as a JSON text of one object. Precondition: all numbers are finite.
std::string to_json(const TicketTemplate& about);
// The inverse of to_json (tests/cam/job/ticket_test.cpp). Throws InputError (mesh) naming `source` and the key if a
// value is missing, of another kind or beyond what the registers hold, or if the text is not in the form that to_json
// writes.
TicketTemplate ticket_template_from_json(std::string_view text, const std::string& source);

// The volume of foam to remove over the removal rate, rounded up to whole seconds, 1 to 2^32 - 1. Crude: without
// finishing, travel and acceleration.
std::uint32_t crude_time_s(double stock_mm3, double piece_mm3, double removal_mm3_per_s);

// Rounded up to whole seconds, 1 to 2^32 - 1.
std::uint32_t whole_seconds(double seconds);

}  // namespace qchopper
