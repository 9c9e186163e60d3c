// One function per subject, on the changes of program_text.h. O(characters) for each mutation.

#include "tests/sim/replay/mutations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "tests/sim/replay/program_text.h"

namespace qchopper {
namespace {

using namespace program_text;

Change shifted_point(const std::string& component, double by) {
    return [component, by](Lines& lines) {
        std::vector<std::size_t> places = lin_places(lines);
        std::erase_if(places, [&](std::size_t i) { return lines[i].find(",A ") != std::string::npos; });
        if (places.empty()) return false;
        return change_number(lines[places[places.size() / 2]], component, [by](double v) { return v + by; });
    };
}

// The first move that leads up and the one after it that leads aside, above.
bool lose_retract(Lines& lines) {
    const std::vector<std::size_t> places = lin_places(lines);
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
        const double up = component_of(lines[places[k]], "Z") - component_of(lines[places[k - 1]], "Z");
        const double aside = std::hypot(component_of(lines[places[k + 1]], "X") - component_of(lines[places[k]], "X"),
                                        component_of(lines[places[k + 1]], "Y") - component_of(lines[places[k]], "Y"));
        if (up < 10 || aside < 1) continue;
        // It goes on at the depth that it had.
        for (const std::size_t j : {places[k], places[k + 1]}) {
            const double z = component_of(lines[places[k - 1]], "Z");
            change_number(lines[j], "Z", [z](double) { return z; });
        }
        return true;
    }
    return false;
}

// All of them.
bool lose_retracts(Lines& lines) {
    bool is_changed = false;
    while (lose_retract(lines)) is_changed = true;
    return is_changed;
}

bool lower_every_tenth(Lines& lines) {
    const std::vector<std::size_t> places = lin_places(lines);
    bool is_changed = false;
    for (std::size_t k = 9; k < places.size(); k += 10) {
        is_changed |= change_number(lines[places[k]], "Z", [](double z) { return z - 5; });
    }
    return is_changed;
}

// A chunk that ends above begins below: its last move up is left out.
bool lose_last_retract(Lines& lines) {
    const std::vector<std::size_t> places = lin_places(lines);
    if (places.size() < 3) return false;
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(places.back()));
    return true;
}

bool reverse_moves(Lines& lines) {
    const std::vector<std::size_t> places = lin_places(lines);
    if (places.size() < 6) return false;
    for (std::size_t a = 1, b = places.size() - 1; a < b; ++a, --b) std::swap(lines[places[a]], lines[places[b]]);
    return true;
}

bool lose_every_second(Lines& lines) {
    const std::vector<std::size_t> places = lin_places(lines);
    if (places.size() < 8) return false;
    for (std::size_t k = places.size() - 2; k >= 2; k -= 2) {
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(places[k]));
    }
    return true;
}

bool swap_components(std::string& line, const std::string& a, const std::string& b) {
    const auto [a0, a1] = number_at(line, a);
    const auto [b0, b1] = number_at(line, b);
    if (a0 == std::string::npos || b0 == std::string::npos) return false;
    const std::string first = line.substr(a0, a1 - a0);
    const std::string second = line.substr(b0, b1 - b0);
    if (first == second) return false;
    line.replace(b0, b1 - b0, first);
    line.replace(a0, a1 - a0, second);
    return true;
}

bool lose_chunk(ProgramFiles& files, Lines& lines, const std::vector<std::size_t>& calls) {
    if (calls.size() < 2) return false;
    const std::string stem = called_stem(files, lines[calls.back()]);
    std::erase_if(files, [&](const ProgramFile& file) { return stem_of(file) == stem; });
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(calls.back()));
    return true;
}

// Whether a comment of the file says so, in any of the languages.
bool is_for(const ProgramFile& file, const std::string& operation) {
    return file.text.find("operation " + operation + "\r\n") != std::string::npos ||
           file.text.find("operation " + operation + ")\r\n") != std::string::npos;
}

