// Collects the figures of a bench and prints them as a Markdown table, each with its target.

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
    std::string target;          // empty: none
    std::optional<bool> is_met;  // nothing: no target, or not measured
};

class Figures {
 public:
    // Every figure is also written to stderr at once.
    void add(Figure figure);
    // A ratio that is met if it is at most, or at least, so much.
    void at_most(const std::string& mesh, const std::string& what, double ratio, double most);
    void at_least(const std::string& mesh, const std::string& what, double ratio, double least);
    // A value without a target.
    void record(const std::string& mesh, const std::string& what, const std::string& value);

    void print(std::ostream& out) const;

 private:
    std::vector<Figure> figures_;
};

// "43.1 ms", "1.52 s"
std::string time_text(double seconds);
// Three digits: "2.46", "118", "1.9 million"
std::string number_text(double value);

}  // namespace qchopper::bench
