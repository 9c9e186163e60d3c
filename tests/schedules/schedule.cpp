// A kill is an exception thrown at a named point of the dispatcher: unlike SIGKILL (tests/crash) it runs destructors,
// which send nothing. O(calls of the bus).

#include "tests/schedules/schedule.h"

#include <stdlib.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>

#include "app/dispatch/dispatch_jobs.h"
#include "base/error.h"
#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/journal_history.h"
#include "devices/hand_off/seen_store.h"
#include "devices/journal/journal.h"
#include "sim/cell/random.h"
#include "tests/schedules/virtual_link.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper::schedules {
namespace {

namespace fs = std::filesystem;

constexpr double faults_end_s = 150;
constexpr double hang_s = 1500;         // of virtual time: the end of a schedule
constexpr double longest_turn_s = 700;  // of one dispatcher: consent takes at most 600
constexpr double slices_s = 0.05;       // in which a dispatcher looks for the request to stop

struct Killed {};

class StateFolder {
 public:
    StateFolder() {
        std::string name = (fs::exists("/dev/shm") ? "/dev/shm" : "/tmp") + std::string("/qchopper-schedule-XXXXXX");
        if (::mkdtemp(name.data()) != nullptr) path = name;
        fs::create_directories(path / "drop");
    }
    ~StateFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    StateFolder(const StateFolder&) = delete;
    StateFolder& operator=(const StateFolder&) = delete;
    fs::path path;
};

// What the seed has drawn.
struct Plan {
    int pcs = 1;
    int jobs_each = 1;
    bool same_file = false;  // both PCs are ordered to carve the same files
    bool chunks = false;
    std::optional<Ed25519PrivateKey> signing_key;  // with it the cell requires signatures
    int link_per_thousand = 0;
    int kills = 0;  // of each PC
    int power_cuts = 0;
    int stores_lost = 0;  // of these
    bool takes_over = false;
    int cancels = 0;  // of each PC
};

Plan draw_plan(World& world) {
    Plan plan;
    plan.pcs = world.happens(400) ? 2 : 1;
    plan.jobs_each = world.happens(300) ? 2 : 1;
    plan.chunks = world.happens(500);
    constexpr int odds[] = {0, 5, 15, 40, 100};
    plan.link_per_thousand = odds[world.random() % 5];
    plan.kills = static_cast<int>(world.random() % 4);
    plan.power_cuts = static_cast<int>(world.random() % 4);
    plan.stores_lost = plan.power_cuts > 0 && world.happens(350) ? 1 : 0;
    plan.takes_over = world.happens(400);
    plan.cancels = world.happens(200) ? 1 : 0;
    plan.same_file = plan.stores_lost == 0 && world.happens(300);
    return plan;
}

// The same in all schedules, so that a seed is one course of events.
Ed25519PrivateKey fixed_key() {
    constexpr std::array<std::uint8_t, 32> secret{1, 2, 3};
    return Ed25519PrivateKey(secret);
}

PieceJob make_piece(int number) {
    rig::Job job = rig::make_job(200 + 40 * static_cast<std::size_t>(number), 30);
    job.ticket.about.piece_no = static_cast<std::uint16_t>(1 + number);
    job.ticket.file_name = "piece-" + std::to_string(number) + ".qjob";
    PieceJob piece;
    piece.piece = "P" + std::to_string(number);
    piece.file = job.file;
    piece.ticket = job.ticket;
    return piece;
}

// The journal of a PC as it was after one of its events, put back between two of its dispatchers: its last rows are
// lost. Draws from numbers of its own, so that the other faults of a seed stay what they are without it.
class OldJournal {
 public:
    OldJournal(fs::path folder, std::uint64_t seed, bool is_allowed) : folder_(std::move(folder)), random_(seed) {
        constexpr int max_events = 60;
        const bool happens = next_random(random_) % 2 == 0;
        if (is_allowed && happens) events_left_ = 1 + static_cast<int>(next_random(random_) % max_events);
    }