// The first chunk, or the last one, that says it is for an operation.
auto lose_operation(const std::string& operation, bool is_last) {
    return [operation, is_last](ProgramFiles& files, Lines& lines, const std::vector<std::size_t>& calls) {
        std::optional<std::size_t> found;
        std::string stem_found;
        for (const std::size_t call : calls) {
            const std::string stem = called_stem(files, lines[call]);
            const auto file =
                std::find_if(files.begin(), files.end(), [&](const ProgramFile& f) { return stem_of(f) == stem; });
            if (file == files.end() || !is_for(*file, operation)) continue;
            if (found && !is_last) continue;
            found = call;
            stem_found = stem;
        }
        if (!found || calls.size() < 2) return false;
        std::erase_if(files, [&](const ProgramFile& file) { return stem_of(file) == stem_found; });
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(*found));
        return true;
    };
}

// A change of all chunks that rough.
Mutation in_roughing(const std::string& name, const Change& change) {
    return of_files(name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
        ProgramFiles changed = files;
        bool is_changed = false;
        for (std::size_t i = next_chunk(files); i < files.size(); i = next_chunk(files, i + 1)) {
            if (!is_for(files[i], "roughing")) continue;
            Lines lines = lines_of(files[i].text);
            if (!change(lines)) continue;
            changed[i].text = text_of(lines);
            is_changed = true;
        }
        return is_changed ? std::optional(changed) : std::nullopt;
    });
}

// The highest level is cut at the height of the next one.
bool double_depth(Lines& lines) {
    constexpr std::size_t points_of_level = 5;
    std::map<double, std::size_t> points;  // by height
    for (const std::size_t place : lin_places(lines)) ++points[component_of(lines[place], "Z")];
    std::vector<double> levels;  // from the lowest on
    for (const auto& [height, count] : points) {
        if (count >= points_of_level) levels.push_back(height);
    }
    if (levels.size() < 2) return false;
    const double highest = levels.back();
    const double next = levels[levels.size() - 2];
    for (const std::size_t place : lin_places(lines)) {
        change_number(lines[place], "Z", [&](double z) { return z == highest ? next : z; });
    }
    return true;
}

std::optional<ProgramFiles> swap_chunks(const ProgramFiles& files) {
    const std::size_t first = next_chunk(files);
    std::size_t last = files.size();
    for (std::size_t i = first; i < files.size(); i = next_chunk(files, i + 1)) last = i;
    if (first >= files.size() || last == first) return std::nullopt;
    ProgramFiles changed = files;
    const auto renamed = [](const ProgramFile& from, const ProgramFile& to) {
        std::string text = from.text;
        for (std::size_t at = 0; replace_first(text, at, stem_of(from), stem_of(to));)
            at = text.find(stem_of(to), at) + 1;
        return text;
    };
    changed[first].text = renamed(files[last], files[first]);
    changed[last].text = renamed(files[first], files[last]);
    return changed;
}

// What finishes is said to be, and held as, the tool of the first chunk, which roughs and does not get to all of it.
std::optional<ProgramFiles> finish_with_the_roughing_tool(const ProgramFiles& files) {
    const std::size_t first = next_chunk(files);
    if (first >= files.size()) return std::nullopt;
    const Lines roughing = lines_of(files[first].text);
    ProgramFiles changed = files;
    bool is_changed = false;
    for (std::size_t i = next_chunk(files, first + 1); i < files.size(); i = next_chunk(files, i + 1)) {
        if (files[i].text.find(";operation finishing\r\n") == std::string::npos) continue;
        Lines lines = lines_of(files[i].text);
        for (const char* word : {";tool", "$tool", "$load"}) {
            const auto is_such = [word](const std::string& line) { return begins(line, word); };
            const auto from = std::find_if(roughing.begin(), roughing.end(), is_such);
            const auto to = std::find_if(lines.begin(), lines.end(), is_such);
            if (from != roughing.end() && to != lines.end()) *to = *from;
        }
        changed[i].text = text_of(lines);
        is_changed = is_changed || changed[i].text != files[i].text;
    }
    return is_changed ? std::optional(changed) : std::nullopt;
}

