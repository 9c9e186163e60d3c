// Words are looked up in two tables, that of the choices and that of the faults. O(characters).

#include "sim/cell/script.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "base/error.h"

namespace qchopper {

std::span<const ActRow> all_choices() {
    static const std::vector<ActRow> all{
        {Act::consent, "consent", {"no", "yes"}},  // answers the question that is asked, or waits for the next one
        {Act::policy, "consent", {"auto", "ask", "never"}},  // from now on
        {Act::door, "door", {"closed", "open"}},
        {Act::e_stop, "estop", {"release", "press"}},
        {Act::panel, "panel", {"remote", "local"}},
        {Act::block, "block", {"unknown", "none", "fresh", "used", "moved"}},
        {Act::tool, "tool", {"ok", "broken"}},
        // The last three: on, with an empty store, an older one, an older one and its marks.
        {Act::power, "power", {"off", "on", "store-lost", "store-back", "all-back"}},
        {Act::clock, "clock", {"real", "virtual"}},  // a virtual one goes on by `wait` only
        {Act::wait_for, "wait for", {"question", "prepared", "running", "held", "finished", "aborted", "idle"}},
    };
    return all;
}

namespace {

[[noreturn]] void refuse(const std::string& name, std::size_t line, const std::string& why) {
    throw InputError(InputFault::config, name + ":" + std::to_string(line) + ": " + why,
                     Sentence::with_key("list_faults", {}, "docs/user/cell-sim.md lists the commands and the faults."));
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text.substr(0, text.find('#'))) {
        const bool is_space = c == ' ' || c == '\t' || c == '\r';
        if (!is_space) word += c;
        if (is_space && !word.empty()) words.push_back(std::exchange(word, {}));
    }
    if (!word.empty()) words.push_back(std::move(word));
    return words;
}

template <class Number>
std::optional<Number> number_from(const std::string& word) {
    Number number{};
    const auto end = std::from_chars(word.data(), word.data() + word.size(), number);
    if (end.ec != std::errc() || end.ptr != word.data() + word.size()) return std::nullopt;
    return number;
}

// What is left of a line, word by word.
class Words {
 public:
    Words(std::vector<std::string> words, const std::string& name, std::size_t line)
        : words_(std::move(words)), name_(name), line_(line) {}
    bool is_empty() const { return at_ == words_.size(); }
    bool takes(const std::string& word) {
        const bool is_next = !is_empty() && words_[at_] == word;
        at_ += is_next ? 1 : 0;
        return is_next;
    }
    std::string next(const char* what) {
        if (is_empty()) refuse(name_, line_, std::string("there is no ") + what);
        return words_[at_++];
    }
    // In bounds, both included.
    template <class Number>
    Number number(const char* what, Number least, Number most) {
        const std::string word = next(what);
        const std::optional<Number> value = number_from<Number>(word);
        if (!value || !(*value >= least && *value <= most)) {
            refuse(name_, line_,
                   "'" + word + "' is no " + what + " of " + std::to_string(least) + " to " + std::to_string(most));
        }
        return *value;
    }
    bool has_number() const { return !is_empty() && number_from<std::int64_t>(words_[at_]).has_value(); }
    void expect_end() const {
        if (!is_empty()) refuse(name_, line_, "'" + words_[at_] + "' is too much");
    }

 private:
    std::vector<std::string> words_;
    std::size_t at_ = 0;
    const std::string& name_;
    std::size_t line_;
};

ArmedFault fault_from(Words& words, const std::string& name, std::size_t line) {
    constexpr std::int64_t most = 1'000'000'000;
    const std::string word = words.next("name of a fault");
    const NamedFault* const row = fault_named(word);
    if (row == nullptr) refuse(name, line, "there is no fault '" + word + "'");
    ArmedFault fault{row->fault, row->usual};
    if (row->argument[0] != '\0' && words.has_number())
        fault.number = words.number<std::int64_t>("number", -most, most);
    if (words.takes("always")) fault.times = 0;
    if (words.takes("times")) fault.times = words.number<std::uint32_t>("number of times", 1, 1'000'000);
    if (words.takes("chance")) {
        fault.per_thousand = static_cast<std::uint16_t>(10 * words.number<unsigned>("chance in per cent", 0, 100));
    }
    return fault;
}

// The row of the words to come; "y" and "n" are short for an answer.
ScriptLine choice_from(Words& words, const std::string& first, const std::string& name, std::size_t line) {
    const bool is_yes = first == "y" || first == "yes";
    if (is_yes || first == "n" || first == "no") return {line, Act::consent, is_yes ? 1U : 0U, 0, {}};
    std::string known;
    for (const ActRow& row : all_choices()) {
        if (row.word != first) continue;
        for (std::size_t i = 0; i < row.choices.size(); ++i) {
            if (words.takes(row.choices[i])) return {line, row.act, i, 0, {}};
            known += (known.empty() ? "" : ", ") + std::string(row.choices[i]);
        }
    }
    if (known.empty()) refuse(name, line, "there is no command '" + first + "'");
    refuse(name, line, "'" + first + "' needs one of " + known);
}

ScriptLine line_from(Words& words, const std::string& name, std::size_t line) {
    const std::string first = words.next("command");
    if (first == "show") return {line, Act::show, 0, 0, {}};
    if (first == "quit") return {line, Act::quit, 0, 0, {}};
    if (first == "seed")
        return {line, Act::seed, 0, static_cast<double>(words.number<std::uint32_t>("seed", 0, UINT32_MAX)), {}};
    if (first == "wait" && words.takes("for")) return choice_from(words, "wait for", name, line);
    if (first == "wait") return {line, Act::wait, 0, words.number<double>("number of seconds", 0.0, 1e9), {}};
    if (first == "fault" && words.takes("clear")) return {line, Act::clear_faults, 0, 0, {}};
    if (first == "fault") return {line, Act::fault, 0, 0, fault_from(words, name, line)};
    return choice_from(words, first, name, line);
}

}  // namespace

std::optional<ScriptLine> parse_script_line(std::string_view text, std::size_t line, const std::string& name) {
    Words words(words_of(text), name, line);
    if (words.is_empty()) return std::nullopt;
    ScriptLine parsed = line_from(words, name, line);
    words.expect_end();
    return parsed;
}

std::vector<ScriptLine> parse_script(std::string_view text, const std::string& name) {
    std::vector<ScriptLine> lines;
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        if (auto parsed = parse_script_line(text.substr(0, end), line, name)) lines.push_back(*parsed);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

}  // namespace qchopper
