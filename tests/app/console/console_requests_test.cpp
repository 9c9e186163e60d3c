#include "app/console/worker/console_requests.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "app/console/command_words.h"
#include "base/error.h"

namespace qchopper {
namespace {

// Every reader, with a body that is right.
struct Reader {
    std::string name;
    std::string good;
    std::function<void(const std::string&)> read;
};

const std::string plane = "[0.6,0,-0.8,12.5]";

const std::vector<Reader>& readers() {
    static const std::vector<Reader> all{
        {"check", R"({"scan":"ab","units":"mm","deep":true})", read_check},
        {"repair", R"({"fill":"auto","snap_borders_mm":0.5,"alpha_wrap_mm":2,"smooth_pen_grooves":true})", read_repair},
        {"project",
         R"({"check":"C1","name":"skull","units":"mm","scale":2.5,"cell":"foam-1","preset":"carve",)"
         R"("fragment_volume_mm3":5,"size_ok":true,"repair":{"fill":"flat"},"cuts_of":"0f"})",
         read_new_project},
        {"work", R"({"kind":"verify","piece":"A"})", read_work},
        {"ticket", R"({"path":"/api/projects/1/outputs/guide.pdf"})", read_ticket},
        {"cut", R"({"cut":{"piece":"A","plane":)" + plane + R"(,"k":3}})", read_decision},
        {"weights", R"({"weights":{"fragility":1.5}})", read_decision},
        {"discard", R"({"discard":{"pieces":["D","E"]}})", read_decision},
        {"setup", R"({"setup":{"piece":"A","base":2,"orientations":3}})", read_decision},
        {"undo", R"({"undo":"Undo cut 3 on piece C"})", read_decision},
        {"redo", R"({"redo":"Redo reset"})", read_decision},
        {"back_to", R"({"back_to":0})", read_decision},
        {"reset", R"({"reset":true})", read_decision},
        {"rank", R"({"lane":"rank-1","rank":{"piece":"A","weights":{"undercut":2},"top":5}})", read_question},
        {"preview", R"({"preview":{"piece":"A","plane":)" + plane + "}}", read_question},
        {"explain", R"({"explain":{"cut":2}})", read_question},
        {"setups", R"({"setups":{"piece":"A"}})", read_question}};
    return all;
}

void expect_refused(const Reader& reader, const std::string& body) {
    try {
        reader.read(body);
        ADD_FAILURE() << reader.name << " takes " << body.substr(0, 200);
    } catch (const InputError& e) {
        EXPECT_EQ(e.fault, InputFault::use) << body.substr(0, 200);
        EXPECT_FALSE(std::string(e.what()).empty());
        EXPECT_LT(std::string(e.what()).size(), 400U) << "a long body is not said again";
    }
}

TEST(ConsoleRequests, WhatIsRightIsTaken) {
    for (const Reader& reader : readers()) EXPECT_NO_THROW(reader.read(reader.good)) << reader.name;
}

TEST(ConsoleRequests, AKeyThatIsNotKnownIsRefusedAtEveryDepth) {
    for (const Reader& reader : readers()) {
        for (std::size_t at = reader.good.find('{'); at != std::string::npos; at = reader.good.find('{', at + 1)) {
            std::string body = reader.good;
            expect_refused(reader, body.insert(at + 1, R"("tilt":1,)"));
        }
    }
}

TEST(ConsoleRequests, AKeyOfAnotherObjectIsNotKnown) {
    expect_refused(readers()[5], R"({")" + std::string(60'000, 'a') + R"(":1})");
    expect_refused(readers()[5], R"({"cut":{"plane":)" + plane + R"(,"top":3}})");
    expect_refused(readers()[5], R"({"cut":{"plane":)" + plane + R"(},"lane":"x"})");
    expect_refused(readers()[13], R"({"rank":{},"undo":"x"})");
    expect_refused(readers()[6], R"({"weights":{"tilt":1}})");
}

TEST(ConsoleRequests, AValueOfAnotherTypeIsRefused) {
    for (const Reader& reader : readers()) {
        const std::size_t end = reader.good.size() - 1;
        for (std::size_t at = reader.good.find(':'); at != std::string::npos; at = reader.good.find(':', at + 1)) {
            // From the colon to the end of the value, so that all of it is another.
            int depth = 0;
            bool is_text = false;
            std::size_t after = at + 1;
            for (; after < end; ++after) {
                const char c = reader.good[after];
                if (c == '"') is_text = !is_text;
                if (is_text) continue;
                if (c == '{' || c == '[') ++depth;
                if ((c == ',' || c == '}') && depth == 0) break;
                if (c == '}' || c == ']') --depth;
            }
            for (const char* other : {"[[]]", "{\"a\":[]}", "-1.5"}) {
                const std::string old = reader.good.substr(at + 1, after - at - 1);
                const bool is_number = old.find_first_not_of("0123456789.-") == std::string::npos;
                if (is_number && std::string(other) == "-1.5") continue;  // what it may be is for the engine
                std::string body = reader.good;
                expect_refused(reader, body.replace(at + 1, after - at - 1, other));
            }
        }
    }
}

TEST(ConsoleRequests, WhatIsNoObjectIsRefused) {
    for (const Reader& reader : readers()) {
        for (const char* body : {"", " ", "null", "[]", "3", "\"a\"", "true", "{", "}", "{}x", "{\"a\"}", "{'a':1}",
                                 "\xff\xfe{}", "{\"a\":\"\xff\"}", "{\"a\":1,}", "{,}", "// a\n{}"}) {
            expect_refused(reader, body);
        }
        expect_refused(reader, reader.good + "x");
        expect_refused(reader, reader.good + reader.good);
        expect_refused(reader, reader.good.substr(0, reader.good.size() - 1));
        expect_refused(reader, "[" + reader.good + "]");
    }
}

TEST(ConsoleRequests, DeepNestingAndLongTextsAreRefusedOrReadButNeverCrash) {
    for (const Reader& reader : readers()) {
        expect_refused(reader, std::string(60'000, '['));
        expect_refused(reader, std::string(30'000, '[') + std::string(30'000, ']'));
        std::string deep;
        for (int i = 0; i < 10'000; ++i) deep += "{\"a\":";
        expect_refused(reader, deep);
        expect_refused(reader, deep + "1" + std::string(10'000, '}'));
        expect_refused(reader, "\"" + std::string(60'000, 'a'));
    }
    EXPECT_EQ(read_check(R"({"scan":")" + std::string(60'000, 'a') + R"("})").scan.size(), 60'000U);
}

TEST(ConsoleRequests, NumbersAreFiniteAndWholeWhereTheyCount) {
    for (const char* number : {"NaN", "nan", "Infinity", "-Infinity", "1e999", "-1e999", "1e400", "0x10", "1.", ".5",
                               "+1", "1e", "--1", "null", "\"1\"", "[1]"}) {
        expect_refused(readers()[5], R"({"cut":{"plane":[1,0,0,)" + std::string(number) + "]}}");
    }
    for (const char* count : {"-1", "1.5", "1e3", "18446744073709551616", "1e30", "99999999999999999999999"}) {
        expect_refused(readers()[11], R"({"back_to":)" + std::string(count) + "}");
        expect_refused(readers()[13], R"({"rank":{"top":)" + std::string(count) + "}}");
        expect_refused(readers()[5], R"({"cut":{"plane":[1,0,0,1],"k":)" + std::string(count) + "}}");
    }
    for (const char* number : {"2147483648", "-2147483649", "1.5"}) {
        expect_refused(readers()[15], R"({"explain":{"cut":)" + std::string(number) + "}}");
        expect_refused(readers()[8], R"({"setup":{"piece":"A","base":)" + std::string(number) + "}}");
    }
    expect_refused(readers()[5], R"({"cut":{"plane":[1,0,0,1],"k":0}})");
}

TEST(ConsoleRequests, APlaneIsAUnitNormalAndAnOffset) {
    for (const char* numbers :
         {"[]", "[1]", "[1,0,0]", "[1,0,0,0,0]", "[0,0,0,1]", "[2,0,0,1]", "[1,1,0,1]", "[1,0,0,\"1\"]", "{}", "null",
          "[0.999,0,0,1]", "[1e308,1e308,0,0]", "[[1,0,0,1]]", "[true,0,0,1]"}) {
        expect_refused(readers()[5], R"({"cut":{"plane":)" + std::string(numbers) + "}}");
        expect_refused(readers()[14], R"({"preview":{"plane":)" + std::string(numbers) + "}}");
    }
    expect_refused(readers()[5], R"({"cut":{"piece":"A"}})");
    const DecisionBody read = read_decision(R"({"cut":{"plane":[0.6,0,-0.8,1e300]}})");
    EXPECT_EQ(read.cut->plane, (std::vector<double>{0.6, 0, -0.8, 1e300}));
}

TEST(ConsoleRequests, ExactlyOneThingIsAskedFor) {
    expect_refused(readers()[5], "{}");
    expect_refused(readers()[13], "{}");
    expect_refused(readers()[13], R"({"lane":"rank"})");
    for (const char* body : {R"({"undo":"a","redo":"b"})", R"({"back_to":1,"reset":true})",
                             R"({"undo":"a","reset":true})", R"({"weights":{},"discard":{"pieces":[]}})"}) {
        expect_refused(readers()[5], body);
    }
    expect_refused(readers()[5], R"({"reset":false})");
    expect_refused(readers()[5], R"({"undo":null})");
    expect_refused(readers()[5], R"({"cut":{"plane":)" + plane + R"(},"undo":"a"})");
    expect_refused(readers()[13], R"({"rank":{},"explain":{}})");
    expect_refused(readers()[13], R"({"explain":{},"setups":{"piece":"A"}})");
}

TEST(ConsoleRequests, ASetupIsDecidedWithAPieceAndAskedWithoutADecision) {
    expect_refused(readers()[8], R"({"setup":{"piece":"A"}})");
    expect_refused(readers()[8], R"({"setup":{"base":1}})");
    expect_refused(readers()[8], R"({"setup":{"piece":"A","automatic":false}})");
    expect_refused(readers()[16], R"({"setups":{"piece":"A","base":1}})");
    expect_refused(readers()[16], R"({"setups":{"piece":"A","automatic":true}})");
    EXPECT_TRUE(read_decision(R"({"setup":{"piece":"A","automatic":true}})").setup->is_free);
}

TEST(ConsoleRequests, EveryValueIsRead) {
    const NewProjectBody project = read_new_project(readers()[2].good);
    EXPECT_EQ(project.check, "C1");
    EXPECT_EQ(project.name, "skull");
    EXPECT_EQ(project.units, "mm");
    EXPECT_EQ(project.scale, 2.5);
    EXPECT_EQ(project.cell, "foam-1");
    EXPECT_EQ(project.preset, "carve");
    EXPECT_EQ(project.fragment_volume_mm3, 5);
    EXPECT_TRUE(project.size_ok);
    EXPECT_EQ(project.repair.fill, "flat");
    EXPECT_EQ(project.cuts_of, "0f");
    const RepairBody repair = read_repair(readers()[1].good);
    EXPECT_EQ(repair.fill, "auto");
    EXPECT_EQ(repair.snap_borders_mm, 0.5);
    EXPECT_EQ(repair.alpha_wrap_mm, 2);
    EXPECT_FALSE(repair.resolve_self_intersections);
    EXPECT_TRUE(repair.smooth_pen_grooves);
    const CheckBody check = read_check(readers()[0].good);
    EXPECT_EQ(check.scan, "ab");
    EXPECT_EQ(check.units, "mm");
    EXPECT_TRUE(check.deep);
    EXPECT_EQ(read_work(readers()[3].good).kind, WorkKind::verify);
    EXPECT_EQ(read_work(readers()[3].good).piece, "A");
    const WorkBody replay = read_work(R"({"kind":"replay","piece":"B","part":2})");
    EXPECT_EQ(replay.part, 2);
    const CommandWords expected{"console-replay", "p.qch",      "--piece", "B", "--part", "2",
                                "--json",         "--progress", "json"};
    EXPECT_EQ(work_words("p.qch", replay), expected);
    const DecisionBody cut = read_decision(readers()[5].good);
    EXPECT_EQ(cut.cut, (CutOrder{"A", {0.6, 0, -0.8, 12.5}, 3}));
    EXPECT_EQ(read_decision(readers()[7].good).discard->pieces, (std::vector<std::string>{"D", "E"}));
    EXPECT_EQ(read_decision(readers()[8].good).setup->base, 2);
    EXPECT_EQ(read_decision(readers()[8].good).setup->max_directions, 3U);
    EXPECT_EQ(read_decision(readers()[9].good).undo, "Undo cut 3 on piece C");
    EXPECT_EQ(read_decision(readers()[10].good).redo, "Redo reset");
    EXPECT_EQ(read_decision(readers()[11].good).back_to, 0U);
    const Weights all = read_decision(readers()[6].good).weights->over({});
    EXPECT_EQ(all.fragility, 1.5);
    const QuestionBody rank = read_question(readers()[13].good);
    EXPECT_EQ(rank.lane, "rank-1");
    EXPECT_EQ(rank.rank->piece, "A");
    EXPECT_EQ(rank.rank->top, 5U);
    EXPECT_EQ(rank.rank->weights->over({}).undercut, 2);
    EXPECT_EQ(read_question(R"({"rank":{}})").rank->top, 10U);
    EXPECT_EQ(read_question(readers()[15].good).explain->cut, 2);
}

TEST(ConsoleRequests, ATextIsReadAsItIs) {
    EXPECT_EQ(read_decision(R"({"undo":"a\u0000b\n<script>\u00e4"})").undo, std::string("a\0b\n<script>\xc3\xa4", 14));
}

}  // namespace
}  // namespace qchopper
