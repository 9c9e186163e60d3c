// The program of a piece and what its proof found, in the reports of the commands that make programs.

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "app/engine/work_project.h"
#include "app/jobs/piece_jobs.h"
#include "app/report/document.h"

namespace qchopper {

// "3 h 20 min, 4 holes, verified", "-" without a program.
std::string program_word(const PieceReport& piece);

// "piece B: programs proven, 3 h 20 min", "piece C: no programs, the saw alone makes it".
std::string worked_line(const WorkedPiece& piece);

// "piece B: at work on node1, process 4711, at moves carved; sign of life 4 s ago", "piece C: 2 attempts failed, the
// last on node2, process 4712, at moves carved (out of memory), 800 MB of memory at most".
std::string unmade_line(const UnmadePiece& piece);

// "piece C: no arm posture reaches it: ...; it has to be cut again, or milled from fewer orientations".
std::string refused_line(const WorkedPiece& piece);

// A line of JSON for each, and at its end a line feed.
std::string json_lines(const std::vector<UnmadePiece>& pieces);

// The end of `work`: how many of the shard's pieces have programs, and what comes next.
std::vector<std::string> lines(const WorkAnswer& answer);
// The document qchopper-work-1 (tests/app/cli/work_test.cpp).
Document document(const WorkAnswer& answer);

// What speaks against the program, and the notes of its verdict: one sentence each, which names the piece.
std::vector<std::string> program_warnings(const PieceReport& piece, const std::filesystem::path& folder);

// The value of each figure by its key.
nlohmann::ordered_json figures_json(const ProofResult& proof);

// Parts, proof, time and verdicts, or why there is none.
nlohmann::ordered_json program_json(const PieceReport& piece);

}  // namespace qchopper