// Two chunks take each other's orientation.
std::optional<ProgramFiles> exchange_directions(const ProgramFiles& files) {
    const auto pose_of = [](const ProgramFile& file) {
        for (const std::string& line : lines_of(file.text)) {
            if (is_lin(line) && line.find(",A ") != std::string::npos) return line.substr(line.find(",A "));
        }
        return std::string();
    };
    for (std::size_t i = next_chunk(files); i < files.size(); i = next_chunk(files, i + 1)) {
        for (std::size_t j = next_chunk(files, i + 1); j < files.size(); j = next_chunk(files, j + 1)) {
            const std::string a = pose_of(files[i]);
            const std::string b = pose_of(files[j]);
            if (a.empty() || b.empty() || a == b) continue;
            ProgramFiles changed = files;
            for (const auto& [at, from, to] : {std::tuple{i, a, b}, std::tuple{j, b, a}}) {
                std::string& text = changed[at].text;
                for (std::size_t p = text.find(from); p != std::string::npos; p = text.find(from, p + to.size())) {
                    text.replace(p, from.size(), to);
                }
            }
            return changed;
        }
    }
    return std::nullopt;
}

void add_geometry(std::vector<Mutation>& all) {
    const std::vector<std::string> xyz{"X", "Y", "Z"};
    const auto times = [](double f) { return [f](double v) { return f * v; }; };
    const auto plus = [](double d) { return [d](double v) { return v + d; }; };
    all.push_back(everywhere("inches_for_mm", each_component("lin ", xyz, times(1 / 25.4))));
    all.push_back(everywhere("metres_for_mm", each_component("lin ", xyz, times(0.001))));
    all.push_back(everywhere("scaled_by_3_percent", each_component("lin ", {"X", "Y"}, times(1.03))));
    all.push_back(everywhere("mirrored_x", each_component("lin ", {"X"}, times(-1))));
    all.push_back(everywhere("mirrored_y", each_component("lin ", {"Y"}, times(-1))));
    all.push_back(everywhere("mirrored_z", each_component("lin ", {"Z"}, times(-1))));
    all.push_back(everywhere("sign_lost", each_component("lin ", xyz, [](double v) { return std::abs(v); })));
    all.push_back(
        everywhere("x_and_y_exchanged", each("lin ", [](std::string& l) { return swap_components(l, "X", "Y"); })));
    all.push_back(everywhere("all_2_mm_deeper", each_component("lin ", {"Z"}, plus(-2))));
    all.push_back(everywhere("all_2_mm_higher", each_component("lin ", {"Z"}, plus(2))));
    all.push_back(everywhere("all_2_mm_aside", each_component("lin ", {"X"}, plus(2))));
    all.push_back(in_one_chunk("point_lowered", shifted_point("Z", -5)));
    all.push_back(everywhere("every_tenth_point_lowered", lower_every_tenth));
    all.push_back(in_one_chunk("point_moved_x", shifted_point("X", 15)));
    all.push_back(in_one_chunk("point_moved_y", shifted_point("Y", 15)));
    all.push_back(in_one_chunk("retract_lost", lose_retract));
    all.push_back(everywhere("all_retracts_lost", lose_retracts));
    all.push_back(in_one_chunk("last_retract_lost", lose_last_retract));
    all.push_back(in_one_chunk("moves_reversed", reverse_moves));
    all.push_back(in_one_chunk("every_second_move_lost", lose_every_second));
    all.push_back(everywhere("angle_sign_lost", each_component("lin ", {"A", "B", "C"}, times(-1))));
    all.push_back(
        everywhere("angles_in_wrong_order", each("lin ", [](std::string& l) { return swap_components(l, "A", "C"); })));
    all.push_back(everywhere("tilted_by_2_degrees", each_component("lin ", {"B"}, plus(2))));
    all.push_back(of_files("directions_exchanged", exchange_directions));
}

