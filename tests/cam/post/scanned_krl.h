// A plain scanner of emitted KRL for tests: what every line says, without judging it. It shares nothing with the reader
// in sim, nor with the post.

#pragma once

#include <clocale>
#include <cstdlib>
#include <locale>
#include <map>
#include <string>
#include <vector>

#include "cam/post/post.h"

namespace qchopper::test_krl {

// While it lives, numbers have a comma wherever a locale decides: in streams, and in the C library where a German or
// French locale is installed.
class CommaLocale {
 public:
    CommaLocale() : before_(std::locale::global(std::locale(std::locale::classic(), new Comma))) {
        for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) {
            if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
        }
    }
    ~CommaLocale() {
        std::locale::global(before_);
        std::setlocale(LC_NUMERIC, "C");
    }
    CommaLocale(const CommaLocale&) = delete;
    CommaLocale& operator=(const CommaLocale&) = delete;

 private:
    struct Comma : std::numpunct<char> {
        char do_thousands_sep() const override { return '.'; }
        char do_decimal_point() const override { return ','; }
        std::string do_grouping() const override { return "\3"; }
    };
    std::locale before_;
};

struct ScannedLine {
    std::string text;
    std::string word;                      // up to a space, a bracket or a brace
    std::map<std::string, double> values;  // "X" to 1.23, of all braces of the line
    std::vector<std::string> names;        // of the values, in their order
    bool is_rounded = false;
};

inline ScannedLine scan_line(const std::string& text) {
    ScannedLine line;
    line.text = text;
    line.word = text.substr(0, text.find_first_of(" ({"));
    line.is_rounded = text.ends_with(" C_DIS");
    std::size_t at = text.rfind("{M ") != std::string::npos ? text.size() : text.find('{');
    while (at < text.size()) {
        const std::size_t name = text.find_first_not_of("{, ", at);
        const std::size_t space = text.find(' ', name);
        if (name == std::string::npos || space == std::string::npos || text[name] == '}') break;
        char* end = nullptr;
        const double value = std::strtod(text.c_str() + space, &end);
        line.values[text.substr(name, space - name)] = value;
        line.names.push_back(text.substr(name, space - name));
        at = static_cast<std::size_t>(end - text.c_str());
        if (text[at] == '}') break;
    }
    return line;
}

inline std::vector<ScannedLine> scan(const std::string& text) {
    std::vector<ScannedLine> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = text.find("\r\n", at);
        lines.push_back(scan_line(text.substr(at, end - at)));
        at = end + 2;
    }
    return lines;
}

inline const std::string& text_of(const ProgramPart& part, const std::string& name) {
    for (const ProgramText& file : part.files) {
        if (file.name == name) return file.text;
    }
    static const std::string none;
    return none;
}

// A text of the part with the values in place of the names that its configuration module states.
inline std::string resolved(const ProgramPart& part, std::string text) {
    std::string data;
    for (const ProgramText& file : part.files) {
        if (file.name.ends_with("_cfg.dat")) data = file.text;
    }
    for (const ScannedLine& line : scan(data)) {
        if (line.word != "DECL") continue;
        const std::size_t begin = line.text.find(' ', 12) + 1;  // behind DECL GLOBAL FRAME or LOAD
        const std::size_t end = line.text.find(" = ");
        const std::string name = line.text.substr(begin, end - begin);
        for (const std::string behind : {"\r\n", ")"}) {
            for (const std::string before : {" = ", ","}) {
                const std::string old = before + name + behind;
                for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old)) {
                    text.replace(at, old.size(), before + line.text.substr(end + 3) + behind);
                }
            }
        }
    }
    return text;
}

}  // namespace qchopper::test_krl
