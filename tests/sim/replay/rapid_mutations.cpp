// RAPID. In the ready cell the spindle is switched by do_spindle_on, extraction by do_extraction_on.

#include <algorithm>
#include <cmath>

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

// The n-th number of a line, from 0.
std::pair<std::size_t, std::size_t> number_of(const std::string& line, std::size_t from, int n) {
    constexpr const char* digits = "-.0123456789";
    for (std::size_t at = line.find_first_of("[(,", from); at != std::string::npos;
         at = line.find_first_of("[(,", at + 1)) {
        if (at + 1 >= line.size() || std::string(digits).find(line[at + 1]) == std::string::npos) continue;
        if (n-- == 0) return {at + 1, line.find_first_not_of(digits, at + 1)};
    }
    return {std::string::npos, std::string::npos};
}

MoveText moves() {
    return {"movel offs(",
            [](const std::string& line, int component) { return number_of(line, line.find('('), component); }};
}

// The n-th number of the lines that begin so.
Change each_of(const std::string& word, int n, const std::function<double(double)>& f) {
    return each(word, [n, f](std::string& line) { return change_span(line, number_of(line, 0, n), f); });
}

void add_frames(std::vector<Mutation>& all) {
    const std::string tool = "pers tooldata";
    const std::string work = "pers wobjdata";
    all.push_back(everywhere("tool_10_mm_longer", each_of(tool, 2, plus(10))));
    all.push_back(everywhere("tool_half_mm_shorter", each_of(tool, 2, plus(-0.5))));
    all.push_back(everywhere("stale_tool_table", each_of(tool, 0, plus(0.2))));
    all.push_back(everywhere("tool_turned_half_around", each(tool, [](std::string& line) {
                                 return replace_first(line, 0, "[1.00000000,0.00000000", "[0.00000000,1.00000000");
                             })));
    all.push_back(everywhere("tool_not_held",
                             each(tool, [](std::string& line) { return replace_first(line, 0, "[TRUE", "[FALSE"); })));
    all.push_back(everywhere("load_without_spindle", each_of(tool, 7, plus(-10))));
    all.push_back(everywhere("load_centre_300_mm_off", each_of(tool, 8, plus(300))));
    all.push_back(everywhere("load_inertia_times_10", each_of(tool, 15, times(10))));
    all.push_back(everywhere("base_20_mm_aside", each_of(work, 0, plus(20))));
    all.push_back(everywhere("base_1_mm_lower", each_of(work, 2, plus(-1))));
    all.push_back(everywhere("base_turned_half_around", each(work, [](std::string& line) {
                                 return replace_first(line, 0, "[1.00000000,0.00000000,0.00000000,0.00000000]",
                                                      "[0.00000000,0.00000000,0.00000000,1.00000000]");
                             })));
    all.push_back(everywhere("base_on_a_table_that_is_not_there", each(work, [](std::string& line) {
                                 return replace_first(line, 0, "TRUE,\"\"", "FALSE,\"STN1\"");
                             })));
    all.push_back(replaced("quaternion_not_normalised", "[1.00000000,", "[0.90000000,"));
    all.push_back(in_one_chunk("target_lowered", each_of("local const", 2, plus(-5))));
    all.push_back(in_one_chunk("target_raised", each_of("local const", 2, plus(5))));
    all.push_back(in_one_chunk("target_turned", each("local const", [](std::string& line) {
                                   const auto [begin, end] = number_of(line, 0, 3);
                                   const auto [begin2, end2] = number_of(line, 0, 4);
                                   const std::string w = line.substr(begin, end - begin);
                                   const std::string x = line.substr(begin2, end2 - begin2);
                                   line.replace(begin2, end2 - begin2, w);
                                   line.replace(begin, end - begin, x);
                                   return w != x;
                               })));
    all.push_back(in_one_chunk("start_joint_sign_lost", each_of("moveabsj", 1, times(-1))));
    all.push_back(in_one_chunk("start_joint_moved", each_of("moveabsj", 2, plus(12))));
    all.push_back(in_one_chunk("external_axis_given", each("moveabsj", [](std::string& line) {
                                   return replace_first(line, 0, "9E9", "10.000");
                               })));
    all.push_back(everywhere("tool_declared_twice", [](Lines& lines) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (!begins(lines[i], "pers tooldata")) continue;
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), lines[i]);
            return true;
        }
        return false;
    }));
    all.push_back(everywhere("work_object_lost", without("pers wobjdata")));
}