    void after_event() {
        if (events_left_ == 0 || --events_left_ > 0) return;
        fs::create_directories(copy());
        for (const char* name : files) {
            std::error_code is_missing;
            fs::copy_file(folder_ / name, copy() / name, is_missing);
        }
        has_copy_ = true;
    }

    // True if the copy is back. Precondition: the journal is not open.
    bool put_back() {
        if (!has_copy_ || next_random(random_) % 2 == 0) return false;
        has_copy_ = false;
        for (const char* name : files) {
            std::error_code is_missing;
            fs::remove(folder_ / name, is_missing);
            fs::copy_file(copy() / name, folder_ / name, is_missing);
        }
        fs::remove(folder_ / "journal.sqlite-shm");
        return true;
    }

 private:
    static constexpr const char* files[] = {"journal.sqlite", "journal.sqlite-wal", "lock"};  // with the number of rows
    fs::path copy() const { return folder_.string() + "-copy"; }

    fs::path folder_;
    std::uint64_t random_;
    int events_left_ = 0;  // until the copy is taken; 0: none is
    bool has_copy_ = false;
};

class Pc {
 public:
    // `seed` of what is drawn beside the numbers of the world.
    Pc(World& world, const Plan& plan, int number, const fs::path& folder, std::uint64_t seed, ScheduleEnd& end)
        : world_(world),
          plan_(plan),
          number_(number),
          folder_(folder),
          // A cell and a journal that both lost their memory of a job leave no trace of it.
          old_journal_(folder, seed, plan.stores_lost == 0),
          end_(end),
          kills_left_(plan.kills) {
        for (int i = 0; i < plan.jobs_each; ++i) {
            jobs_.push_back(make_piece(plan.same_file ? i : number * plan.jobs_each + i));
        }
        for (int i = 0; i < plan.cancels; ++i) {
            world.at(static_cast<double>(world.random() % 40000) / 1000, [this] { cancel(); });
        }
    }

    const std::vector<PieceJob>& jobs() const { return jobs_; }
    const std::vector<JobOutcome>& reports() const { return reports_; }
    bool has_said_unknown(const PieceJob& job) const { return unknown_.contains(job.ticket.file_name); }

    void run() {
        for (open_ = jobs_; !open_.empty();) {
            if (world_.now_s() > hang_s) {
                say("HANG");
                ++end_.hangs;
                return;
            }
            one_turn();
            world_.sleep(0.2 + static_cast<double>(world_.random() % 8000) / 1000);
        }
    }

 private:
    void say(const std::string& line) { world_.say("PC " + std::to_string(number_) + ": " + line); }

    void cancel() {
        cancelled_ = true;
        cancelled_s_ = world_.now_s();
        say("the operator asks to stop");
    }

    // One process: it ends by itself, with an error, or by a kill.
    void one_turn() {
        const double began_s = world_.now_s();
        kill_at_ = kills_left_ > 0 && began_s < faults_end_s ? 1 + static_cast<int>(world_.random() % 130) : 0;
        cancelled_s_ = -1;
        cancelled_ = false;
        if (began_s < faults_end_s && old_journal_.put_back()) {
            say("the journal lost its last rows");
            ++end_.journals_set_back;
        }
        try {
            dispatch();
        } catch (const Killed&) {
            --kills_left_;
            ++end_.kills;
            return;
        } catch (const std::exception& error) {
            say(std::string("error: ") + error.what());
        }
        const double now_s = world_.now_s();
        const bool is_late = cancelled_ && now_s - cancelled_s_ > HandOffTimings{}.leave_s + slices_s;
        if (is_late || now_s - began_s > longest_turn_s) {
            say("HANG: the dispatcher did not end in time");
            ++end_.hangs;
        }
    }

