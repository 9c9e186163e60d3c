// RS-274/NGC.

#include <algorithm>

#include "tests/sim/replay/move_mutations.h"

namespace qchopper {
namespace {

using namespace program_text;

std::function<double(double)> times(double f) {
    return [f](double v) { return f * v; };
}

std::function<double(double)> plus(double d) {
    return [d](double v) { return v + d; };
}

// Behind a letter that stands after a space.
std::pair<std::size_t, std::size_t> number_behind(const std::string& line, char letter) {
    const std::size_t at = line.find(std::string(" ") + letter);
    if (at == std::string::npos) return {at, at};
    return {at + 2, std::min(line.find(' ', at + 2), line.size())};
}

MoveText moves() {
    return {"g1 ", [](const std::string& line, int component) {
                return number_behind(line, "XYZ"[static_cast<std::size_t>(component)]);
            }};
}

Change each_word(const std::string& word, char letter, const std::function<double(double)>& f) {
    return each(word, [letter, f](std::string& line) { return change_span(line, number_behind(line, letter), f); });
}

void add_modes(std::vector<Mutation>& all) {
    const std::string modes = "G90 G17 G94 G40";
    const std::vector<std::pair<std::string, std::string>> words{{"G21", "G20"}, {"G90", "G91"},     {"G17", "G18"},
                                                                 {"G94", "G93"}, {"G94", "G95"},     {"G40", "G41"},
                                                                 {"G54", "G55"}, {"G43 H", "G44 H"}, {"G61", "G61.1"}};
    for (const auto& [what, by] : words) all.push_back(replaced(by + "_for_" + what, what, by));
    for (const std::string word : {"G21", "G90", "G54", "G43", "G61"}) {
        all.push_back(in_one_chunk(word + "_not_stated_in_a_chunk", without(lower(word))));
    }
    for (const std::string mode : {"G90 ", "G17 ", "G94 ", " G40"}) {
        all.push_back(replaced("lost " + mode, mode, ""));
    }
    all.push_back(everywhere("units_with_a_feed", each("g21", [](std::string& line) {
                                 line = "G21 F1000.0";
                                 return true;
                             })));
    all.push_back(everywhere("length_of_another_tool", each_word("g43", 'H', plus(1))));
    all.push_back(in_main_lines("length_lost_behind_the_change", without("g43")));
    all.push_back(in_one_chunk("length_lost_in_a_chunk", without("g43")));
    all.push_back(everywhere("length_cancelled", [](Lines& lines) {
        const auto at = std::find_if(lines.begin(), lines.end(), [](const std::string& l) { return begins(l, "s"); });
        if (at == lines.end()) return false;
        lines.insert(at, "G49");
        return true;
    }));
}

void add_speeds(std::vector<Mutation>& all) {
    all.push_back(everywhere("feed_times_60", each_word("g1 ", 'F', times(60))));
    all.push_back(everywhere("feed_times_2", each_word("g1 ", 'F', times(2))));
    all.push_back(everywhere("feed_in_mm_per_s", each_word("g1 ", 'F', times(1.0 / 60))));
    all.push_back(everywhere("feed_in_inches", each_word("g1 ", 'F', times(1 / 25.4))));
    all.push_back(everywhere("feed_never_stated", each("g1 ", [](std::string& line) {
                                 const std::size_t at = line.find(" F");
                                 if (at != std::string::npos) line.resize(at);
                                 return at != std::string::npos;
                             })));
    all.push_back(everywhere("rapids_for_cuts", each("g1 ", [](std::string& line) {
                                 line = "G0" + line.substr(2, line.find(" F") - 2);
                                 return true;
                             })));
    all.push_back(everywhere("cuts_for_rapids", each("g0 ", [](std::string& line) {
                                 line[1] = '1';
                                 return true;
                             })));
    all.push_back(everywhere("rapid_not_straight", each("g0 x", [](std::string& line) {
                                 line += " Z0.00";
                                 return true;
                             })));
    all.push_back(everywhere("rapid_too_low", each_word("g0 z", 'Z', plus(-600))));
    all.push_back(everywhere("rapid_beyond_the_travel", each_word("g0 z", 'Z', plus(300))));
    all.push_back(in_one_chunk("rapid_to_another_place", each_word("g0 x", 'X', plus(-2000))));
    all.push_back(everywhere("corners_without_bound", each("g64", [](std::string& line) {
                                 line = "G64";
                                 return true;
                             })));
    all.push_back(everywhere("corners_cut_by_3_mm", [](Lines& lines) {
        return each("g61", [](std::string& line) {
            line = "G64 P3.000";
            return true;
        })(lines);
    }));
    all.push_back(everywhere("corners_with_a_negative_bound", each_word("g64", 'P', times(-1))));
    all.push_back(in_one_chunk("rounded_before_a_rapid", [](Lines& lines) {
        for (std::size_t i = lines.size(); i-- > 1;) {
            if (!begins(lines[i], "g0 ")) continue;
            for (std::size_t j = i; j-- > 0;) {
                if (!begins(lines[j], "g61")) continue;
                lines[j] = "G64 P0.100";
                return true;
            }
        }
        return false;
    }));
}

void add_signals(std::vector<Mutation>& all) {
    all.push_back(everywhere("spindle_never_started", without("s", "m3")));
    all.push_back(in_last_chunk("spindle_not_on_in_the_last_chunk", without("s", "m3")));
    all.push_back(everywhere("spindle_the_other_way",
                             each("s", [](std::string& line) { return replace_first(line, 0, "M3", "M4"); })));
    all.push_back(everywhere("spindle_too_slow", each("s", [](std::string& line) {
                                 return change_span(line, {1, line.find(' ')}, times(0.1));
                             })));
    all.push_back(everywhere("spindle_without_speed", each("s", [](std::string& line) {
                                 line = "M3";
                                 return true;
                             })));
    all.push_back(everywhere("spindle_not_waited_for", without("g4 ")));
    all.push_back(everywhere("spindle_waited_for_too_shortly", each_word("g4", 'P', times(0.2))));
    all.push_back(in_main_lines("spindle_on_at_the_end", lose("m5", true)));
    all.push_back(in_main_lines("spindle_on_at_the_change", lose("m5", false)));
    all.push_back(in_last_chunk("spindle_off_in_the_middle", insert_among("g1 ", "M5")));
    all.push_back(in_one_chunk("output_of_nobody", each("s", [](std::string& line) {
                                   line += "\r\nM64 P7";
                                   return true;
                               })));
    all.push_back(everywhere("tool_change_not_asked", without("m0")));
    all.push_back(everywhere("question_lost", without("(msg")));
    all.push_back(everywhere("tool_length_wrong_in_the_question", each("(msg, ask tool", [](std::string& line) {
                                 return replace_first(line, 0, "00 mm", "10 mm");
                             })));
    all.push_back(everywhere("another_tool_changed_in", each("t", [](std::string& line) {
                                 return change_span(line, {1, line.find(' ')}, plus(1));
                             })));
    all.push_back(in_main_lines("tool_not_changed", lose("t", true)));
    all.push_back(in_main_lines("begins_away_from_home", lose("g0 z", false)));
    all.push_back(in_main_lines("ends_away_from_home", lose("g0 x", true)));
}

void add_text(std::vector<Mutation>& all) {
    all.push_back(of_text("truncated", [](std::string& text) {
        text.resize(text.size() * 2 / 3);
        return true;
    }));
    all.push_back(everywhere("end_lost", without("m2")));
    all.push_back(in_one_chunk("endsub_lost", [](Lines& lines) {
        lines.pop_back();
        return true;
    }));
    const std::vector<std::pair<std::string, std::string>> words{
        {"G1 ", "G2 "},         {"G1 ", "G3 "},          {"G1 ", "G7 "}, {"G1 ", ""},
        {"G1 X", "G1 A0.0 X"},  {"G1 X", "G1 X0.0 X"},   {" Y", " Y#1"}, {"\r\nG1", "\nG1"},
        {"\r\nG1", "\r\r\nG1"}, {"\r\nG1", "\r\nN10 G1"}};
    for (const auto& [what, by] : words) {
        all.push_back(of_text("read " + by, [what = what, by = by](std::string& text) {
            const std::size_t at = text.find("G0 ");
            return at != std::string::npos && replace_first(text, at, what, by);
        }));
    }
    for (const char* line :
         {"o100 if [#1 GT 0]", "o100 while [1]", "o100 repeat [5]", "#1=5", "G28", "G53 G0 Z0", "M30", "G92 X0",
          "G10 L2 P1 X0 Y0 Z0", "M98 P1000", "G81 X0 Y0 Z-1 R1 F100", "/G1 X0 Y0 Z0"}) {
        all.push_back(in_one_chunk("inserted " + std::string(line), insert_among("g1 ", line)));
    }
    const auto in_line = [](const std::string& what, const std::string& by) {
        return [what, by](std::string& text) {
            const std::size_t at = text.find("G1 ");
            return at != std::string::npos && replace_first(text, at, what, by);
        };
    };
    all.push_back(of_text("exponent", in_line(" Y", "E+00 Y")));
    all.push_back(of_text("decimal_comma", in_line(".", ",")));
    all.push_back(of_text("not_a_number", in_line("X", "Xnan")));
    all.push_back(of_text("another_encoding", [](std::string& text) {
        std::string wide = "\xff\xfe";
        for (const char c : text) wide += c, wide += '\0';
        text = wide;
        return true;
    }));
}

}  // namespace

std::vector<Mutation> ngc_mutations() {
    std::vector<Mutation> all = move_mutations(moves());
    add_modes(all);
    add_speeds(all);
    add_signals(all);
    for (const Mutation& mutation : chunk_mutations()) all.push_back(mutation);
    add_text(all);
    return all;
}

}  // namespace qchopper