void add_frames(std::vector<Mutation>& all) {
    const auto times = [](double f) { return [f](double v) { return f * v; }; };
    const auto plus = [](double d) { return [d](double v) { return v + d; }; };
    all.push_back(everywhere("tool_10_mm_longer", each_component("$tool", {"Z"}, plus(10))));
    all.push_back(everywhere("tool_half_mm_shorter", each_component("$tool", {"Z"}, plus(-0.5))));
    all.push_back(everywhere("stale_tool_table", each_component("$tool", {"X"}, plus(0.2))));
    all.push_back(everywhere("base_20_mm_aside", each_component("$base", {"X"}, plus(20))));
    all.push_back(everywhere("base_1_mm_lower", each_component("$base", {"Z"}, plus(-1))));
    all.push_back(everywhere("base_turned", each_component("$base", {"A"}, plus(3))));
    all.push_back(everywhere("load_lost", without("$load")));
    all.push_back(in_one_chunk("load_lost_in_a_chunk", without("$load")));
    all.push_back(everywhere("load_centre_300_mm_off", each_component("$load", {"X"}, plus(300))));
    all.push_back(everywhere("load_centre_at_the_tip", each_component("$load", {"Z"}, plus(350))));
    all.push_back(everywhere("load_without_spindle", each_component("$load", {"M"}, plus(-15))));
    all.push_back(everywhere("load_inertia_times_10", each("$load", [times](std::string& line) {
                                 const std::size_t at = line.find(",J {");
                                 if (at == std::string::npos) return false;  // it is named
                                 std::string inertia = line.substr(at);
                                 line.resize(line.size() - inertia.size());
                                 bool is_changed = false;
                                 for (const char* component : {"X", "Y", "Z"})
                                     is_changed |= change_number(inertia, component, times(10));
                                 line += inertia;
                                 return is_changed;
                             })));
    all.push_back(everywhere("tool_turned_about_its_axis", each_component("$tool", {"A"}, plus(10))));
    const std::vector<std::string> external{"E1", "E2", "E3", "E4", "E5", "E6"};
    all.push_back(everywhere("table_turned_the_other_way", [times, external](Lines& lines) {
        const bool lin = each_component("lin ", external, times(-1))(lines);
        return each_component("ptp ", external, times(-1))(lines) || lin;
    }));
    all.push_back(in_one_chunk("start_joint_sign_lost", each_component("ptp ", {"A2"}, times(-1))));
    all.push_back(in_one_chunk("start_joint_moved", each_component("ptp ", {"A3"}, plus(12))));
}

void add_speeds(std::vector<Mutation>& all) {
    const auto times = [](double f) { return [f](double v) { return f * v; }; };
    all.push_back(everywhere("feed_times_60", each_value("$vel.cp", times(60))));
    all.push_back(everywhere("feed_times_2", each_value("$vel.cp", times(2))));
    all.push_back(everywhere("feed_by_60", each_value("$vel.cp", times(1.0 / 60))));
    // 150 mm/s is within the window of the tools that rough.
    all.push_back(
        in_roughing("full_feed_in_full_cuts", each_value("$vel.cp", [](double v) { return v < 0.15 ? 0.15 : v; })));
    all.push_back(
        everywhere("rounded_2_mm_farther", each_value("$apo.cdis", [](double v) { return v > 0 ? v + 2 : v; })));
    all.push_back(everywhere("rounding_times_20", [](Lines& lines) {
        const bool larger = each_value("$apo.cdis", [](double v) { return std::min(20 * v, 1000.0); })(lines);
        each("lin ", [](std::string& l) {
            if (!l.ends_with("C_DIS")) l += " C_DIS";
            return true;
        })(lines);
        return larger;
    }));
    all.push_back(everywhere("spindle_never_started", without("$out[", "true")));
    all.push_back(everywhere("spindle_not_waited_for", without("wait ")));
    all.push_back(everywhere("spindle_too_slow", each_value("$anout", times(0.1))));
    all.push_back(everywhere("tool_change_not_asked", without("halt")));
    all.push_back(everywhere("tool_length_wrong_in_the_question", each(";ask tool", [](std::string& line) {
                                 return replace_first(line, 0, "00 mm", "10 mm");
                             })));
    all.push_back(everywhere("acceleration_times_10", each_value("$acc.cp", times(10))));
    all.push_back(in_one_chunk("acceleration_times_10_in_a_chunk", each_value("$acc.cp", times(10))));
    all.push_back(everywhere("orientation_speed_times_10", each_value("$vel.ori", times(10))));
    all.push_back(everywhere("joint_moves_at_full_speed", each_value("$vel_axis", [](double) { return 100; })));
    all.push_back(everywhere("joint_moves_at_full_acceleration", each_value("$acc_axis", [](double) { return 100; })));
    for (const char* word : {"$acc.cp", "$vel.ori2", "$vel_axis[3]", "$acc_axis[6]", "$apo.cdis"}) {
        all.push_back(in_one_chunk(std::string(word) + "_not_stated_in_a_chunk", without(word)));
    }
}