    void dispatch() {
        Journal journal(folder_, {any_cell_id, true, "schedule"});
        VirtualLink link(world_);
        ProjectContext context;
        context.cancelled = &cancelled_;
        context.on_message = [this](const std::string& line) { say(line); };
        const std::vector<DispatchedJob> handed = dispatch_jobs(open_, link, options(), journal, context);
        bool store_is_lost = false;
        for (const DispatchedJob& one : handed) {
            judge(one.outcome);
            store_is_lost = store_is_lost || one.outcome.store_is_lost ||
                            one.outcome.to_do.text.find("accept its memory") != std::string::npos;
            for (std::size_t i = 0; i < open_.size(); ++i) {
                if (open_[i].piece != one.piece) continue;
                if (one.outcome.may_be_milled) look_at(open_[i]);
                const bool has_word = one.outcome.start_outcome == StartOutcome::started || one.outcome.milled_before ||
                                      has_said_unknown(open_[i]);
                if (!has_word) continue;
                open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(i));
                break;
            }
        }
        if (store_is_lost || history_of(journal.content().rows).store_is_lost) accept_store(journal);
    }

    // The report agrees with what really started.
    void judge(const JobOutcome& outcome) {
        const int starts = world_.starts_of(outcome.job_id);
        end_.said_started += outcome.start_outcome == StartOutcome::started ? 1 : 0;
        end_.said_not_started += outcome.start_outcome == StartOutcome::not_started ? 1 : 0;
        end_.said_unknown += outcome.start_outcome == StartOutcome::unknown ? 1 : 0;
        const bool is_wrong = (outcome.start_outcome == StartOutcome::started && starts != 1) ||
                              (outcome.start_outcome == StartOutcome::not_started && starts != 0);
        if (is_wrong) {
            say("WRONG REPORT: " + std::string(describe(outcome.start_outcome)) + " of job " + to_text(outcome.job_id) +
                ", starts " + std::to_string(starts));
            ++end_.wrong_reports;
        }
        reports_.push_back(outcome);
    }

    // Whether the file was carved is UNKNOWN. The operator looks, and orders it once more if it was not; but not while
    // the other PC may start the same file.
    void look_at(const PieceJob& job) {
        again_ = !plan_.same_file && world_.starts_of(job.ticket.file_sha256) == 0;
        if (!again_) unknown_.insert(job.ticket.file_name);
    }

    // The operator looks at the cell, accepts its memory, and orders only what he did not see carved.
    void accept_store(Journal& journal) {
        VirtualLink link(world_);
        HandOffInput input = read_status_block(link);
        if (!input.status) return;
        const std::optional<SeenStore> now = read_store(link);
        if (!now) return;
        JournalEvent event;
        event.kind = JournalKind::store_accepted;
        event.store = *now;
        journal.append(event);
        say("the operator accepts the new memory");
        std::vector<PieceJob> left;
        for (const PieceJob& job : open_) {
            if (world_.starts_of(job.ticket.file_sha256) == 0) {
                left.push_back(job);
            } else {
                unknown_.insert(job.ticket.file_name);
            }
        }
        open_ = left;
    }

    DispatchOptions options() {
        DispatchOptions options;
        if (!plan_.chunks) options.drop_folder = folder_.parent_path() / "drop";
        options.clock.now_s = [this] { return world_.now_s(); };
        options.clock.sleep = [this](double seconds) { world_.sleep(seconds); };
        options.random = [this] { return static_cast<std::uint32_t>(world_.random() >> 32U) | 1U; };
        if (plan_.takes_over && number_ == 1) options.takeover_code = 4711;
        options.again = std::exchange(again_, false);
        options.signing_key = plan_.signing_key;
        options.journal = [this](const JournalEvent&) { old_journal_.after_event(); };
        options.at_point = [this](const std::string& point) {
            if (kill_at_ == 0 || --kill_at_ > 0) return;
            say("KILLED " + point);
            throw Killed();
        };
        return options;
    }

