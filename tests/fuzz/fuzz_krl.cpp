// Robot programs in KRL. Bytes are given as they are, and once more with the ends of lines made right and the heads
// added.

#include "sim/program/krl_reader.h"
#include "tests/fuzz/program_files.h"

namespace qchopper {
namespace {

std::string with_head(const std::string& name, const std::string& body) {
    return "&ACCESS RVP\r\n&REL 1\r\nDEF " + name + "( )\r\n" + with_line_ends(body) + "END\r\n";
}

void try_files(const std::vector<ProgramFile>& files) {
    or_refused(InputFault::mesh, [&] { demand_complete(read_krl(files, "m", {"change_tool"}), true); });
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text = qchopper::text_of(data, size);
    qchopper::try_files(qchopper::program_files(text, ".src", qchopper::as_given));
    qchopper::try_files(qchopper::program_files(text, ".src", qchopper::with_head));
    return 0;
}
