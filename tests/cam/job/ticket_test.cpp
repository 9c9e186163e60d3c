#include "cam/job/ticket.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"

namespace qchopper {
namespace {

TicketTemplate some_template() {
    TicketTemplate about;
    about.piece = "AB";
    about.piece_no = 65535;
    about.piece_count = 65535;
    for (std::size_t i = 0; i < 16; ++i) about.project_id[i] = static_cast<std::uint8_t>(240 + i);
    about.box = {{-1.0 / 3, -2e-17, 0}, {0.1, 1e3, 123456.789}};
    about.stock = {300, 200.5, 100};
    about.material = Material::xps;
    about.tool_no = 9;
    about.tool_diameter = 12.7;
    about.spindle_max_rpm = 24000;
    about.feed_max_mm_per_min = 4294967295;
    about.estimated_time_s = 4294967295;
    about.base_plane = 3;
    return about;
}

TEST(Ticket, JsonForthAndBackIsIdentity) {
    EXPECT_EQ(ticket_template_from_json(to_json(some_template()), "t"), some_template());
    EXPECT_EQ(ticket_template_from_json(to_json({}), "t"), TicketTemplate{});
}

TEST(Ticket, BadJsonIsRefusedWithSourceAndKey) {
    const std::string good = to_json(some_template());
    const auto refused = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        try {
            ticket_template_from_json(text, "AB.qjob");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    EXPECT_NE(refused("\"piece_no\": 65535", "\"piece_no\": 65536").find("AB.qjob: ticket template: piece_no"),
              std::string::npos);
    EXPECT_NE(refused("\"tool_no\": 9", "\"tool_no\": 9.5").find("tool_no"), std::string::npos);
    EXPECT_NE(refused("\"tool_no\": 9,", "").find("tool_no is missing"), std::string::npos);
    EXPECT_NE(refused("12.7", "1e999"), "taken");
    EXPECT_NE(refused("\"ticket_version\": 1", "\"ticket_version\": 2").find("ticket_version"), std::string::npos);
    EXPECT_NE(refused("f0f1", "F0f1").find("project_id"), std::string::npos);
    EXPECT_NE(refused("{", "["), "taken");
    EXPECT_THROW(ticket_template_from_json("", "t"), InputError);
    EXPECT_THROW(ticket_template_from_json(std::string(100000, '['), "t"), InputError);
}

TEST(Ticket, CrudeTimeStaysInBounds) {
    EXPECT_EQ(crude_time_s(1000, 400, 60), 10U);
    EXPECT_EQ(crude_time_s(1000, 400, 599), 2U);
    EXPECT_EQ(crude_time_s(1, 2, 60), 1U) << "a piece larger than its block still takes a second";
    EXPECT_EQ(crude_time_s(1e30, 0, 1), std::numeric_limits<std::uint32_t>::max());
}

}  // namespace
}  // namespace qchopper