// In the ready cells output 1 is the spindle's, output 2 that of extraction.
void add_signals(std::vector<Mutation>& all) {
    all.push_back(everywhere("extraction_never_on", without("$out[2]", "true")));
    all.push_back(in_last_chunk("extraction_not_on_in_the_last_chunk", without("$out[2]", "true")));
    all.push_back(in_last_chunk("extraction_off_in_the_middle", insert("$OUT[2] = FALSE")));
    all.push_back(in_main_lines("extraction_on_at_the_end", lose("$out[2]", true)));
    all.push_back(in_main_lines("spindle_on_at_the_end", lose("$out[1]", true)));
    all.push_back(in_last_chunk("spindle_off_in_the_middle", insert("$OUT[1] = FALSE")));
    all.push_back(in_last_chunk("spindle_not_on_in_the_last_chunk", without("$out[1]", "true")));
    all.push_back(in_last_chunk("speed_not_waited_for_in_the_last_chunk", without("wait ")));
    all.push_back(in_last_chunk("speed_not_stated_in_the_last_chunk", without("$anout")));
    all.push_back(in_last_chunk("speed_changed_without_waiting", insert("$ANOUT[1] = 0.90000")));
    all.push_back(in_one_chunk("output_of_nobody", insert("$OUT[77] = TRUE")));
    all.push_back(in_one_chunk("waits_for_another_input",
                               each("wait ", [](std::string& line) { return replace_first(line, 0, "[1]", "[2]"); })));
    const auto one_degree = each_component("ptp ", {"A1"}, [](double v) { return v + 1; });
    const auto of_line = [one_degree](bool is_last) {
        return [one_degree, is_last](Lines& lines) {
            std::vector<std::size_t> places;
            for (std::size_t i = 0; i < lines.size(); ++i) {
                if (begins(lines[i], "ptp ")) places.push_back(i);
            }
            if (places.empty()) return false;
            Lines one{lines[is_last ? places.back() : places.front()]};
            one_degree(one);
            lines[is_last ? places.back() : places.front()] = one.front();
            return true;
        };
    };
    all.push_back(in_main_lines("begins_away_from_home", of_line(false)));
    all.push_back(in_main_lines("ends_away_from_home", of_line(true)));
    all.push_back(in_one_chunk("last_corner_rounded", [](Lines& lines) {
        const std::vector<std::size_t> places = lin_places(lines);
        if (places.empty()) return false;
        lines[places.back()] += " C_DIS";
        return true;
    }));
}

// Every line with these words, in lower case, has others in their place; or is left out.
Change in_lines_with(const std::string& words, const std::string& what, const std::string& by) {
    return [words, what, by](Lines& lines) {
        bool is_changed = false;
        for (std::string& line : lines) {
            if (lower(line).find(words) != std::string::npos) is_changed |= replace_first(line, 0, what, by);
        }
        return is_changed;
    };
}

