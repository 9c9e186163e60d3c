// One row for each language.

#include "sim/replay/read_program.h"

#include <algorithm>
#include <array>

#include "sim/program/krl_reader.h"
#include "sim/program/ngc_reader.h"
#include "sim/program/rapid_reader.h"
#include "sim/replay/signal_walk.h"

namespace qchopper {
namespace {

using Files = std::span<const ProgramFile>;
using Calls = std::vector<std::string>;

struct ReaderRow {
    Dialect dialect;
    ParsedProgram (*read)(Files, std::string_view, const Calls&);
};

constexpr std::array<ReaderRow, 3> readers{
    {{Dialect::krl, read_krl}, {Dialect::rapid, read_rapid}, {Dialect::ngc, read_ngc}}};

}  // namespace

ParsedProgram read_program(Dialect dialect, std::span<const ProgramFile> files, std::string_view main,
                           const Cell& cell) {
    return std::ranges::find(readers, dialect, &ReaderRow::dialect)->read(files, main, called_programs(cell));
}

}  // namespace qchopper
