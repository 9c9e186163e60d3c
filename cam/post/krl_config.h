// The configuration module of a KRL program: base and tools, which stand there once, and what asks the operator and
// stops the machine.
//
// NAME_cfg.dat states the frames, NAME_cfg.src the routines that all files of the program call. A touched-off base and
// measured tools are entered in NAME_cfg.dat. docs/developer/formats/programs.md gives every line.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/post/krl_text.h"
#include "cam/program/program.h"

namespace qchopper {

// Names that the module declares and all files of the program use.
struct KrlNames {
    std::string piece;  // "qc_7"
    std::string module() const { return piece + "_cfg"; }
    std::string base() const { return piece + "_base"; }
    std::string tool(std::uint16_t number) const { return piece + "_t" + std::to_string(number); }
    std::string load(std::uint16_t number) const { return piece + "_l" + std::to_string(number); }
    std::string stopped() const { return piece + "_stop"; }
    std::string fallen() const { return piece + "_fall"; }
    std::string ask() const { return piece + "_ask"; }
    std::string say() const { return piece + "_say"; }
};

// Its files, .src and .dat, with the tools of all operations. Precondition: check_signals() holds. O(operations).
std::vector<ProgramText> krl_config(const Program& program, const CellMachine& machine, const KrlNames& names);

namespace krl {

// A dialog for each sentence, which the operator acknowledges before the program goes on; a sentence of more than 80
// characters is divided between words.
void ask(const KrlNames& names, const std::vector<std::string>& sentences, KrlText& text);
// A message that is not waited for. Precondition: at most 80 characters.
void say(const KrlNames& names, const std::string& sentence, KrlText& text);

// From here to the end of the file a stop of the program switches spindle and extraction off and ends the program.
void watch_stops(const KrlNames& names, KrlText& text);
// From here to unwatch_signals() a spindle or an extraction that is no longer running does so too and retracts the
// tool, where the cell file names an input for it.
void watch_signals(const CellMachine& machine, const KrlNames& names, KrlText& text);
void unwatch_signals(const CellMachine& machine, KrlText& text);

}  // namespace krl

}  // namespace qchopper