void add_speeds(std::vector<Mutation>& all) {
    const auto feed = [](const std::function<double(double)>& f) { return each_number("v.v_tcp", ":=", f); };
    all.push_back(everywhere("feed_times_60", feed(times(60))));
    all.push_back(everywhere("feed_times_2", feed(times(2))));
    all.push_back(everywhere("feed_by_60", feed(times(1.0 / 60))));
    all.push_back(everywhere("feed_in_m_per_s", feed(times(0.001))));
    all.push_back(everywhere("feed_never_stated", without("v.v_tcp")));
    all.push_back(everywhere("speeds_overridden", each("velset 100", [](std::string& line) {
                                 line = "VelSet 5,5000;";
                                 return true;
                             })));
    all.push_back(everywhere("override_never_stated", without("velset")));
    all.push_back(in_one_chunk("joint_moves_at_full_speed", each("velset 50", [](std::string& line) {
                                   line = "VelSet 100,5000;";
                                   return true;
                               })));
    all.push_back(
        everywhere("joint_moves_at_full_acceleration", each_number("accset", "AccSet ", [](double) { return 100; })));
    all.push_back(in_one_chunk("acceleration_not_stated_in_a_chunk", without("accset")));
    all.push_back(everywhere("path_acceleration_times_9", each("pathacclim", [](std::string& line) {
                                 line = "PathAccLim TRUE\\AccMax:=18.0000,TRUE\\DecelMax:=18.0000;";
                                 return true;
                             })));
    all.push_back(in_one_chunk("path_acceleration_not_stated", without("pathacclim")));
    all.push_back(in_one_chunk("path_acceleration_off", each("pathacclim", [](std::string& line) {
                                   line = "PathAccLim FALSE,FALSE;";
                                   return true;
                               })));
    all.push_back(everywhere("orientation_speed_times_10", each_of("local var speeddata", 1, times(10))));
    all.push_back(everywhere("rounding_times_20", [](Lines& lines) {
        const bool is_larger =
            each_number("z.pzone_tcp", ":=", [](double v) { return std::min(20 * v, 1000.0); })(lines);
        each("movel", [](std::string& line) { return replace_first(line, 0, ",fine,", ",z,"); })(lines);
        return is_larger;
    }));
    all.push_back(in_one_chunk("zone_never_stated", without("z.pzone_tcp")));
    all.push_back(in_one_chunk("last_corner_rounded", [](Lines& lines) {
        for (std::size_t i = lines.size(); i-- > 0;) {
            if (begins(lines[i], "movel")) return replace_first(lines[i], 0, ",fine,", ",z,");
        }
        return false;
    }));
    all.push_back(in_one_chunk("configuration_checked", without("confl")));
}

