// Formats numbers with three digits and prints the table.

#include "bench/figures.h"

#include <cstdio>
#include <iostream>
#include <ostream>

namespace qchopper::bench {

std::string number_text(double value) {
    if (value == 0) return "0";
    char text[64];
    const int decimals = value >= 99.95 ? 0 : value >= 9.995 ? 1 : value >= 0.9995 ? 2 : 4;
    if (value >= 1e6)
        std::snprintf(text, sizeof text, "%.2f million", value / 1e6);
    else if (value < 1e-3)
        std::snprintf(text, sizeof text, "%.2g", value);
    else
        std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string time_text(double seconds) {
    if (seconds < 1e-3) return number_text(seconds * 1e6) + " us";
    return seconds < 1 ? number_text(seconds * 1e3) + " ms" : number_text(seconds) + " s";
}

void Figures::add(Figure figure) {
    std::cerr << figure.mesh << ": " << figure.what << ": " << figure.value
              << (figure.is_met ? *figure.is_met ? "  (met)" : "  (NOT MET: " + figure.target + ")" : "") << std::endl;
    figures_.push_back(std::move(figure));
}

void Figures::at_most(const std::string& mesh, const std::string& what, double ratio, double most) {
    add({mesh, what, number_text(ratio), "at most " + number_text(most), ratio <= most});
}

void Figures::at_least(const std::string& mesh, const std::string& what, double ratio, double least) {
    add({mesh, what, number_text(ratio), "at least " + number_text(least), ratio >= least});
}

void Figures::record(const std::string& mesh, const std::string& what, const std::string& value) {
    add({mesh, what, value, "", std::nullopt});
}

void Figures::print(std::ostream& out) const {
    out << "| mesh | what | figure | target | |\n|---|---|---|---|---|\n";
    for (const Figure& f : figures_) {
        out << "| " << f.mesh << " | " << f.what << " | " << f.value << " | " << f.target << " | "
            << (f.is_met ? *f.is_met ? "met" : "**not met**" : "") << " |\n";
    }
}

}  // namespace qchopper::bench
