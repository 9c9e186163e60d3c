#include "app/report/command_line_text.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/report/notices.h"

namespace qchopper {
namespace {

TEST(CommandLineText, WithoutAKeyIsTheTextItself) {
    EXPECT_EQ(command_line_text(Sentence("check the {scan}, or [another]")), "check the {scan}, or [another]");
    EXPECT_EQ(command_line_text(Sentence()), "");
}

TEST(CommandLineText, OfAKeyNamesTheOptionAndTheTextDoesNot) {
    const Sentence unit = Sentence::with_key("give_unit", {}, "give the unit");
    EXPECT_EQ(command_line_text(unit), "pass --units mm, cm, m or in");
    EXPECT_EQ(unit.text, "give the unit");
}

TEST(CommandLineText, HasValuesInTheirPlacesAndQuotesWhatIsAWord) {
    const Sentence more = Sentence::with_key("more_orientations", {"12", "a b.qch", "C"}, "more: 12");
    EXPECT_EQ(command_line_text(more), "more tool orientations: qchopper setup 'a b.qch' --piece C --orientations 12");
}

TEST(CommandLineText, LeavesOutWhatHasNoValue) {
    const auto of = [](const char* piece, const char* to, const char* drop) {
        return command_line_text(Sentence::with_key("dispatch", {"p.qch", piece, to, drop}, "hand it over"));
    };
    EXPECT_EQ(of("", "", ""), "qchopper dispatch p.qch");
    EXPECT_EQ(of("B", "", "DIR"), "qchopper dispatch p.qch --piece B --drop DIR");
    EXPECT_EQ(of("", "HOST:PORT", ""), "qchopper dispatch p.qch --to HOST:PORT");
}

TEST(CommandLineText, OfAValueWithAKeyIsThatOfTheCommandLineToo) {
    const Sentence first = Sentence::with_key(
        "look_first", {"", Sentence::with_key("accept_memory", {"h:5"}, "accept it")}, "look, then accept it");
    EXPECT_EQ(command_line_text(first),
              "Go to the cell and look whether it cuts. Ask it: qchopper cell status. Look at the cell and what it has "
              "cut, then accept its memory: qchopper cell accept-store --to h:5");
}

// Values come from files and cells.
TEST(CommandLineText, DoesNotReadAValueAsARow) {
    const Sentence list = Sentence::with_key("discarded", {"{0}, [B], {word 7}"}, "discarded");
    EXPECT_EQ(command_line_text(list),
              "Discarded: {0}, [B], {word 7}; --undo brings back what this decision left out.");
}

TEST(ErrorDocument, HasTheWordsOfTheCommandLineAndTheKeyForAPage) {
    const Sentence tilt =
        Sentence::with_key("larger_tilt", {"a tilt", Sentence::with_key("another_cut", {"p", "B"}, "cut")}, "tilt it");
    const auto keyed = nlohmann::json::parse(text_of(error_document("what", "unchanged", tilt, 66)));
    EXPECT_EQ(keyed["to_do"], "a tilt, or another cut: qchopper segment p --piece B --step");
    EXPECT_EQ(keyed["remedy"]["text"], "tilt it");
    EXPECT_EQ(keyed["remedy"]["key"], "larger_tilt");
    EXPECT_EQ(keyed["remedy"]["values"][0], nlohmann::json::parse(R"({"text": "a tilt", "key": "", "values": []})"));
    EXPECT_EQ(keyed["remedy"]["values"][1]["values"][1]["text"], "B");
    EXPECT_EQ(keyed["exit_code"], 66);
    const auto plain = nlohmann::json::parse(text_of(error_document("what", "unchanged", "wait", 75)));
    EXPECT_EQ(plain["to_do"], "wait");
    EXPECT_EQ(plain["remedy"], nullptr);
}

}  // namespace
}  // namespace qchopper
