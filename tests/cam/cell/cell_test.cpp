#include "cam/cell/cell.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "base/error.h"

namespace qchopper {
namespace {

const std::string good = R"(version = 2
name = "test"
id = 7
[margin]
sides = 10
top = 8
spoil = 0
[reach]
min = [-1200, -1200, 0]
max = [1200, 1200.0, 1400]
source = "measured"
[table]
centre = [0, 50]
size = [2200, 1600]
height = 150
source = "measured"
[[stock]]
name = "small"
size = [300, 200, 100]
material = "eps"
[[tool]]
number = 3
name = "ball 20"
shape = "ball"
diameter = 20
flute_length = 100
stick_out = 150
holder = [[40, 50]]
feed_mm_per_s = [20, 150]
rpm = [6000, 18000]
mass_kg = 1.2
removal_mm3_per_s = 24000
length_measured = true
[link]
to = "127.0.0.1:15020"
drop = "drop"
)";

// The error that read_cell throws for the good file with one text replaced.
struct Refusal {
    std::string what;
    std::string to_do;
};
Refusal refused(const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    try {
        parse_cell(text, "shop/cell.toml");
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::config);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line: " << error.what();
        return {error.what(), error.to_do.text};
    }
    ADD_FAILURE() << "taken: " << to;
    return {};
}

TEST(Cell, IsReadAsItIsWritten) {
    const Cell cell = parse_cell(good, "shop/cell.toml");
    EXPECT_EQ(cell.name, "test");
    EXPECT_EQ(cell.id, 7);
    EXPECT_EQ(cell.workspace, (Box{{-1200, -1200, 0}, {1200, 1200, 1400}}));
    EXPECT_EQ(cell.table, (Table{0, 50, 2200, 1600, 150}));
    EXPECT_EQ(cell.stock, (std::vector<Stock>{{"small", {300, 200, 100}, Material::eps}}));
    EXPECT_EQ(cell.margins, (Margins{10, 8, 0}));
    EXPECT_EQ(cell.stock_margin(), 10);
    EXPECT_EQ(cell.clearance, 20);
    EXPECT_EQ(cell.tool, (Tool{3, "ball 20", 20, 18000, 9000, 24000}));
    EXPECT_EQ(cell.link.to, "127.0.0.1:15020");
    EXPECT_EQ(cell.link.drop, "shop/drop");
    EXPECT_FALSE(cell.machine);
}

TEST(Cell, OfVersion1IsRefusedAndToldWhatToWrite) {
    for (const char* version : {"", "version = 1\n"}) {
        try {
            parse_cell(version + good.substr(good.find("name")), "shop/cell.toml");
            ADD_FAILURE() << version;
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::config);
            EXPECT_NE(std::string(error.what()).find("version: cell files of version 1"), std::string::npos)
                << error.what();
            EXPECT_NE(error.to_do.text.find("write version = 2"), std::string::npos) << error.to_do.text;
        }
    }
}

TEST(Cell, OfWhichNoMachineIsDescribedHasNothingOfOne) {
    for (const char* const key : {"max_tilt_deg = 60", "max_unreachable = 0.1", "[holding]", "[start]", "[program]",
                                  "[load_tolerance]", "[rotary_table]", "[extraction]", "[[obstacle]]"}) {
        const Refusal refusal = refused("[margin]", std::string(key) + "\n[margin]");
        EXPECT_NE(refusal.what.find("no machine"), std::string::npos) << key << " -> " << refusal.what;
        EXPECT_NE(refusal.to_do.find("[spindle]"), std::string::npos) << refusal.to_do;
    }
    const std::string tool = good.substr(good.find("[[tool]]"), good.find("[link]") - good.find("[[tool]]"));
    std::string second = tool;
    second.replace(second.find("number = 3"), 10, "number = 4");
    EXPECT_NE(refused("[link]", second + "[link]").what.find("has one tool"), std::string::npos);
}

