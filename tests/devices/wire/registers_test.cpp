#include "devices/wire/registers.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include "tests/devices/wire/print_registers.h"
#include "tests/devices/wire/print_structured_text.h"

namespace qchopper {
namespace {

TEST(Registers, TheFieldsOfEveryBlockFollowOneAnotherWithoutGapOrOverlap) {
    for (const Block* block : all_blocks()) {
        unsigned next = block->base;
        for (const Field& field : block->fields) {
            EXPECT_EQ(field.address, next) << block->name << " " << field.name;
            next = field.address + field.count;
        }
        EXPECT_EQ(next, block->base + block->count) << block->name;
    }
}

TEST(Registers, ATypeHasItsSize) {
    for (const Block* block : all_blocks()) {
        for (const Field& field : block->fields) {
            const bool is_two = field.type == FieldType::u32 || field.type == FieldType::i32;
            const int size = field.type == FieldType::u16   ? 1
                             : is_two                       ? 2
                             : field.type == FieldType::u64 ? 4
                                                            : field.count;
            EXPECT_EQ(field.count, size) << field.name;
        }
    }
}

TEST(Registers, EveryBlockFitsOneRequest) {
    for (const Block* block : all_blocks()) EXPECT_LE(block->count, block->whole ? 123 : 125) << block->name;
    EXPECT_EQ(chunk_block.count, chunk_head + max_chunk_bytes / 2);
}

TEST(Registers, BlocksOfOneSideDoNotOverlap) {
    for (const Block* one : all_blocks()) {
        for (const Block* other : all_blocks()) {
            if (one == other || one->side != other->side) continue;
            EXPECT_TRUE(one->base + one->count <= other->base || other->base + other->count <= one->base)
                << one->name << " " << other->name;
        }
    }
}

// Addresses that the link was agreed on, written by hand.
TEST(Registers, WellKnownFieldsLieWhereTheyWereAgreed) {
    const auto at = [](const Block& block, const char* field) {
        const Field* found = field_named(block, field);
        return found == nullptr ? -1 : static_cast<int>(found->address);
    };
    EXPECT_EQ(at(status_block, "STATE"), 7);
    EXPECT_EQ(at(status_block, "ACK_RESULT"), 17);
    EXPECT_EQ(at(status_block, "TOKEN"), 28);
    EXPECT_EQ(at(status_block, "JOB_STATE"), 30);
    EXPECT_EQ(at(status_block, "FILE_SHA256"), 69);
    EXPECT_EQ(at(status_block, "STARTS_TOTAL"), 85);
    EXPECT_EQ(at(status_block, "BAD_REASON"), 98);
    EXPECT_EQ(at(result_block, "STARTS"), 210);
    EXPECT_EQ(at(result_block, "QUERY_OWNER"), 244);
    EXPECT_EQ(at(identity_block, "STORE_ID"), 302);
    EXPECT_EQ(at(identity_block, "STORE_CREATED"), 316);
    EXPECT_EQ(identity_block.base + identity_block.count, 324);
    EXPECT_EQ(at(ticket_block, "PART"), 189);
    EXPECT_EQ(at(ticket_block, "PARTS"), 190);
    EXPECT_EQ(at(command_block, "OWNER"), 38);
    EXPECT_EQ(at(ticket_block, "FILE_NAME"), 128);
    EXPECT_EQ(at(ticket_block, "CELL_ID"), 193);
    EXPECT_EQ(at(heartbeat_block, "COUNTER"), 504);
    EXPECT_EQ(at(heartbeat_block, "NO_SUCH_FIELD"), -1);
}

// Offsets and addresses stand in the tables of devices/wire/registers.cpp and nowhere else.
TEST(Registers, NoOffsetStandsOutsideTheTables) {
    const std::regex offset(
        R"((first|subspan|field|skip|axis_address)\(\s*[0-9]{2,}|block\[[0-9]|_(block|field|full|tool), ?[0-9]{2,}|)"
        R"(_at = [0-9]{2,}|::(tool|envelope|ticket_field|store_full), [1-9]|, (58|96|98)\))");
    int files = 0;
    for (const std::string module : {"devices", "sim/cell"}) {
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(QCHOPPER_SOURCE_DIR) / module)) {
            if (entry.path().filename() == "registers.cpp") continue;
            std::ifstream file(entry.path());
            ++files;
            for (std::string line; std::getline(file, line);) {
                EXPECT_FALSE(std::regex_search(line, offset)) << entry.path() << ": " << line;
            }
        }
    }
    EXPECT_GT(files, 30);
}

TEST(Registers, TheNumbersOfTheStatesAreThoseOfPackTags) {
    const char* names[] = {"Undefined", "Clearing",   "Stopped",      "Starting",  "Idle",       "Suspended",
                           "Execute",   "Stopping",   "Aborting",     "Aborted",   "Holding",    "Held",
                           "Unholding", "Suspending", "Unsuspending", "Resetting", "Completing", "Complete"};
    for (std::uint16_t n = 0; n <= last_pack_state; ++n) EXPECT_STREQ(name(static_cast<PackState>(n)), names[n]);
    EXPECT_STREQ(name(static_cast<PackState>(18)), "unknown");
    EXPECT_STREQ(name(static_cast<AckResult>(0x306)), "HASH_MISMATCH");
    EXPECT_STREQ(name(static_cast<AckResult>(0x10B)), "EPOCH_JUMP");
    EXPECT_STREQ(name(static_cast<AckResult>(0x9999)), "unknown result");
}

TEST(Registers, TheDocumentIsWhatTheTablesPrint) {
    std::ifstream file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "docs" / "developer" / "formats" / "registers.md");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), print_registers()) << "write print_registers() to docs/developer/formats/registers.md";
}

TEST(Registers, TheStructuredTextIsWhatTheTablesPrint) {
    std::ifstream file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "docs" / "user" / "cell-integration.st");
    std::stringstream text;
    text << file.rdbuf();
    EXPECT_EQ(text.str(), print_structured_text()) << "write print_structured_text() to docs/user/cell-integration.st";
}

// The simulated cell must not share the logic that it is there to test, and nobody here needs geometry.
TEST(Modules, DevicesAndSimTakeOnlyWhatTheyMay) {
    const std::set<std::string> of_devices{"devices/wire/registers.h",       "devices/wire/packml.h",
                                           "devices/wire/codes.h",           "devices/wire/codec.h",
                                           "devices/wire/register_writer.h", "devices/wire/bus.h",
                                           "devices/wire/layout.h",          "devices/wire/program_block.h",
                                           "devices/wire/ed25519.h",         "devices/wire/ticket_signature.h"};
    int includes = 0;
    for (const std::string module : {"devices", "sim/cell"}) {
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::filesystem::path(QCHOPPER_SOURCE_DIR) / module)) {
            std::ifstream file(entry.path());
            for (std::string line; std::getline(file, line);) {
                if (!line.starts_with("#include \"")) continue;
                const std::string header = line.substr(10, line.rfind('"') - 10);
                ++includes;
                const bool is_own = header.starts_with(module + "/");
                const bool is_allowed = header.starts_with("base/") || header == "cam/job/ticket.h" ||
                                        (module == "sim/cell" && of_devices.contains(header));
                EXPECT_TRUE(is_own || is_allowed) << entry.path() << " includes " << header;
            }
        }
    }
    EXPECT_GT(includes, 30);
}

}  // namespace
}  // namespace qchopper
