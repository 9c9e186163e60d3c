// A chain of names; each knows the range of its value.

#include "sim/program/krl_parts.h"

namespace qchopper {
namespace {

constexpr double per_metre = 1000;           // mm
constexpr double largest_speed = 3;          // m/s
constexpr double largest_acceleration = 20;  // m/s2
constexpr double largest_turn = 3600;        // degrees/s

// The value of NAME = value.
double value_of(ProgramLine& line, double least, double largest) {
    line.need('=');
    return line.number(least, largest);
}

double above_zero(ProgramLine& line, double largest) {
    const double value = value_of(line, 0, largest);
    if (value <= 0) line.refuse("the value must be above 0");
    return value;
}

// [i] = percent
void read_axis(ProgramLine& line, std::array<double, 6>& shares, std::array<bool, 6>& stated) {
    const std::uint32_t axis = line.index(1, 6);
    shares[axis - 1] = above_zero(line, 100) / 100;
    stated[axis - 1] = true;
}

// The same of an external axis, of which a program has one.
double read_external(ProgramLine& line) {
    line.index(1, 6);
    return above_zero(line, 100) / 100;
}

// EK(MACHINE_DEF[n].ROOT,MACHINE_DEF[n].MECH_TYPE,{...})
void read_chained_base(ProgramLine& line, const KrlModule& module, ModalState& state) {
    const auto machine = [&](std::string_view member) {
        line.need_word("machine_def");
        const std::uint32_t n = line.index(2, 7);
        line.need('.');
        line.need_word(member);
        line.need(',');
        return n;
    };
    line.need('(');
    const std::uint32_t root = machine("root");
    const std::uint32_t type = machine("mech_type");
    if (root != type) line.refuse("the base is chained to two machines");
    state.base = read_frame(line, module);
    line.need(')');
    state.base_machine = root;
}

void read_base(ProgramLine& line, const KrlModule& module, ModalState& state) {
    line.need('=');
    if (line.takes_word("ek")) return read_chained_base(line, module, state);
    state.base = read_frame(line, module);
    state.base_machine = 0;
}

void read_speed(ProgramLine& line, ModalState& state, StatedHere& stated) {
    line.need('.');
    const std::string which = line.word();
    if (which == "cp") {
        state.feed = per_metre * above_zero(line, largest_speed);
        stated.feed = true;
    } else if (which == "ori1" || which == "ori2") {
        const std::size_t turn = which == "ori1" ? 0 : 1;
        state.turn_speed[turn] = degree * above_zero(line, largest_turn);
        stated.turn_speed[turn] = true;
    } else {
        line.refuse("$VEL." + which + " is not known");
    }
}

void read_acceleration(ProgramLine& line, ModalState& state, StatedHere& stated) {
    line.need('.');
    line.need_word("cp");
    state.acceleration = per_metre * above_zero(line, largest_acceleration);
    stated.acceleration = true;
}

void read_rounding(ProgramLine& line, ModalState& state, StatedHere& stated) {
    line.need('.');
    line.need_word("cdis");
    state.rounding = value_of(line, 0, per_metre);
    stated.rounding = true;
}

}  // namespace

bool read_assignment(const std::string& name, ProgramLine& line, const KrlModule& module, ModalState& state,
                     StatedHere& stated) {
    if (name == "$advance") {
        state.look_ahead = static_cast<int>((line.need('='), line.integer(0, 5)));
    } else if (name == "$apo") {
        read_rounding(line, state, stated);
    } else if (name == "$vel") {
        read_speed(line, state, stated);
    } else if (name == "$acc") {
        read_acceleration(line, state, stated);
    } else if (name == "$vel_axis") {
        read_axis(line, state.axis_speed, stated.axis_speed);
    } else if (name == "$acc_axis") {
        read_axis(line, state.axis_acceleration, stated.axis_acceleration);
    } else if (name == "$vel_extax") {
        state.table_speed = read_external(line);
        stated.table_speed = true;
    } else if (name == "$acc_extax") {
        state.table_acceleration = read_external(line);
        stated.table_acceleration = true;
    } else if (name == "$load") {
        line.need('=');
        state.load = read_load(line, module);
        stated.load = true;
    } else if (name == "$tool") {
        line.need('=');
        state.tool = read_frame(line, module);
        stated.tool = true;
        stated.pose = false;
    } else if (name == "$base") {
        read_base(line, module, state);
        stated.base = true;
        stated.pose = false;
    } else {
        return false;
    }
    line.need_end();
    return true;
}

}  // namespace qchopper
