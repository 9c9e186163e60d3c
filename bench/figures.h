// What a bench prints: one row per figure, with its target beside it, as a Markdown table.

#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace qchopper::bench {

struct Figure {
    std::string mesh;
    std::string what;
    std::string value;
    std::string target;          // empty: told for the record
    std::optional<bool> is_met;  // nothing: no target, or not measured
};

class Figures {
 public:
    void add(Figure figure);
    // A ratio that may be at most, or must be at least, so much.
    void at_most(const std::string& mesh, const std::string& what, double ratio, double most);
    void at_least(const std::string& mesh, const std::string& what, double ratio, double least);
    void tell(const std::string& mesh, const std::string& what, const std::string& value);

    void print(std::ostream& out) const;

 private:
    std::vector<Figure> figures_;
};

// "43.1 ms", "1.52 s"
std::string time_text(double seconds);
// Three digits: "2.46", "118", "1.9 million"
std::string number_text(double value);

}  // namespace qchopper::bench
