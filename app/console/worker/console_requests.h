// The bodies of the requests of the console, read from JSON (docs/developer/console.md is the grammar).
//
// Lengths in mm about the scan's centre. Reading throws InputError (use) for what is no JSON, has a key that is not
// known or a value that is wrong, or asks for none or several things at once
// (tests/app/console/console_requests_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/console/worker/dispatch_plan.h"
#include "app/console/worker/strokes.h"
#include "app/engine/setup_project.h"
#include "app/store/decisions.h"
#include "base/enum_names.h"

namespace qchopper {

struct CutOrder {
    std::optional<std::string> piece;  // nothing: the one that the rules choose
    std::vector<double> plane;         // four numbers: a unit normal, the offset
    std::optional<std::size_t> k;      // the place in the ranking, from 1, that holds this plane bit for bit
    bool operator==(const CutOrder&) const = default;
};

struct NamedPieces {
    std::vector<std::string> pieces;
};

// One of these.
struct DecisionBody {
    std::optional<CutOrder> cut;
    std::optional<GivenWeights> weights;
    std::optional<NamedPieces> discard;
    std::optional<SetupRequest> setup;
    std::optional<std::string> undo;  // what the person was shown: "Undo cut 3 on piece C"
    std::optional<std::string> redo;
    std::optional<std::size_t> back_to;  // so many decisions stay in force
    bool reset = false;
};

struct RankQuestion {
    std::optional<std::string> piece;
    std::optional<GivenWeights> weights;
    std::size_t top = 10;
};

struct PreviewQuestion {
    std::optional<std::string> piece;
    std::vector<double> plane;  // four numbers
    bool setups = false;        // and how its pieces would be milled
};

struct JobsQuestion {};     // what could be handed over: the document of a plan
struct DisplayQuestion {};  // the pieces as they are drawn

struct ExplainQuestion {
    int cut = 0;  // its number; 0: the last one
};

// One of these, and the lane: of the questions that wait in a lane only the newest is answered.
struct QuestionBody {
    std::string lane;
    std::optional<RankQuestion> rank;
    std::optional<PreviewQuestion> preview;
    std::optional<ExplainQuestion> explain;
    std::optional<SetupRequest> setups;
    std::optional<JobsQuestion> jobs;
    std::optional<DisplayQuestion> display;
};

// How a scan becomes a solid, as the options of repair and segment.
struct RepairBody {
    std::optional<std::string> fill;
    std::optional<double> snap_borders_mm;
    std::optional<double> alpha_wrap_mm;
    bool resolve_self_intersections = false;
    bool smooth_pen_grooves = false;
    bool operator==(const RepairBody&) const = default;
};

struct CheckBody {
    std::string scan;                  // its id
    std::optional<std::string> units;  // as the option of inspect
    bool deep = false;                 // self-intersections too
};

struct NewProjectBody {
    std::string check;  // its id
    std::string name;   // without .qch
    std::optional<std::string> units;
    std::optional<double> scale;
    std::optional<std::string> cell;  // a name of ConsoleChoices
    std::optional<std::string> preset;
    std::optional<double> fragment_volume_mm3;
    bool size_ok = false;  // any size is taken
    RepairBody repair;
    std::optional<std::string> cuts_of;  // the id of a project: its cuts are made again, and its weights are taken
    std::vector<Stroke> strokes;         // in the order in which they were painted
};

enum class WorkKind { check, repair, project, search, prepare, setups, verify, replay, dry_run, export_pieces, guide };

constexpr auto names_of(WorkKind) {
    return EnumNames<WorkKind, 11>{{{WorkKind::check, "check"},
                                    {WorkKind::repair, "repair"},
                                    {WorkKind::project, "project"},
                                    {WorkKind::search, "search"},
                                    {WorkKind::prepare, "prepare"},
                                    {WorkKind::setups, "setups"},
                                    {WorkKind::verify, "verify"},
                                    {WorkKind::replay, "replay"},
                                    {WorkKind::dry_run, "dry_run"},
                                    {WorkKind::export_pieces, "export"},
                                    {WorkKind::guide, "guide"}}};
}

struct WorkBody {
    WorkKind kind = WorkKind::prepare;
    std::optional<std::string> piece;   // of verify, replay
    std::optional<std::uint16_t> part;  // of the piece's program, of replay
};

struct TicketBody {
    std::string path;
};

struct HandOverBody {
    std::string plan;                  // its id
    std::optional<std::string> typed;  // the name of a real cell, as the person has typed it
};

enum class QueueAction { pause, go_on, remove };

struct QueueBody {
    QueueAction action = QueueAction::pause;
    std::optional<std::string> entry;  // to be removed
};

struct CellCommandBody {
    std::string command;             // hold, unhold, stop, abort, clear or reset
    std::optional<std::string> job;  // that the person saw in the cell; not of hold
};

struct SimulatorBody {
    std::string line;  // of docs/user/cell-sim.md
};

PlanOrder read_plan(const std::string& json);
HandOverBody read_hand_over(const std::string& json);
QueueBody read_queue(const std::string& json);
CellCommandBody read_cell_command(const std::string& json);
SimulatorBody read_simulator(const std::string& json);
CheckBody read_check(const std::string& json);
RepairBody read_repair(const std::string& json);
NewProjectBody read_new_project(const std::string& json);
std::string to_json(const PlanOrder& order);
WorkBody read_work(const std::string& json);
TicketBody read_ticket(const std::string& json);
DecisionBody read_decision(const std::string& json);
QuestionBody read_question(const std::string& json);

}  // namespace qchopper
