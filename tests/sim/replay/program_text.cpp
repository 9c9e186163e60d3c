// Text in, text out. O(characters).

#include "tests/sim/replay/program_text.h"

#include <algorithm>
#include <cstdlib>

#include "base/text.h"

namespace qchopper::program_text {
namespace {

constexpr const char* module_ending = "_cfg";  // of the stem of a configuration module

bool is_data_of_module(const ProgramFile& file) {
    return lower(file.name).ends_with(std::string(module_ending) + ".dat");
}

// Whether a line states what the word is for: it begins with it, or a module states the frame or load.
bool states(const std::string& line, const std::string& word) {
    if (begins(line, word)) return true;
    if (!begins(line, "decl global ")) return false;
    const std::string name = lower(line.substr(0, line.find(" = ")));
    const auto has_part = [&](const char* part) {
        const std::size_t at = name.rfind(part);
        return at != std::string::npos && name.find('_', at + 1) == std::string::npos;
    };
    return (word == "$tool" && has_part("_t")) || (word == "$base" && has_part("_base")) ||
           (word == "$load" && has_part("_l"));
}

}  // namespace

Lines lines_of(const std::string& text) {
    Lines lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find("\r\n", at), text.size());
        lines.push_back(text.substr(at, end - at));
        at = end + 2;
    }
    return lines;
}

std::string text_of(const Lines& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\r\n";
    return text;
}

std::string lower(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

bool begins(const std::string& line, const std::string& word) {
    return lower(line).compare(0, word.size(), word) == 0;
}

bool is_lin(const std::string& line) {
    return begins(line, "lin ");
}

std::string stem_of(const ProgramFile& file) {
    return lower(file.name.substr(0, file.name.find('.')));
}

bool is_source(const ProgramFile& file) {
    const std::string name = lower(file.name);
    return name.ends_with(".src") || name.ends_with(".mod") || name.ends_with(".ngc");
}

// The main program is the one that initialises, is called so, or ends.
static bool is_main(const ProgramFile& file) {
    const std::string text = lower(file.text);
    return text.find("#initmov") != std::string::npos || text.find("proc main()") != std::string::npos ||
           text.ends_with("m2\r\n");
}

bool is_call(const std::string& line, const std::string& stem) {
    return begins(line, stem + "(") || begins(line, stem + "_run;") || begins(line, "%\"" + stem + "_run\"") ||
           begins(line, "o<" + stem + "> call");
}

std::string called_stem(const ProgramFiles& files, const std::string& line) {
    for (const ProgramFile& file : files) {
        if (is_source(file) && is_call(line, stem_of(file))) return stem_of(file);
    }
    return {};
}

std::size_t next_chunk(const ProgramFiles& files, std::size_t from) {
    const auto is_chunk = [](const ProgramFile& file) {
        return is_source(file) && !is_main(file) && !stem_of(file).ends_with(module_ending);
    };
    while (from < files.size() && !is_chunk(files[from])) ++from;
    return from;
}

std::pair<std::size_t, std::size_t> number_at(const std::string& line, const std::string& component) {
    for (const char before : {'{', ','}) {
        const std::size_t at = line.find(before + component + " ");
        if (at == std::string::npos) continue;
        const std::size_t begin = at + component.size() + 2;
        return {begin, line.find_first_of(",}", begin)};
    }
    return {std::string::npos, std::string::npos};
}

bool change_number(std::string& line, const std::string& component, const std::function<double(double)>& f) {
    const auto [begin, end] = number_at(line, component);
    if (begin == std::string::npos || end == std::string::npos) return false;
    const std::string before = line.substr(begin, end - begin);
    const std::size_t point = before.find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(before.size() - point - 1);
    const std::string after = fixed(f(std::strtod(before.c_str(), nullptr)), decimals);
    line.replace(begin, end - begin, after);
    return after != before;
}

Mutation everywhere(const std::string& name, const Change& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                ProgramFiles changed = files;
                bool is_changed = false;
                for (ProgramFile& file : changed) {
                    if (!is_source(file) && !is_data_of_module(file)) continue;
                    Lines lines = lines_of(file.text);
                    if (change(lines)) is_changed = true;
                    file.text = text_of(lines);
                }
                if (!is_changed) return std::nullopt;
                return changed;
            }};
}

Mutation in_one_chunk(const std::string& name, const Change& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                for (std::size_t i = next_chunk(files); i < files.size(); i = next_chunk(files, i + 1)) {
                    ProgramFiles changed = files;
                    Lines lines = lines_of(files[i].text);
                    if (!change(lines)) continue;
                    changed[i].text = text_of(lines);
                    return changed;
                }
                return std::nullopt;
            }};
}