Change without_lines_with(const std::string& words) {
    return [words](Lines& lines) {
        return std::erase_if(lines,
                             [&](const std::string& line) { return lower(line).find(words) != std::string::npos; }) > 0;
    };
}

Mutation without_files(const std::string& name, const std::string& ending) {
    return of_files(name, [ending](const ProgramFiles& files) {
        ProgramFiles changed = files;
        const bool is_changed =
            std::erase_if(changed, [&](const ProgramFile& file) { return lower(file.name).ends_with(ending); }) > 0;
        return is_changed ? std::optional(changed) : std::nullopt;
    });
}

// Of programs with a configuration module.
void add_module(std::vector<Mutation>& all) {
    all.push_back(in_main_lines("dialogs_lost", without_lines_with("_ask(")));
    all.push_back(
        in_main_lines("tool_length_wrong_in_the_dialog", in_lines_with("\"measure tool", "00 mm from", "10 mm from")));
    all.push_back(in_main_lines("another_tool_in_the_dialog", in_lines_with("\"put tool", "tool ", "tool 9")));
    all.push_back(in_main_lines("stops_not_watched", without("interrupt on 21")));
    all.push_back(in_one_chunk("stops_not_watched_in_a_chunk", without("interrupt on 21")));
    all.push_back(in_one_chunk("speed_not_watched", without("interrupt on 22")));
    all.push_back(in_one_chunk("another_input_watched", in_lines_with("interrupt decl 22", "$IN[1]", "$IN[2]")));
    all.push_back(in_one_chunk("speed_watched_the_wrong_way", in_lines_with("interrupt decl 22", "FALSE", "TRUE")));
    all.push_back(
        in_one_chunk("another_routine_for_the_speed", in_lines_with("interrupt decl 22", "_fall(", "_stop(")));
    all.push_back(in_last_chunk("speed_not_watched_from_the_middle_on", insert("INTERRUPT OFF 22")));
    all.push_back(in_one_chunk("speed_not_watched_during_the_last_moves", without("wait sec")));
    all.push_back(in_module("spindle_not_switched_off_by_routines", without("$out[1]")));
    all.push_back(in_module("extraction_not_switched_off_by_one_routine", lose("$out[2]", false)));
    all.push_back(in_module("routine_switches_on", in_lines_with("$out[1]", "FALSE", "TRUE")));
    all.push_back(in_module("arm_not_stopped", without("brake")));
    all.push_back(in_module("tool_not_retracted", without("lin_rel")));
    all.push_back(in_module("tool_retracted_aside", in_lines_with("lin_rel", "{Z", "{X")));
    all.push_back(in_module("tool_driven_into_the_foam", in_lines_with("lin_rel", "-", "")));
    all.push_back(in_module("program_goes_on_after_a_fall", without("loop")));
    all.push_back(in_module("program_goes_on_after_a_stop", lose("endloop", false)));
    all.push_back(in_module("dialog_not_waited_for", without("while ")));
    all.push_back(in_module("no_stop_without_a_dialog", lose("halt", true)));
    all.push_back(in_module("base_lost", without_lines_with("_base =")));
    all.push_back(in_module("data_not_public", in_lines_with("defdat", " PUBLIC", "")));
    all.push_back(without_files("module_lost", "_cfg.src"));
    all.push_back(without_files("data_of_the_module_lost", "_cfg.dat"));
    all.push_back(everywhere("table_at_full_speed", each_value("$vel_extax", [](double) { return 100; })));
    all.push_back(in_one_chunk("speed_of_the_table_not_stated", without("$vel_extax")));
}

