// Programs in RS-274/NGC. Bytes are given as they are, and once more with the ends of lines made right and what opens
// and closes a file added.

#include "sim/program/ngc_reader.h"
#include "tests/fuzz/program_files.h"

namespace qchopper {
namespace {

std::string with_ends(const std::string& name, const std::string& body) {
    if (name == "m") return with_line_ends(body) + "M2\r\n";
    return "o<" + name + "> sub\r\n" + with_line_ends(body) + "o<" + name + "> endsub\r\n";
}

void try_files(const std::vector<ProgramFile>& files) {
    or_refused(InputFault::mesh, [&] { demand_complete(read_ngc(files, "m", {"change_tool"}), false); });
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = qchopper::text_of(data, size);
    qchopper::try_files(qchopper::program_files(text, ".ngc", qchopper::as_given));
    qchopper::try_files(qchopper::program_files(text, ".ngc", qchopper::with_ends));
    return 0;
}
