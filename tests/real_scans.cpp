#include "tests/real_scans.h"

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace qchopper {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
        if (c == '\t') cells.emplace_back();
        if (c != '\t') cells.back() += c;
    }
    return cells;
}

std::size_t column(const std::vector<std::string>& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw std::runtime_error("MANIFEST.tsv has no column " + name);
    return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

std::vector<RealScan> valid_scans(const std::filesystem::path& folder, std::size_t faces) {
    if (!std::filesystem::exists(folder)) return {};
    std::ifstream manifest(folder / "MANIFEST.tsv");
    std::string line;
    if (!std::getline(manifest, line)) throw std::runtime_error(folder.string() + " has no MANIFEST.tsv");
    const std::vector<std::string> names = cells_of(line);
    const std::size_t file = column(names, "file");
    const std::size_t format = column(names, "format");
    const std::size_t count = column(names, "F");
    const std::size_t closed = column(names, "closed");
    const std::size_t notes = column(names, "notes");
    std::vector<RealScan> scans;
    while (std::getline(manifest, line)) {
        const std::vector<std::string> cells = cells_of(line);
        if (cells.size() != names.size()) throw std::runtime_error("MANIFEST.tsv: not a whole row: " + line);
        if (cells[closed] != "1" || cells[notes].find("selfint=0") == std::string::npos) continue;
        if (!cells[format].starts_with("PLY") && !cells[format].starts_with("STL")) continue;
        const RealScan scan{cells[file], std::stoul(cells[count])};
        if (scan.faces < faces) scans.push_back(scan);
    }
    return scans;
}

}  // namespace qchopper