void add_chunks(std::vector<Mutation>& all) {
    all.push_back(in_main("chunk_lost", lose_chunk));
    all.push_back(in_main("first_roughing_lost", lose_operation("roughing", false)));
    all.push_back(in_main("last_roughing_lost", lose_operation("roughing", true)));
    all.push_back(in_main("last_fine_finishing_lost", lose_operation("fine finishing", true)));
    all.push_back(in_roughing("depth_doubled", double_depth));
    all.push_back(of_files("chunks_exchanged", swap_chunks));
    all.push_back(of_files("finishing_given_to_the_roughing_tool", finish_with_the_roughing_tool));
    all.push_back(in_main("calls_exchanged", [](ProgramFiles&, Lines& lines, const std::vector<std::size_t>& calls) {
        if (calls.size() < 2) return false;
        std::swap(lines[calls.front()], lines[calls.back()]);
        return true;
    }));
    all.push_back(in_main("call_lost", [](ProgramFiles&, Lines& lines, const std::vector<std::size_t>& calls) {
        if (calls.empty()) return false;
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(calls.back()));
        return true;
    }));
    all.push_back(in_main("chunk_called_twice", [](ProgramFiles&, Lines& lines, const std::vector<std::size_t>& calls) {
        if (calls.empty()) return false;
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(calls.back()), lines[calls.back()]);
        return true;
    }));
    all.push_back(in_main("file_lost", [](ProgramFiles& files, Lines& lines, const std::vector<std::size_t>& calls) {
        if (calls.empty()) return false;
        const std::string stem = called_stem(files, lines[calls.back()]);
        std::erase_if(files, [&](const ProgramFile& file) { return stem_of(file) == stem; });
        return true;
    }));
}

void add_text(std::vector<Mutation>& all) {
    all.push_back(of_text("truncated", [](std::string& text) {
        text.resize(text.size() * 2 / 3);
        return true;
    }));
    all.push_back(of_text("end_lost", [](std::string& text) {
        const std::size_t at = text.rfind("END");
        if (at == std::string::npos) return false;
        text.resize(at);
        return true;
    }));
    all.push_back(of_text("decimal_comma", [](std::string& text) {
        const std::size_t at = text.find("LIN ");
        return at != std::string::npos && replace_first(text, at, ".", ",");
    }));
    all.push_back(of_text("exponent", [](std::string& text) {
        const std::size_t at = text.find("LIN ");
        return at != std::string::npos && replace_first(text, at, ",Y", "E+00,Y");
    }));
    all.push_back(of_text("not_a_number", [](std::string& text) {
        const std::size_t at = text.find("LIN ");
        return at != std::string::npos && replace_first(text, at, "X ", "X nan");
    }));
    all.push_back(of_text("misspelt_word", [](std::string& text) { return replace_first(text, 0, "LIN {", "LNI {"); }));
    all.push_back(of_text("pose_lost", [](std::string& text) {
        const std::size_t at = text.find(",A ", text.find("LIN "));
        const std::size_t end = text.find('}', at);
        if (at == std::string::npos || end == std::string::npos) return false;
        text.erase(at, end - at);
        return true;
    }));
}

}  // namespace

std::vector<Mutation> all_mutations() {
    std::vector<Mutation> all;
    add_geometry(all);
    add_frames(all);
    add_speeds(all);
    add_signals(all);
    add_module(all);
    add_chunks(all);
    add_text(all);
    return all;
}

std::vector<Mutation> chunk_mutations() {
    std::vector<Mutation> all;
    add_chunks(all);
    return all;
}

std::vector<Mutation> mutations_of(Dialect dialect) {
    if (dialect == Dialect::rapid) return rapid_mutations();
    return dialect == Dialect::ngc ? ngc_mutations() : all_mutations();
}

std::vector<std::string> called_chunks(const ProgramFiles& files, const std::string& main) {
    std::vector<std::string> called;
    for (const ProgramFile& file : files) {
        if (stem_of(file) != lower(main) || !is_source(file)) continue;
        for (const std::string& line : lines_of(file.text)) {
            const std::string stem = called_stem(files, line);
            if (!stem.empty()) called.push_back(stem);
        }
    }
    return called;
}

}  // namespace qchopper