TEST(Cell, TheExampleIsACell) {
    const Cell cell = read_cell(QCHOPPER_SOURCE_DIR "/cells/foam-1.toml");
    EXPECT_EQ(cell.name, "foam-1");
    EXPECT_EQ(cell.stock.size(), 5U);
    for (const Stock& stock : cell.stock) {
        EXPECT_LE(stock.size.x, cell.table.size_x) << stock.name;
        EXPECT_LE(cell.table.height + stock.size.z + cell.clearance, cell.workspace.max.z) << stock.name;
    }
}

TEST(Cell, NamesFileLineAndKeyOfEveryFault) {
    struct Case {
        std::string from, to, place, word;
    };
    const std::vector<Case> cases{
        {"id = 7", "id = 70000", "cell.toml:3: id", "out of bounds"},
        {"id = 7", "id = 7.5", "cell.toml:3: id", "whole number"},
        {"id = 7", "id = \"7\"", "cell.toml:3: id", "not a text"},
        {"name = \"test\"", "name = \"\"", "cell.toml:2: name", "empty"},
        {"name = \"test\"", "name = \"a\\u001b[2J\"", "cell.toml:2: name", "one line"},
        {"name = \"test\"", "", "name", "missing"},
        {"min = [-1200, -1200, 0]", "min = [-1200, 1200, 0]", "cell.toml:10: reach.max", "along y"},
        {"min = [-1200, -1200, 0]", "min = [-1200, -1200]", "cell.toml:9: reach.min", "3 numbers"},
        {"min = [-1200, -1200, 0]", "min = [nan, -1200, 0]", "cell.toml:9: reach.min", "finite"},
        {"min = [-1200, -1200, 0]", "min = [-inf, -1200, 0]", "cell.toml:9: reach.min", "finite"},
        {"height = 150", "height = -1", "cell.toml:15: table.height", "below the reach"},
        {"height = 150", "height = 1400", "cell.toml:15: table.height", "above the reach"},
        {"height = 150", "height = true", "cell.toml:15: table.height", "not true or false"},
        {"centre = [0, 50]", "centre = [0, 5000]", "cell.toml:13: table.centre", "outside of the reach"},
        {"size = [2200, 1600]", "size = [2200, 0]", "cell.toml:14: table.size", "out of bounds"},
        {"size = [300, 200, 100]", "size = [300, -200, 100]", "cell.toml:19: stock.size", "out of bounds"},
        {"material = \"eps\"", "material = \"stone\"", "cell.toml:20: stock.material", "unknown material"},
        {"[[stock]]", "[stock]", "stock", "[[stock]]"},
        {"diameter = 20", "diameter = 0", "cell.toml:25: tool.diameter", "out of bounds"},
        {"diameter = 20", "diameter = nan", "cell.toml:25: tool.diameter", "finite"},
        {"removal_mm3_per_s = 24000", "", "tool.removal_mm3_per_s", "missing"},
        {"rpm = [6000, 18000]", "rpm = [0, 18000]", "cell.toml:30: tool.rpm", "out of bounds"},
        {"15020", "0", "cell.toml:35: link.to", "HOST:PORT"},
        {"15020", "65536", "cell.toml:35: link.to", "HOST:PORT"},
        {"127.0.0.1:15020", "15020", "cell.toml:35: link.to", "HOST:PORT"},
        {"127.0.0.1:15020", "::1:502", "cell.toml:35: link.to", "HOST:PORT"},
        {"127.0.0.1:15020", "a b:502", "cell.toml:35: link.to", "HOST:PORT"},
        {"sides = 10", "sides = -1", "cell.toml:5: margin.sides", "out of bounds"},
        {"sides = 10", "sides = 1979-05-27", "cell.toml:5: margin.sides", "date"},
        {"id = 7", "id = ", "cell.toml:3", "not TOML"},
        {"id = 7", "id = 7\nid = 8", "cell.toml:4", "not TOML"},
    };
    for (const Case& one : cases) {
        const Refusal refusal = refused(one.from, one.to);
        EXPECT_NE(refusal.what.find(one.place), std::string::npos) << one.to << " -> " << refusal.what;
        EXPECT_NE(refusal.what.find(one.word), std::string::npos) << one.to << " -> " << refusal.what;
    }
}