void add_signals(std::vector<Mutation>& all) {
    all.push_back(everywhere("spindle_never_started", without("setdo do_spindle_on,1")));
    all.push_back(everywhere("spindle_not_waited_for", without("waitdi")));
    all.push_back(everywhere("spindle_too_slow", each_number("setao", ",", times(0.1))));
    all.push_back(in_last_chunk("speed_not_stated_in_the_last_chunk", without("setao")));
    all.push_back(in_last_chunk("spindle_not_on_in_the_last_chunk", without("setdo do_spindle_on,1")));
    all.push_back(in_last_chunk("spindle_off_in_the_middle", insert_among("movel", "SetDO do_spindle_on,0;")));
    all.push_back(everywhere("extraction_never_on", without("setdo do_extraction_on,1")));
    all.push_back(in_last_chunk("extraction_not_on_in_the_last_chunk", without("setdo do_extraction_on,1")));
    all.push_back(in_one_chunk("output_of_nobody", [](Lines& lines) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (!begins(lines[i], "confl")) continue;
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(i), "SetDO do_door,1;");
            return true;
        }
        return false;
    }));
    all.push_back(in_one_chunk("waits_for_another_input", each("waitdi", [](std::string& line) {
                                   return replace_first(line, 0, "di_spindle_at_speed", "di_door_closed");
                               })));
    all.push_back(in_main_lines("spindle_on_at_the_end", without("setdo do_spindle_on,0")));
    all.push_back(in_main_lines("extraction_on_at_the_end", without("setdo do_extraction_on,0")));
    all.push_back(in_main_lines("interrupt_stays_connected", without("idelete")));
    all.push_back(in_one_chunk("trap_not_connected", without("connect")));
    all.push_back(in_one_chunk("fallen_signal_not_watched", without("isignaldi")));
    all.push_back(in_main_lines("trap_lets_the_arm_go_on", without("stopmove")));
    all.push_back(in_main_lines("trap_ends_nothing", without("exit")));
    all.push_back(everywhere("tool_change_not_asked", without("tpreadfk")));
    all.push_back(everywhere("question_lost", without("tpwrite")));
    all.push_back(everywhere("tool_length_wrong_in_the_question", each("tpwrite \"ask tool", [](std::string& line) {
                                 return replace_first(line, 0, "00 mm", "10 mm");
                             })));
    const auto away = each_of("moveabsj", 0, plus(1));
    all.push_back(in_main_lines("begins_away_from_home", [away](Lines& lines) {
        for (std::string& line : lines) {
            Lines one{line};
            if (begins(line, "moveabsj")) return away(one), line = one.front(), true;
        }
        return false;
    }));
    all.push_back(in_main_lines("ends_away_from_home", [away](Lines& lines) {
        for (std::size_t i = lines.size(); i-- > 0;) {
            Lines one{lines[i]};
            if (begins(lines[i], "moveabsj")) return away(one), lines[i] = one.front(), true;
        }
        return false;
    }));
}

void add_text(std::vector<Mutation>& all) {
    all.push_back(of_text("truncated", [](std::string& text) {
        text.resize(text.size() * 2 / 3);
        return true;
    }));
    for (const char* word : {"ENDPROC\r\n", "ENDMODULE\r\n", "  VERSION:1\r\n", "LOCAL CONST"}) {
        const std::string name = std::string(word).substr(0, std::string(word).find('\r'));
        all.push_back(of_text("lost " + name, [word](std::string& text) { return replace_first(text, 0, word, ""); }));
    }
    const std::vector<std::pair<std::string, std::string>> words{
        {"MoveL ", "MoveC "},     {"MoveL ", "MoveJ "},        {"MoveL ", "MvoeL "}, {"Offs(p,", "RelTool(p,"},
        {"Offs(p,", "Offs(q,"},   {",fine,", ",z5,"},          {",v,", ",v100,"},    {"\\WObj", "\\Wobj1"},
        {"\r\nMoveL", "\nMoveL"}, {"\r\nMoveL", "\r\r\nMoveL"}};
    for (const auto& [what, by] : words) {
        all.push_back(of_text("read " + by, [what = what, by = by](std::string& text) {
            const std::size_t at = text.find("\r\nMoveL ");
            return at != std::string::npos && replace_first(text, at, what, by);
        }));
    }
    for (const char* line : {"IF TRUE THEN", "WHILE TRUE DO", "GOTO again;", "FOR i FROM 1 TO 2 DO", "SingArea\\Wrist;",
                             "WaitTime 1;", "MoveAbsJ home,vmax,fine,tool0;", "Stop;"}) {
        all.push_back(in_one_chunk("inserted " + std::string(line), insert_among("movel", line)));
    }
    const auto in_offs = [](const std::string& what, const std::string& by) {
        return [what, by](std::string& text) {
            const std::size_t at = text.find("Offs(");
            return at != std::string::npos && replace_first(text, at, what, by);
        };
    };
    all.push_back(of_text("exponent", in_offs("),v", "E+00),v")));
    all.push_back(of_text("decimal_comma", in_offs(".", ",")));
    all.push_back(of_text("not_a_number", in_offs("p,", "p,nan")));
    all.push_back(of_text("another_encoding", [](std::string& text) {
        std::string wide = "\xff\xfe";
        for (const char c : text) wide += c, wide += '\0';
        text = wide;
        return true;
    }));
}

}  // namespace

std::vector<Mutation> rapid_mutations() {
    std::vector<Mutation> all = move_mutations(moves());
    add_frames(all);
    add_speeds(all);
    add_signals(all);
    for (const Mutation& mutation : chunk_mutations()) all.push_back(mutation);
    add_text(all);
    return all;
}

}  // namespace qchopper
