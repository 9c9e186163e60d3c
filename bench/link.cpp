// Wall times of the link to a cell: journal, requests, transfer, hand-off, beside a commit of SQLite to the same disk
// and a round trip of TCP over loopback, in one run; then its latency during attacks (link_attacks.h).
// bench_link [FOLDER], a folder on the disk to be measured; bench_link --attacks SECONDS, the attacks alone, each so
// long.

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sqlite3.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "app/dispatch/dispatch_jobs.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/link_attacks.h"
#include "devices/hand_off/first_contact.h"
#include "devices/wire/codec.h"
#include "devices/wire/modbus_tcp.h"
#include "sim/cell/cell_sim.h"
#include "tests/schedules/schedule.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;

// Of five blocks of repetitions the mean of the best, in seconds.
template <class Work>
double seconds_each(int repetitions, const Work& work) {
    return best_of(5, wall_s,
                   [&] {
                       for (int i = 0; i < repetitions; ++i) work();
                       return 0;
                   }) /
           repetitions;
}

void check(bool is_good, const char* what) {
    if (!is_good) throw std::runtime_error(what);
}

// One row of the size of a journal row in each commit, WAL, synchronous FULL.
double sqlite_commit_s(const fs::path& folder) {
    sqlite3* database = nullptr;
    check(sqlite3_open((folder / "yardstick.sqlite").c_str(), &database) == SQLITE_OK, "SQLite does not open");
    const auto execute = [&](const std::string& statement) {
        check(sqlite3_exec(database, statement.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK, "SQLite");
    };
    execute("PRAGMA journal_mode=WAL");
    execute("PRAGMA synchronous=FULL");
    execute("CREATE TABLE row (n INTEGER PRIMARY KEY, text TEXT)");
    const std::string insert = "INSERT INTO row (text) VALUES ('" + std::string(250, 'x') + "')";
    const double seconds = seconds_each(50, [&] { execute(insert); });
    sqlite3_close(database);
    return seconds;
}

double append_s(const fs::path& folder) {
    Journal journal(folder / "append", {any_cell_id, true, "bench"});
    JournalEvent event;
    event.kind = JournalKind::command;
    event.command = CellCommand::query;
    return seconds_each(50, [&] { journal.append(event); });
}

// 12 bytes there and back, as a request to read and its shortest answer.
double tcp_round_trip_s() {
    const int listener = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* any = reinterpret_cast<sockaddr*>(&address);
    check(bind(listener, any, size) == 0 && listen(listener, 1) == 0, "no port");
    getsockname(listener, any, &size);
    const int client = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    check(connect(client, any, size) == 0, "no connection");
    const int server = accept(listener, nullptr, nullptr);
    const int on = 1;
    for (const int fd : {client, server}) setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    const std::jthread echo([server] {
        std::array<char, 12> bytes{};
        while (recv(server, bytes.data(), bytes.size(), MSG_WAITALL) == 12) send(server, bytes.data(), 12, 0);
    });
    std::array<char, 12> bytes{};
    const double seconds = seconds_each(2000, [&] {
        send(client, bytes.data(), bytes.size(), 0);
        recv(client, bytes.data(), bytes.size(), MSG_WAITALL);
    });
    close(client);
    shutdown(server, SHUT_RDWR);
    close(listener);
    return seconds;
}

struct Link {
    explicit Link(const fs::path& where) : folder(where) {
        fs::create_directories(folder / "drop");
        CellSimOptions options;
        options.drop_folder = folder / "drop";
        options.store_folder = folder / "store";
        options.limits.speed = 1e6;
        options.peer_rate = 1e6;  // what is measured is not how long a stranger has to wait
        cell = std::make_unique<CellSim>(options);
        cell->start();
        bus = rig::connect(*cell);
    }
    // Seconds from the order of the jobs to the end of the last, with the journal on the disk.
    double dispatch_s(const std::vector<rig::Job>& jobs, DispatchOptions options) {
        Journal journal(folder / ("journal-" + std::to_string(++journals)), {any_cell_id, true, "bench"});
        std::vector<PieceJob> pieces;
        for (const rig::Job& job : jobs) {
            PieceJob piece;
            piece.piece = std::to_string(pieces.size());
            piece.file = job.file;
            piece.ticket = job.ticket;
            pieces.push_back(std::move(piece));
        }
        options.again = true;
        const double began = wall_s();
        const std::vector<DispatchedJob> handed = dispatch_jobs(pieces, *bus, options, journal, {});
        const double took = wall_s() - began;
        check(handed.size() == jobs.size() && handed.back().outcome.is_complete(), "a job did not end complete");
        return took;
    }
    fs::path folder;
    std::unique_ptr<CellSim> cell;
    std::unique_ptr<ModbusTcpBus> bus;
    int journals = 0;
};

DispatchOptions by_folder(const fs::path& drop) {
    DispatchOptions options;
    options.drop_folder = drop;
    return options;
}

// From the first request to the row STARTED, with the times that an operator has.
double start_s(Link& link) {
    DispatchOptions options = by_folder(link.folder / "drop");
    const double began = wall_s();
    double started = 0;
    options.journal = [&](const JournalEvent& event) {
        if (event.kind == JournalKind::started) started = wall_s() - began;
    };
    link.dispatch_s({rig::make_job(300'000, 1)}, options);
    return started;
}

void measure_requests(Link& link, double round_trip_s, Figures& figures) {
    const double status_s =
        seconds_each(500, [&] { check(read_status_block(*link.bus).status.has_value(), "STATUS"); });
    Command query;
    query.command = CellCommand::query;
    query.owner = 1;
    query.job_id = {1};
    const double query_s = seconds_each(200, [&] {
        ++query.seq;
        check(link.bus->write_holding(command_block.base, encode(query)).is_ok(), "QUERY");
        check(read_result_block(*link.bus).result.has_value(), "RESULT");
    });
    figures.record("loopback", "TCP round trip of 12 bytes", time_text(round_trip_s));
    figures.record("loopback", "one read of STATUS", time_text(status_s));
    figures.at_most("loopback", "one read of STATUS / round trip", status_s / round_trip_s, 10);
    figures.record("loopback", "QUERY and its RESULT", time_text(query_s));
    figures.at_most("loopback", "QUERY and its RESULT / round trip", query_s / round_trip_s, 20);
}

void measure_transfer(Link& link, double round_trip_s, Figures& figures) {
    constexpr std::size_t bytes = 4'000'000;
    const auto sent_s = [&](std::size_t size) {
        return best_of(2, wall_s, [&] { return link.dispatch_s({rig::make_job(size, 1)}, {}); });
    };
    const double seconds = sent_s(bytes) - sent_s(1000);
    figures.record("loopback", "transfer by chunks", number_text(1e-6 * bytes / seconds) + " MB/s");
    const double bare = libmodbus_bytes_per_s();
    figures.record("loopback", "a loop of libmodbus, FC16 of 232 bytes", number_text(1e-6 * bare) + " MB/s");
    figures.at_least("loopback", "transfer by chunks / loop of libmodbus", bytes / seconds / bare, 0.5);
    const double per_chunk = seconds / (static_cast<double>(bytes) / 232);
    figures.at_most("loopback", "one chunk / round trip", per_chunk / round_trip_s, 20);
}

void measure_jobs(Link& link, double commit_s, Figures& figures) {
    const DispatchOptions options = by_folder(link.folder / "drop");
    std::vector<rig::Job> jobs;
    for (std::size_t i = 0; i < 20; ++i) jobs.push_back(rig::make_job(300'000 + i, 1));
    figures.record("300 kB", "hand-off to STARTED", time_text(start_s(link)));
    const double one = best_of(3, wall_s, [&] { return link.dispatch_s({jobs[0]}, options); });
    const double twenty = link.dispatch_s(jobs, options);
    figures.record("300 kB", "dispatch of 1 job", time_text(one));
    figures.record("300 kB", "dispatch of 20 jobs", time_text(twenty));
    figures.at_most("300 kB", "20 jobs / 20 times 1 job", twenty / (20 * one), 1.2);
    figures.record("300 kB", "1 job / SQLite commit", number_text(one / commit_s));
}

void measure_schedules(Figures& figures) {
    constexpr int count = 100;
    const double began = wall_s();
    for (std::uint64_t seed = 0; seed < count; ++seed) check(schedules::run_schedule(seed).is_right(), "a schedule");
    const double per_second = count / (wall_s() - began);
    figures.at_least("virtual clock", "schedules of faults per second", per_second, 2000.0 / 120);
}

constexpr double attack_s = 3;

int measure_attacks_alone(double seconds) {
    Figures figures;
    measure_attacks(seconds, figures);
    figures.print(std::cout);
    return 0;
}

int measure(const fs::path& folder) {
    fs::create_directories(folder);
    Figures figures;
    const double commit_s = sqlite_commit_s(folder);
    figures.record("disk", "SQLite commit of one row, synchronous FULL", time_text(commit_s));
    const double append = append_s(folder);
    figures.record("disk", "row of the journal", time_text(append));
    figures.at_most("disk", "row of the journal / SQLite commit", append / commit_s, 2);
    const double round_trip_s = tcp_round_trip_s();
    Link link(folder / "link");
    measure_requests(link, round_trip_s, figures);
    measure_transfer(link, round_trip_s, figures);
    measure_jobs(link, commit_s, figures);
    measure_schedules(figures);
    measure_attacks(attack_s, figures);
    figures.print(std::cout);
    return 0;
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    try {
        if (argc == 3 && std::string(argv[1]) == "--attacks") {
            return qchopper::bench::measure_attacks_alone(std::stod(argv[2]));
        }
        const qchopper::rig::Folder folder;
        return qchopper::bench::measure(argc > 1 ? std::filesystem::path(argv[1]) / "bench_link" : folder.path);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