Change each(const std::string& word, const std::function<bool(std::string&)>& change) {
    return [word, change](Lines& lines) {
        bool is_changed = false;
        for (std::string& line : lines) {
            if (states(line, word) && change(line)) is_changed = true;
        }
        return is_changed;
    };
}

Change each_component(const std::string& word, const std::vector<std::string>& components,
                      const std::function<double(double)>& f) {
    return each(word, [components, f](std::string& line) {
        bool is_changed = false;
        for (const std::string& component : components) is_changed |= change_number(line, component, f);
        return is_changed;
    });
}

Change each_value(const std::string& word, const std::function<double(double)>& f) {
    return each(word, [f](std::string& line) {
        const std::size_t at = line.find('=');
        if (at == std::string::npos) return false;
        const double value = std::strtod(line.c_str() + at + 1, nullptr);
        line = line.substr(0, at) + "= " + fixed(f(value), 6);
        return true;
    });
}

Change without(const std::string& word, const std::string& ending) {
    return [word, ending](Lines& lines) {
        const std::size_t before = lines.size();
        std::erase_if(lines, [&](const std::string& line) {
            return begins(line, word) && (ending.empty() || lower(line).ends_with(ending));
        });
        return lines.size() != before;
    };
}

bool replace_first(std::string& text, std::size_t from, const std::string& what, const std::string& by) {
    const std::size_t at = text.find(what, from);
    if (at == std::string::npos) return false;
    text.replace(at, what.size(), by);
    return true;
}

std::vector<std::size_t> lin_places(const Lines& lines) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (is_lin(lines[i])) places.push_back(i);
    }
    return places;
}

double component_of(const std::string& line, const std::string& component) {
    const auto [begin, end] = number_at(line, component);
    return begin == std::string::npos ? 0 : std::strtod(line.c_str() + begin, nullptr);
}

static std::size_t find_main(const ProgramFiles& files) {
    std::size_t at = 0;
    while (at < files.size() && !(is_source(files[at]) && is_main(files[at]))) ++at;
    return at;
}

Mutation in_main(const std::string& name,
                 const std::function<bool(ProgramFiles&, Lines&, std::vector<std::size_t>)>& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                ProgramFiles changed = files;
                const std::size_t main = find_main(files);
                if (main == files.size()) return std::nullopt;
                Lines lines = lines_of(files[main].text);
                std::vector<std::size_t> calls;
                for (std::size_t i = 0; i < lines.size(); ++i) {
                    if (!called_stem(files, lines[i]).empty()) calls.push_back(i);
                }
                if (!change(changed, lines, calls)) return std::nullopt;
                const auto at = std::find_if(changed.begin(), changed.end(),
                                             [&](const ProgramFile& f) { return f.name == files[main].name; });
                at->text = text_of(lines);
                return changed;
            }};
}

Mutation of_files(const std::string& name, const std::function<std::optional<ProgramFiles>(const ProgramFiles&)>& f) {
    return {name, f};
}

Mutation of_text(const std::string& name, const std::function<bool(std::string&)>& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                ProgramFiles changed = files;
                const std::size_t at = next_chunk(files);
                if (at == files.size() || !change(changed[at].text)) return std::nullopt;
                return changed;
            }};
}

Change lose(const std::string& word, bool is_last) {
    return [word, is_last](Lines& lines) {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (begins(lines[i], word)) places.push_back(i);
        }
        if (places.empty()) return false;
        lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(is_last ? places.back() : places.front()));
        return true;
    };
}

Mutation in_module(const std::string& name, const Change& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                ProgramFiles changed = files;
                bool is_changed = false;
                for (ProgramFile& file : changed) {
                    if (!stem_of(file).ends_with(module_ending)) continue;
                    Lines lines = lines_of(file.text);
                    if (change(lines)) is_changed = true;
                    file.text = text_of(lines);
                }
                return is_changed ? std::optional(changed) : std::nullopt;
            }};
}

Change insert(const std::string& line) {
    return [line](Lines& lines) {
        const std::vector<std::size_t> places = lin_places(lines);
        if (places.size() < 6) return false;
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(places[places.size() / 2]), line);
        return true;
    };
}

Mutation in_last_chunk(const std::string& name, const Change& change) {
    return {name, [change](const ProgramFiles& files) -> std::optional<ProgramFiles> {
                std::size_t last = files.size();
                for (std::size_t i = next_chunk(files); i < files.size(); i = next_chunk(files, i + 1)) last = i;
                if (last == files.size()) return std::nullopt;
                ProgramFiles changed = files;
                Lines lines = lines_of(files[last].text);
                if (!change(lines)) return std::nullopt;
                changed[last].text = text_of(lines);
                return changed;
            }};
}

Mutation in_main_lines(const std::string& name, const Change& change) {
    return in_main(name, [change](ProgramFiles&, Lines& lines, const auto&) { return change(lines); });
}

}  // namespace qchopper::program_text
