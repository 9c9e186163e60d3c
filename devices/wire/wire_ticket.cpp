// Makes a WireTicket of a JobTicket: scales lengths in mm to integers, rounds them, and checks that they fit.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "base/error.h"
#include "base/files/portable_name.h"
#include "devices/wire/codec.h"

namespace qchopper {
namespace {

[[noreturn]] void refuse(const JobTicket& ticket, const std::string& why) {
    throw InputError(InputFault::use, "the job of piece '" + ticket.about.piece + "' cannot be put in a ticket: " + why,
                     "Prepare the project again.");
}

std::int32_t hundredths(const JobTicket& ticket, double length, const char* what) {
    const double scaled = std::round(length * 100);
    if (!(std::abs(scaled) <= std::numeric_limits<std::int32_t>::max())) {
        refuse(ticket, std::string(what) + " is not a number or too large for the ticket");
    }
    return static_cast<std::int32_t>(scaled);
}

std::array<std::int32_t, 3> hundredths(const JobTicket& ticket, Vec3 lengths, const char* what) {
    return {hundredths(ticket, lengths.x, what), hundredths(ticket, lengths.y, what),
            hundredths(ticket, lengths.z, what)};
}

std::uint32_t thousandths(const JobTicket& ticket, double length, const char* what) {
    const double scaled = std::round(length * 1000);
    if (!(scaled >= 0 && scaled <= std::numeric_limits<std::uint32_t>::max())) {
        refuse(ticket, std::string(what) + " is not a number or too large for the ticket");
    }
    return static_cast<std::uint32_t>(scaled);
}

}  // namespace

WireTicket wire_ticket(const JobTicket& ticket, const WireTicket& order) {
    if (!is_portable_name(ticket.file_name)) {
        refuse(ticket, "'" + ticket.file_name +
                           "' is not a file name that a cell accepts (1 to 32 of A-Z a-z 0-9 . _ -, no dot in front)");
    }
    WireTicket t = order;
    t.file_sha256 = ticket.file_sha256;
    t.file_size = ticket.file_size;
    t.file_name = ticket.file_name;
    t.box_min = hundredths(ticket, ticket.about.box.min, "the box of the piece");
    t.box_max = hundredths(ticket, ticket.about.box.max, "the box of the piece");
    t.stock = hundredths(ticket, ticket.about.stock, "the size of the stock");
    t.material = static_cast<std::uint16_t>(ticket.about.material);
    t.tool_no = ticket.about.tool_no;
    t.tool_diameter_um = thousandths(ticket, ticket.about.tool_diameter, "the diameter of the tool");
    t.spindle_max_rpm = ticket.about.spindle_max_rpm;
    t.feed_max_mm_per_min = ticket.about.feed_max_mm_per_min;
    t.estimated_time_s = ticket.about.estimated_time_s;
    t.base_plane = ticket.about.base_plane;
    t.piece_no = ticket.about.piece_no;
    t.piece_count = ticket.about.piece_count;
    t.project_id = ticket.about.project_id;
    t.part = ticket.about.part;
    t.parts = ticket.about.parts;
    return t;
}

bool WireTicket::is_restart() const {
    const std::size_t at = file_name.rfind(".r");
    if (at == std::string::npos) return false;
    const std::size_t digits = file_name.find_first_not_of("0123456789", at + 2);
    return digits != std::string::npos && digits > at + 2 && file_name.substr(digits) == ".qjob";
}

}  // namespace qchopper
