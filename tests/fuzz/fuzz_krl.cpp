// Robot programs in KRL. Bytes are given as they are, once more with the ends of lines made right and the heads added,
// and so again with the last two files as source and data of a configuration module.

#include "sim/program/krl_reader.h"
#include "tests/fuzz/program_files.h"

namespace qchopper {
namespace {

std::string with_head(const std::string& name, const std::string& body) {
    return "&ACCESS RVP\r\n&REL 1\r\nDEF " + name + "( )\r\n" + with_line_ends(body) + "END\r\n";
}

std::vector<ProgramFile> with_module(const std::string& text) {
    std::vector<ProgramFile> files = program_files(text, ".src", as_given);
    if (files.size() < 3) return {};
    for (std::size_t i = 0; i + 2 < files.size(); ++i) {
        files[i].text = with_head(files[i].name.substr(0, files[i].name.find('.')), files[i].text);
    }
    ProgramFile& source = files[files.size() - 2];
    source = {"m_cfg.src", with_head("m_cfg", source.text)};
    files.back() = {"m_cfg.dat", "DEFDAT m_cfg PUBLIC\r\n" + with_line_ends(files.back().text) + "ENDDAT\r\n"};
    return files;
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
    qchopper::try_files(qchopper::with_module(text));
    return 0;
}