    World& world_;
    const Plan& plan_;
    int number_;
    fs::path folder_;
    OldJournal old_journal_;
    ScheduleEnd& end_;
    int kills_left_;
    int kill_at_ = 0;
    std::atomic<bool> cancelled_ = false;
    double cancelled_s_ = -1;
    std::vector<PieceJob> jobs_;
    std::vector<PieceJob> open_;
    std::set<std::string> unknown_;
    bool again_ = false;  // of the next dispatch
    std::vector<JobOutcome> reports_;
};

void plan_power(World& world, const Plan& plan, ScheduleEnd& end) {
    for (int i = 0; i < plan.power_cuts; ++i) {
        const bool is_lost = i < plan.stores_lost;
        const auto store = !is_lost             ? PowerCut::Store::stays
                           : world.happens(700) ? PowerCut::Store::lost
                                                : PowerCut::Store::back;
        const double when_s = static_cast<double>(world.random() % 60000) / 1000;
        const std::uint64_t events = world.random() % 30;
        world.at(when_s, [&world, &end, store, events] {
            ++end.power_cuts;
            end.stores_lost += store == PowerCut::Store::stays ? 0 : 1;
            if (events == 0) return world.cut_power(store);
            world.cut_power_at_event(events, store);
        });
    }
    world.at(faults_end_s, [&world] { world.end_faults(); });
}

// The whole of it, once no dispatcher runs any more.
void judge_end(const World& world, const std::vector<std::unique_ptr<Pc>>& pcs, ScheduleEnd& end) {
    for (const auto& pc : pcs) {
        for (const PieceJob& job : pc->jobs()) {
            ++end.jobs;
            const int starts = world.starts_of(job.ticket.file_sha256);
            if (starts == 0 && !pc->has_said_unknown(job)) ++end.lost;
            if (starts > 1) ++end.double_starts;
        }
        for (const JobOutcome& report : pc->reports()) {
            if (report.start_outcome == StartOutcome::not_started && world.starts_of(report.job_id) != 0) {
                ++end.wrong_reports;
            }
        }
    }
    if (world.max_starts_of_a_job() > 1 || !world.count_is_right()) ++end.double_starts;
}

}  // namespace

void ScheduleEnd::add(const ScheduleEnd& other) {
    jobs += other.jobs;
    lost += other.lost;
    double_starts += other.double_starts;
    wrong_reports += other.wrong_reports;
    hangs += other.hangs;
    link_faults += other.link_faults;
    kills += other.kills;
    power_cuts += other.power_cuts;
    stores_lost += other.stores_lost;
    journals_set_back += other.journals_set_back;
    said_started += other.said_started;
    said_not_started += other.said_not_started;
    said_unknown += other.said_unknown;
}

ScheduleEnd run_schedule(std::uint64_t seed, const std::function<void(const std::string&)>& on_line) {
    const StateFolder folder;
    ScheduleEnd end;
    World world(seed, folder.path / "drop");
    world.on_line = on_line;
    Plan plan = draw_plan(world);
    if (seed % 2 == 1) {
        plan.signing_key = fixed_key();
        world.require_signature(plan.signing_key->public_key());
    }
    world.proxy.set_odds(plan.link_per_thousand);
    plan_power(world, plan, end);
    std::vector<std::unique_ptr<Pc>> pcs;
    std::vector<std::function<void()>> bodies;
    for (int i = 0; i < plan.pcs; ++i) {
        const std::uint64_t pc_seed = seed * 2 + static_cast<std::uint64_t>(i) + 0x9E3779B97F4A7C15U;
        pcs.push_back(std::make_unique<Pc>(world, plan, i, folder.path / ("pc-" + std::to_string(i)), pc_seed, end));
        bodies.emplace_back([pc = pcs.back().get()] { pc->run(); });
    }
    world.run(bodies);
    judge_end(world, pcs, end);
    end.link_faults = static_cast<int>(world.proxy.log().size());
    end.log = world.log;
    return end;
}

}  // namespace qchopper::schedules
