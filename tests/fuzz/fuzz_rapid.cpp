// Robot programs in RAPID. Bytes are given as they are, and once more with the ends of lines made right and the heads
// added.

#include "sim/program/rapid_reader.h"
#include "tests/fuzz/program_files.h"

namespace qchopper {
namespace {

std::string with_head(const std::string& name, const std::string& body) {
    return "%%%\r\n  VERSION:1\r\n  LANGUAGE:ENGLISH\r\n%%%\r\nMODULE " + name + "\r\n" + with_line_ends(body) +
           "ENDMODULE\r\n";
}

void try_files(const std::vector<ProgramFile>& files) {
    or_refused(InputFault::mesh, [&] { demand_complete(read_rapid(files, "m", {"change_tool"}), true); });
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = qchopper::text_of(data, size);
    qchopper::try_files(qchopper::program_files(text, ".mod", qchopper::as_given));
    qchopper::try_files(qchopper::program_files(text, ".mod", qchopper::with_head));
    return 0;
}