TEST(Cell, AnUnknownKeyIsRefusedWithTheNearestKnownOne) {
    const Refusal root = refused("[margin]", "[margn]");
    EXPECT_NE(root.what.find("cell.toml:4: unknown key margn"), std::string::npos) << root.what;
    EXPECT_NE(root.to_do.find("margin"), std::string::npos) << root.to_do;
    const Refusal inner = refused("diameter", "diametre");
    EXPECT_NE(inner.what.find("cell.toml:25: unknown key tool.diametre"), std::string::npos) << inner.what;
    EXPECT_NE(inner.to_do.find("tool.diameter"), std::string::npos) << inner.to_do;
    EXPECT_NE(refused("[link]", "[lnk]").to_do.find("link"), std::string::npos);
}

TEST(Cell, SignaturesAreRequiredOnlyWhereTheFileSaysSo) {
    EXPECT_FALSE(parse_cell(good, "c.toml").require_signature);
    EXPECT_TRUE(parse_cell("require_signature = true\n" + good, "c.toml").require_signature);
    EXPECT_FALSE(parse_cell("require_signature = false\n" + good, "c.toml").require_signature);
    EXPECT_THROW(parse_cell("require_signature = \"yes\"\n" + good, "c.toml"), InputError);
}

TEST(Cell, TwoBlocksOfOneNameOrNoneAreRefused) {
    const Refusal twice = refused("[[tool]]", "[[stock]]\nname = \"small\"\nsize = [1, 1, 1]\n[[tool]]");
    EXPECT_NE(twice.what.find("cell.toml:22: stock.name"), std::string::npos) << twice.what;
    const std::string block = "[[stock]]\nname = \"small\"\nsize = [300, 200, 100]\nmaterial = \"eps\"\n";
    EXPECT_NE(refused(block, "").what.find("stock: is missing"), std::string::npos);
    std::string empty_list = good;
    empty_list.replace(empty_list.find(block), block.size(), "");
    empty_list = "stock = []\n" + empty_list;
    EXPECT_THROW(parse_cell(empty_list, "c.toml"), InputError);
}

TEST(Cell, AMissingFileIsMissingAndAFolderToo) {
    for (const char* path : {"/nonexistent/cell.toml", "/"}) {
        try {
            read_cell(path);
            FAIL() << path;
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::missing);
        }
    }
}

TEST(Cell, LinkIsOptionalAndDropMayBeAbsolute) {
    const std::string text = good.substr(0, good.find("[link]"));
    EXPECT_EQ(parse_cell(text, "c.toml").link, Link{});
    const std::string with = text + "[link]\nto = \"[::1]:502\"\ndrop = \"/srv/drop\"\n";
    EXPECT_EQ(parse_cell(with, "shop/c.toml").link, (Link{"[::1]:502", "/srv/drop"}));
}

TEST(Material, WordsGoForthAndBack) {
    for (const Material material :
         {Material::unspecified, Material::pu_foam, Material::eps, Material::xps, Material::other}) {
        EXPECT_EQ(material_of(to_word(material)), material);
    }
    EXPECT_EQ(material_of("PU_FOAM"), std::nullopt);
}

// Whatever the bytes: a possible cell or an InputError.
TEST(Cell, DamagedTextNeverEscapes) {
    std::mt19937 random(11);
    int refusals = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string text = good;
        for (int k = 0; k < 1 + round % 4; ++k) {
            const std::size_t at = random() % text.size();
            if (round % 3 == 0) text[at] = static_cast<char>(random());
            if (round % 3 == 1) text.erase(at, 1 + random() % 6);
            if (round % 3 == 2) text.insert(at, 1, "[]{}=\"'\n.0e-"[random() % 12]);
        }
        try {
            const Cell cell = parse_cell(text, "c.toml");
            EXPECT_FALSE(cell.stock.empty());
            EXPECT_GT(cell.tool.diameter, 0);
            EXPECT_LT(cell.workspace.min.z, cell.workspace.max.z);
        } catch (const InputError& error) {
            ++refusals;
            EXPECT_EQ(error.fault, InputFault::config);
            EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(refusals, 1000);
}

}  // namespace
}  // namespace qchopper
