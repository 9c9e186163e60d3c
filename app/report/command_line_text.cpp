// A table of rows and its linear search. O(rows + characters).
//
// In a row {N} is the value N, {word N} the same as one word of a shell; what stands in [] is left out if its value is
// empty.

#include "app/report/command_line_text.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <string_view>

#include "base/printable.h"

namespace qchopper {
namespace {

struct Row {
    const char* key;
    const char* text;
};

constexpr Row rows[] = {
    // the scan and its repair
    {"larger_voxel", "give --voxel a larger length"},
    {"positive_voxel", "give --voxel a length above 0"},
    {"another_voxel", "give --voxel another length"},
    {"give_unit", "pass --units mm, cm, m or in"},
    {"leave_unit", "leave --units out; if the file is wrong, save it in a format without units, such as PLY"},
    {"check_unit", "check --units, or export the scan again"},
    {"leave_scale", "leave --scale out for 1"},
    {"help_of_repair", "see qchopper repair --help"},
    {"mask", "a mask, if it may stay: --ignore-inside, or --ignore-surface FILE"},
    {"smaller_fragments", "check the scan, or make the project again with a smaller --fragment-volume"},
    {"new_with_structure", "leave its weight out, or make a new project with --structure"},
    {"new_with_symmetry", "leave its weight out, or make a new project with --symmetry"},
    // cutting
    {"see_ranking", "see it by --step"},
    {"set_stop_rule", "pass --min-cuts N, --max-faces N, --max-obb X,Y,Z or --max-unreachable SHARE"},
    {"taken_back", "All cuts and discarded pieces are taken back; --undo brings them again."},
    {"discarded", "Discarded: {0}; --undo brings back what this decision left out."},
    {"go_on_by_search", "{0}; go on by --auto."},
    {"go_on_with_prepare", "{0}; go on with: qchopper prepare {word 1}."},
    // cell and tools
    {"give_cell", "pass --cell FILE, for example cells/foam-1.toml"},
    {"name_cell", "name the cell: --cell FILE"},
    {"give_cell_file", "pass --cell FILE"},
    {"leave_tools", "leave --tools out"},
    {"leave_fine_tools", "leave --finest-tool and --fine out"},
    {"smaller_finest_tool", "give a smaller diameter to --finest-tool"},
    // setups
    {"more_orientations", "more tool orientations: qchopper setup {word 1} --piece {2} --orientations {0}"},
    {"see_setup_limit", "finishing by hand: it is limited to {0}, see qchopper setup {word 1} --piece {2}"},
    {"another_cut", "another cut: qchopper segment {word 0} --piece {1} --step"},
    {"larger_tilt", "{0}, or {1}"},
    // export
    {"export_one_by_one", "export them one by one with --piece, or simplify them"},
    {"max_faces_too", "pass --max-faces N too"},
    {"folder_or_piece", "name a folder to make, or one piece by --piece"},
    {"simplify_by_deviation", "allow more faces; or pass --simplify {0} for as few as that deviation allows"},
    {"cell_for_pose", "name one by: qchopper segment {word 0} --cell FILE; or leave --pose out"},
    // work of many processes
    {"write_items", "qchopper prepare {word 0} --items"},
    {"write_items_again", "write the items again: qchopper prepare NAME.qch --items"},
    {"no_items_yet",
     "no items are written before the cutting has ended; go on with: qchopper prepare {word 0} --items"},
    // dispatch
    {"dispatch", "qchopper dispatch {word 0}[ --piece {1}][ --to {2}][ --drop {3}]"},
    {"give_address", "pass --to HOST:PORT"},
    {"give_address_or_cell", "pass --to HOST:PORT, or --cell FILE"},
    {"give_drop_folder", "pass --drop DIR, or --chunks"},
    {"drop_folder",
     "mount its share or make it, or name the one of the cell with --drop DIR; small files can go over the link with "
     "--chunks"},
    {"accept_unreachable", "{0}; pass --accept-unreachable if the foam that stays there may stay"},
    {"asks_accept_unreachable", "{0}; dispatch asks for --accept-unreachable"},
    {"accept_workholding", "{0}; pass --accept-workholding if the piece is held by more than that"},
    {"sign_ticket", "the cell requires signed tickets: pass --key NAME, the private key that signs them"},
    {"give_passphrase", "pass --passphrase-fd N, and write the passphrase into that descriptor"},
    {"make_key_without_passphrase", "type one; --no-passphrase makes a key that anyone who has the file can use"},
    {"name_key", "give this one another name by --name NAME"},
    {"name_piece", "name it by --piece"},
    {"look_then_restart",
     "Look at the block and at the chunk in which the machine stood. If both are of this job, pass --again."},
    {"carve_again", "Pass --again if it is to be carved once more."},
    {"look_then_carve_again", "Look at the cell. The file is carved once more only with --again."},
    {"look_for_piece", "Look for the piece or a block that is cut. Where neither is there, pass --again."},
    {"open_job_is_lost", "{0} The next dispatch starts this file only with --again."},
    {"open_jobs_are_settled", "What was open is not asked for any more, and carved only with --again."},
    {"rehearse", "Pass --rehearse."},
    // at the cell
    {"look_first", "Go to the cell and look whether it cuts. Ask it: qchopper cell status[ --to {0}]. {1}"},
    {"look_at_cell", "Look at the cell: qchopper cell status[ --to {0}]"},
    {"look_at_job", "Look at the cell: qchopper cell status[ --to {0}]. The next dispatch follows the job to its end."},
    {"look_then_ask_cell", "Look at the cell, then ask it: qchopper cell status[ --to {0}]"},
    {"see_cell", "See what the cell shows: qchopper cell status[ --to {0}]"},
    {"stop_then_ask_cell",
     "If the machine must stop now, press the red button at the cell. Then ask the cell: qchopper cell status[ --to "
     "{0}]"},
    {"stop_there",
     "If it must not run on: qchopper cell stop[ --to {0}], or the panel of the cell. The next dispatch follows it to "
     "its end."},
    {"try_again_later", "Try again when it has ended: qchopper cell status[ --to {0}]"},
    {"wait_for_idle",
     "Look at the panel of the cell. Dispatch again when it is in Idle: qchopper cell status[ --to {0}]"},
    {"wait_or_take_over",
     "Wait until the other dispatcher has finished (qchopper cell status[ --to {0}]), or end its lease by the code of "
     "the panel: qchopper cell take-over --code N[ --to {0}]"},
    {"look_then_accept_store", "Look at the cell, then accept its memory: qchopper cell accept-store[ --to {0}]"},
    {"accept_memory",
     "Look at the cell and what it has cut, then accept its memory: qchopper cell accept-store[ --to {0}]"},
    {"help_of_cell", "see qchopper cell --help"},
    {"list_who_may_connect",
     "Listen on 127.0.0.1, or name who may connect: --allow with numeric addresses, apart by commas."},
    {"list_faults", "docs/user/cell-sim.md lists the commands, `qchopper cell-sim --list-faults` the faults."},
};

// The value of the place that `text` begins behind its "{", which ends before its "}".
std::string value_at(std::string_view place, const Sentence& sentence) {
    constexpr std::string_view as_word = "word ";
    const bool is_word = place.starts_with(as_word);
    if (is_word) place.remove_prefix(as_word.size());
    assert(place.size() == 1 && place[0] >= '0' && place[0] <= '9');
    const auto number = static_cast<std::size_t>(place[0] - '0');
    assert(number < sentence.values.size());
    const std::string value = command_line_text(sentence.values[number]);
    return is_word ? shell_word(value) : value;
}

// A row, or what stands in [] in it, with its values; empty if `is_optional` and a value is.
std::string completed(std::string_view row, const Sentence& sentence, bool is_optional) {
    std::string text;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i] != '{' && row[i] != '[') {
            text += row[i];
            continue;
        }
        const std::size_t end = row.find(row[i] == '{' ? '}' : ']', i);
        assert(end != std::string_view::npos);
        const std::string_view inner = row.substr(i + 1, end - i - 1);
        const std::string value = row[i] == '{' ? value_at(inner, sentence) : completed(inner, sentence, true);
        if (value.empty() && is_optional) return {};
        text += value;
        i = end;
    }
    return text;
}

}  // namespace

std::string command_line_text(const Sentence& sentence) {
    if (sentence.key.empty()) return sentence.text;
    const Row* const row = std::ranges::find(rows, sentence.key, &Row::key);
    assert(row != std::end(rows));
    return completed(row->text, sentence, false);
}

std::vector<std::string> command_line_text(const std::vector<Sentence>& sentences) {
    std::vector<std::string> texts;
    texts.reserve(sentences.size());
    for (const Sentence& sentence : sentences) texts.push_back(command_line_text(sentence));
    return texts;
}

}  // namespace qchopper
