#include "base/json_fields.h"

#include <gtest/gtest.h>

#include "base/enum_names.h"

namespace qchopper {
namespace {

enum class Colour { red, blue };
constexpr auto names_of(Colour) {
    return EnumNames<Colour, 2>{{{Colour::red, "red"}, {Colour::blue, "blue"}}};
}

struct Inner {
    Vec3 at;
    std::optional<std::int32_t> number;
    bool operator==(const Inner&) const = default;
};

struct Outer {
    std::vector<Inner> list;
    double length = 0;
    Colour colour = Colour::red;
    std::uint8_t usual = 7;
    std::vector<std::string> words;
    bool operator==(const Outer&) const = default;
};

template <class V, Of<Inner> T>
void fields(V& v, T& inner) {
    v("at", inner.at);
    v("number", inner.number);
}

template <class V, Of<Outer> T>
void fields(V& v, T& outer) {
    v.derived(
        "count", [&] { return outer.list.size(); }, "is not that of the list");
    v("list", outer.list);
    v.object("of", [&](auto& of) { of("length_mm", outer.length, json_values::not_negative); });
    v("colour", outer.colour);
    v.maybe("usual", outer.usual, 7);
    v("words", outer.words);
    v.check(outer.words.size() < 3, "words", "are too many");
}

std::string refusal(const std::string& text) {
    try {
        Outer outer;
        json_values::from_document(text, outer);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "taken";
}

// The document of some value with one piece of its text in another form.
std::string refusal_with(const std::string& piece, const std::string& other) {
    std::string text = json_values::to_document(Outer{{{{1, 2, 3}, -4}, {}}, 0.1, Colour::blue, 9, {"a", "b"}});
    return refusal(text.replace(text.find(piece), piece.size(), other));
}

TEST(JsonFields, WhatIsReadIsWhatWasWritten) {
    for (const Outer& outer : {Outer{}, Outer{{{{1, 2, 3}, -4}, {}}, 0.1, Colour::blue, 9, {"a", "b"}}}) {
        Outer read;
        json_values::from_document(json_values::to_document(outer), read);
        EXPECT_EQ(read, outer);
    }
    EXPECT_EQ(json_values::to_document(Outer{}),
              "{\n  \"count\": 0,\n  \"list\": [],\n  \"of\": {\n    \"length_mm\": 0.0\n  },\n  \"colour\": \"red\",\n"
              "  \"words\": []\n}\n");
}

TEST(JsonFields, ARefusalNamesTheKey) {
    EXPECT_EQ(refusal_with("\"count\": 2", "\"count\": 3"), "count is not that of the list");
    EXPECT_EQ(refusal_with("0.1", "-0.1"), "length_mm is out of range");
    EXPECT_EQ(refusal_with("0.1", "\"0.1\""), "length_mm is not a finite number");
    EXPECT_EQ(refusal_with("blue", "green"), "colour is neither red nor blue");
    EXPECT_EQ(refusal_with("\"usual\": 9", "\"usual\": 256"), "usual is not a whole number in bounds");
    EXPECT_EQ(refusal_with("\"usual\": 9", "\"usual\":9"), "is not in the one form in which qchopper writes it");
    EXPECT_EQ(refusal_with("-4", "-4.5"), "number is not a whole number in bounds");
    EXPECT_EQ(refusal_with("\"at\"", "\"to\""), "at is missing");
    EXPECT_EQ(refusal_with("\"a\"", "\"a\", \"c\""), "words are too many");
    EXPECT_EQ(refusal_with("\"a\"", "1"), "words is not a list of texts");
    EXPECT_EQ(refusal("[]"), "count is missing");
    EXPECT_EQ(refusal("{"), "is not JSON from byte 2 on");
    EXPECT_EQ(refusal_with("9", "1e999"), "holds a number that is out of range");
}

}  // namespace
}  // namespace qchopper
