// Differences of frames in mm and as one angle; of load data in mass, centre and tensor. O(states).

#include "sim/replay/state_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "sim/replay/carried_load.h"
#include "sim/replay/turn.h"

namespace qchopper {
namespace {

constexpr double frame_mm = 0.01;  // of $TOOL and $BASE
constexpr double frame_turn = 0.01 * degree;
constexpr double written = 1.001;  // what rounding of a value may do to a limit

// How a language calls what is stated.
struct StateWords {
    const char* tool;
    const char* base;
    const char* load;
    const char* acceleration;
    const char* turn;
    const char* axis_speed;
    const char* axis_acceleration;
};

const StateWords& words_of(const CellMachine& machine) {
    static constexpr StateWords krl{"$TOOL", "$BASE", "$LOAD", "$ACC.CP", "$VEL.ORI", "$VEL_AXIS", "$ACC_AXIS"};
    static constexpr StateWords rapid{"the frame of the tooldata",
                                      "the frame of the wobjdata",
                                      "the load of the tooldata",
                                      "PathAccLim",
                                      "v_ori of the speeddata, ",
                                      "VelSet, axis ",
                                      "AccSet, axis "};
    return machine.program.dialect == Dialect::rapid ? rapid : krl;
}

std::string words(const CarriedLoad& load) {
    return fixed(load.mass_kg, 2) + " kg at " + fixed(load.centre.x, 1) + " " + fixed(load.centre.y, 1) + " " +
           fixed(load.centre.z, 1);
}

// By how many tolerances two loads differ; at most 1: they are equal.
double tolerances_between(const CarriedLoad& a, const CarriedLoad& b, const LoadTolerance& tolerance) {
    const auto share = [](double off, double most) { return off <= most ? 0 : off / std::max(most, 1e-9); };
    return std::max({share(std::abs(a.mass_kg - b.mass_kg), tolerance.mass_kg),
                     share(norm(a.centre - b.centre), tolerance.centre_mm),
                     share(inertia_off(a, b), tolerance.inertia_kg_m2)});
}

}  // namespace

StateCheck::StateCheck(const ReplayScene& scene, const Pose& setup_in_table, FindingLog& log)
    : scene_(scene), machine_(*scene.cell->machine), setup_in_table_(setup_in_table), log_(log) {}

bool StateCheck::Last::is_new(const MoveContext& move) {
    if (chunk == move.chunk && state == move.state) return false;
    chunk = move.chunk;
    state = move.state;
    return true;
}

void StateCheck::take_line(const ModalState& state, const MoveContext& move) {
    if (!line_.is_new(move)) return;
    check_tool_frame(state, move);
    check_base_frame(state, move);
    check_load(state, move);
    const ProgramSettings& most = machine_.program;
    check_limit(words_of(machine_).acceleration, state.acceleration / 1000, most.acceleration / 1000, "m/s2",
                move.place);
    for (std::size_t i = 0; i < 2; ++i) {
        check_limit(words_of(machine_).turn + std::to_string(i + 1), state.turn_speed[i] / degree,
                    most.turn_speed / degree, "degrees/s", move.place);
    }
}

void StateCheck::take_joint_move(const ModalState& state, const MoveContext& move) {
    if (!joint_move_.is_new(move)) return;
    check_load(state, move);
    const double most = 100 * machine_.program.joint_share;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const std::string number = "[" + std::to_string(axis + 1) + "]";
        check_limit(words_of(machine_).axis_speed + number, 100 * state.axis_speed[axis], most, "%", move.place);
        check_limit(words_of(machine_).axis_acceleration + number, 100 * state.axis_acceleration[axis], most, "%",
                    move.place);
    }
    check_limit("$VEL_EXTAX", 100 * state.table_speed, most, "%", move.place);
    check_limit("$ACC_EXTAX", 100 * state.table_acceleration, most, "%", move.place);
}

void StateCheck::check_limit(const std::string& name, double stated, double most, const char* unit, SourcePlace place) {
    if (stated <= written * most) return;
    log_.add(FindingKind::motion_limit, place, stated, stated / most, [&] {
        return name + " is " + fixed(stated, 2) + " " + unit + " here, the cell file allows " + fixed(most, 2);
    });
}

void StateCheck::check_tool_frame(const ModalState& state, const MoveContext& move) {
    const Pose said = pose_of(*state.tool);
    const Pose& nose = machine_.spindle.spindle_in_flange;
    const Vec3 axis = column(nose, machine_.spindle.tool_axis == ToolAxis::z ? 2 : 0);
    const double off = norm(said.shift - (nose.shift + gauge_length(*move.tool) * axis));
    const double turn = turn_between(said, nose).angle;
    if (off <= frame_mm && turn <= frame_turn) return;
    log_.add(FindingKind::tool_frame, move.place, off, std::max(off, turn * 1000), [&] {
        return std::string(words_of(machine_).tool) + " is " + fixed(off, 3) + " mm and " + fixed(turn / degree, 3) +
               " degrees from tool " + std::to_string(move.tool->number) + " of the cell file";
    });
}

void StateCheck::check_base_frame(const ModalState& state, const MoveContext& move) {
    const Pose said = pose_of(*state.base);
    const bool turns = machine_.rotary_table.has_value();
    const Pose wanted =
        turns ? setup_in_table_
              : inverse(machine_.robot->base_in_cell) * scene_.orientations[move.orientation].setup_in_cell;
    const double off = norm(said.shift - wanted.shift);
    const double turn = turn_between(said, wanted).angle;
    const std::uint32_t machine = turns ? static_cast<std::uint32_t>(machine_.rotary_table->external_axis) + 1 : 0;
    if (off <= frame_mm && turn <= frame_turn && state.base_machine == machine) return;
    log_.add(FindingKind::base_frame, move.place, off, std::max(off, turn * 1000), [&] {
        if (state.base_machine != machine)
            return std::string(words_of(machine_).base) + " is not chained to the table as the cell is built";
        return std::string(words_of(machine_).base) + " is " + fixed(off, 3) + " mm and " + fixed(turn / degree, 3) +
               " degrees from where the job says";
    });
}

void StateCheck::check_load(const ModalState& state, const MoveContext& move) {
    const CarriedLoad stated = state.load ? carried_load(*state.load) : CarriedLoad{};
    CarriedLoad nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const CuttingTool& tool : machine_.tools) {
        if (move.tool != nullptr && move.tool != &tool) continue;
        CuttingTool planned = tool;  // load data is not entered anew
        planned.stick_out += scene_.planned_length(tool) - gauge_length(tool);
        const CarriedLoad expected = carried_load(machine_.spindle, planned);
        const double off = tolerances_between(stated, expected, machine_.load_tolerance);
        if (off < least) least = off, nearest = expected;
    }
    if (least <= 1) return;
    const LoadTolerance& tolerance = machine_.load_tolerance;
    log_.add(FindingKind::load, move.place, least, least, [&] {
        return std::string(words_of(machine_).load) + " is " + words(stated) + ", spindle and tool are " +
               words(nearest) + "; the moments of inertia differ by up to " + fixed(inertia_off(stated, nearest), 3) +
               " kg m2 (allowed: " + fixed(tolerance.mass_kg, 2) + " kg, " + fixed(tolerance.centre_mm, 1) + " mm, " +
               fixed(tolerance.inertia_kg_m2, 3) + " kg m2)";
    });
}

}  // namespace qchopper
