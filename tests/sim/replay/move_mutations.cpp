// Lines of moves by their places in the file. O(characters) for each mutation.

#include "tests/sim/replay/move_mutations.h"

#include <cmath>
#include <cstdlib>

#include "base/text.h"

namespace qchopper {

using namespace program_text;

namespace {

class Moves {
 public:
    Moves(const MoveText& text, Lines& lines) : text_(&text), lines_(&lines) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (begins(lines[i], text.word)) places_.push_back(i);
        }
    }
    std::size_t size() const { return places_.size(); }
    std::string& line(std::size_t k) { return (*lines_)[places_[k]]; }
    double at(std::size_t k, int component) {
        return std::strtod(line(k).c_str() + text_->span(line(k), component).first, nullptr);
    }
    bool change(std::size_t k, int component, const std::function<double(double)>& f) {
        return change_span(line(k), text_->span(line(k), component), f);
    }
    void erase(std::size_t k) { lines_->erase(lines_->begin() + static_cast<std::ptrdiff_t>(places_[k])); }

 private:
    const MoveText* text_;
    Lines* lines_;
    std::vector<std::size_t> places_;
};

Change each_point(const MoveText& text, const std::vector<int>& components, const std::function<double(double)>& f) {
    return [=](Lines& lines) {
        Moves moves(text, lines);
        bool is_changed = false;
        for (std::size_t k = 0; k < moves.size(); ++k) {
            for (const int component : components) is_changed |= moves.change(k, component, f);
        }
        return is_changed;
    };
}

Change one_point(const MoveText& text, int component, double by) {
    return [=](Lines& lines) {
        Moves moves(text, lines);
        return moves.size() > 3 && moves.change(moves.size() / 2, component, [by](double v) { return v + by; });
    };
}

// The first move that leads up and the one after it that leads aside stay at the depth before them; or all such moves.
Change lose_retracts(const MoveText& text, bool are_all) {
    return [=](Lines& lines) {
        Moves moves(text, lines);
        bool is_changed = false;
        for (std::size_t k = 1; k + 1 < moves.size(); ++k) {
            const double z = moves.at(k - 1, 2);
            const double aside = std::hypot(moves.at(k + 1, 0) - moves.at(k, 0), moves.at(k + 1, 1) - moves.at(k, 1));
            if (moves.at(k, 2) - z < 10 || aside < 1) continue;
            for (const std::size_t j : {k, k + 1}) is_changed |= moves.change(j, 2, [z](double) { return z; });
            if (!are_all) break;
        }
        return is_changed;
    };
}

Change of_moves(const MoveText& text, const std::function<bool(Moves&)>& f) {
    return [=](Lines& lines) {
        Moves moves(text, lines);
        return f(moves);
    };
}

bool exchange_x_and_y(Moves& moves) {
    for (std::size_t k = 0; k < moves.size(); ++k) {
        const double x = moves.at(k, 0);
        const double y = moves.at(k, 1);
        moves.change(k, 0, [y](double) { return y; });
        moves.change(k, 1, [x](double) { return x; });
    }
    return moves.size() > 0;
}

bool lower_every_tenth(Moves& moves) {
    bool is_changed = false;
    for (std::size_t k = 9; k < moves.size(); k += 10) is_changed |= moves.change(k, 2, [](double z) { return z - 5; });
    return is_changed;
}

bool reverse(Moves& moves) {
    if (moves.size() < 6) return false;
    for (std::size_t a = 1, b = moves.size() - 1; a < b; ++a, --b) std::swap(moves.line(a), moves.line(b));
    return true;
}

bool lose_every_second(Moves& moves) {
    if (moves.size() < 8) return false;
    for (std::size_t k = moves.size() - 2; k >= 2; k -= 2) moves.erase(k);
    return true;
}

bool lose_last(Moves& moves) {
    if (moves.size() < 3) return false;
    moves.erase(moves.size() - 1);
    return true;
}

}  // namespace

bool change_span(std::string& line, std::pair<std::size_t, std::size_t> span, const std::function<double(double)>& f) {
    const auto [begin, end] = span;
    if (begin == std::string::npos || end == std::string::npos || end <= begin) return false;
    const std::string before = line.substr(begin, end - begin);
    const std::size_t point = before.find('.');
    const int decimals = point == std::string::npos ? 0 : static_cast<int>(before.size() - point - 1);
    const std::string after = fixed(f(std::strtod(before.c_str(), nullptr)), decimals);
    line.replace(begin, end - begin, after);
    return after != before;
}

Change each_number(const std::string& word, const std::string& before, const std::function<double(double)>& f) {
    return each(word, [before, f](std::string& line) {
        const std::size_t at = line.find(before);
        if (at == std::string::npos) return false;
        const std::size_t begin = at + before.size();
        return change_span(line, {begin, std::min(line.find_first_not_of("-.0123456789", begin), line.size())}, f);
    });
}

Change insert_among(const std::string& word, const std::string& line) {
    return [word, line](Lines& lines) {
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (begins(lines[i], word)) places.push_back(i);
        }
        if (places.empty()) return false;
        lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(places[places.size() / 2]), line);
        return true;
    };
}

Mutation replaced(const std::string& name, const std::string& what, const std::string& by) {
    return everywhere(name, [what, by](Lines& lines) {
        bool is_changed = false;
        for (std::string& line : lines) is_changed |= replace_first(line, 0, what, by);
        return is_changed;
    });
}

std::vector<Mutation> move_mutations(const MoveText& text) {
    const auto times = [](double f) { return [f](double v) { return f * v; }; };
    const auto plus = [](double d) { return [d](double v) { return v + d; }; };
    const std::vector<int> xyz{0, 1, 2};
    return {everywhere("inches_for_mm", each_point(text, xyz, times(1 / 25.4))),
            everywhere("metres_for_mm", each_point(text, xyz, times(0.001))),
            everywhere("scaled_by_3_percent", each_point(text, {0, 1}, times(1.03))),
            everywhere("mirrored_x", each_point(text, {0}, times(-1))),
            everywhere("mirrored_y", each_point(text, {1}, times(-1))),
            everywhere("mirrored_z", each_point(text, {2}, times(-1))),
            everywhere("sign_lost", each_point(text, xyz, [](double v) { return std::abs(v); })),
            everywhere("x_and_y_exchanged", of_moves(text, exchange_x_and_y)),
            everywhere("all_2_mm_deeper", each_point(text, {2}, plus(-2))),
            everywhere("all_2_mm_higher", each_point(text, {2}, plus(2))),
            everywhere("all_2_mm_aside", each_point(text, {0}, plus(2))),
            in_one_chunk("point_lowered", one_point(text, 2, -5)),
            everywhere("every_tenth_point_lowered", of_moves(text, lower_every_tenth)),
            in_one_chunk("point_moved_x", one_point(text, 0, 15)),
            in_one_chunk("point_moved_y", one_point(text, 1, 15)),
            in_one_chunk("retract_lost", lose_retracts(text, false)),
            everywhere("all_retracts_lost", lose_retracts(text, true)),
            in_one_chunk("last_retract_lost", of_moves(text, lose_last)),
            in_one_chunk("moves_reversed", of_moves(text, reverse)),
            in_one_chunk("every_second_move_lost", of_moves(text, lose_every_second))};
}

}  // namespace qchopper
