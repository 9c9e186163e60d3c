// The bytes that docs/user/cell-integration.md shows, sent to a simulated cell.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <thread>

#include "devices/wire/codec.h"
#include "tests/sim/cell/cell_rig.h"
#include "tests/sim/cell/integration_examples.h"

namespace qchopper {
namespace {

std::string page() {
    std::ifstream file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "docs" / "user" / "cell-integration.md");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

const std::string begins = "<!-- examples -->\n";
const std::string ends = "<!-- end of examples -->\n";

std::string examples_of_page() {
    const std::string text = page();
    const std::size_t from = text.find(begins) + begins.size();
    return text.substr(from, text.find(ends) - from);
}

struct Shown {
    std::string title;
    Bytes request;
    Bytes answer;
};

// The bytes after > and <, whatever the spaces and line ends are.
std::vector<Shown> shown_requests() {
    std::vector<Shown> all;
    std::istringstream lines(examples_of_page());
    Bytes* into = nullptr;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("**")) all.push_back({line, {}, {}});
        if (line.starts_with("```")) into = nullptr;
        if (line.starts_with(">")) into = &all.back().request;
        if (line.starts_with("<")) into = &all.back().answer;
        std::istringstream words(line.substr(std::min<std::size_t>(1, line.size())));
        for (std::string word; into != nullptr && words >> word;) {
            if (word.size() == 2 && word != "..")
                into->push_back(static_cast<std::uint8_t>(std::stoul(word, nullptr, 16)));
        }
    }
    return all;
}

TEST(IntegrationPage, ShowsWhatTheTablesPrint) {
    EXPECT_EQ(examples_of_page(), print_examples()) << "write print_examples() between the marks of the page";
}

// TOKEN and CRC of a COMMAND: the cell draws the token.
void put_token(Bytes& frame, std::uint32_t token) {
    constexpr std::size_t first = 13;  // MBAP header, function, address, count, number of bytes
    Registers block;
    for (std::size_t i = first; i + 1 < frame.size(); i += 2) {
        block.push_back(static_cast<std::uint16_t>(frame[i] << 8U | frame[i + 1]));
    }
    Command command = decode<Command>(block).value;
    ASSERT_EQ(command.token, example_token);
    command.token = token;
    const Bytes bytes = bytes_of(encode(command));
    std::copy(bytes.begin(), bytes.end(), frame.begin() + first);
}

std::uint32_t seq_of(const Bytes& frame) {
    constexpr std::size_t first = 13;
    const std::size_t at = first + 2 * address_of(command_block, "CMD_SEQ");
    return static_cast<std::uint32_t>(frame.at(at)) << 24U | static_cast<std::uint32_t>(frame.at(at + 1)) << 16U |
           static_cast<std::uint32_t>(frame.at(at + 2)) << 8U | frame.at(at + 3);
}

TEST(IntegrationPage, EachRequestIsAnsweredByTheSimulatedCellAsShown) {
    const rig::Folder folder;
    CellSimOptions options = rig::quick_cell(folder.path);
    CellSim cell(options);
    cell.start();
    const rig::RawSocket socket(cell.port());
    const std::vector<WorkedRequest> wanted = worked_requests();
    const std::vector<Shown> shown = shown_requests();
    ASSERT_EQ(shown.size(), wanted.size());
    const auto comes = [&](const auto& is_so) {
        for (int n = 0; n < 3000 && !is_so(cell.status()); ++n)
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
        return is_so(cell.status());
    };
    for (std::size_t i = 0; i < shown.size(); ++i) {
        SCOPED_TRACE(shown[i].title);
        Bytes request = shown[i].request;
        if (shown[i].title.find("**Start,") == 0) put_token(request, cell.status().token);
        if (shown[i].title.find("after the end") != std::string::npos) {
            ASSERT_TRUE(comes([](const Status& s) { return s.job_state == JobState::ended; }));
        }
        if (shown[i].title.find("**TICKET**") == 0) {
            ASSERT_TRUE(comes([](const Status& s) { return s.state == PackState::idle; }));
        }
        socket.send(request);
        const std::size_t length = 6U + (static_cast<std::size_t>(shown[i].answer.at(4)) << 8U | shown[i].answer.at(5));
        const Bytes answer = socket.receive(length);
        ASSERT_EQ(answer.size(), length);
        ASSERT_GE(shown[i].answer.size(), 9U);
        EXPECT_TRUE(std::equal(shown[i].answer.begin(), shown[i].answer.end(), answer.begin()));
        if (wanted[i].wanted == AckResult::none) continue;
        const auto is_answered = [&](const Status& s) {
            return s.ack_result != AckResult::pending && s.ack_seq == seq_of(request);
        };
        ASSERT_TRUE(comes(is_answered));
        EXPECT_STREQ(name(cell.status().ack_result), name(wanted[i].wanted));
    }
    EXPECT_EQ(cell.status().starts_total, 1U);
    EXPECT_EQ(cell.status().owner_held, 0U);
}

}  // namespace
}  // namespace qchopper
