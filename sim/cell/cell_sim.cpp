// Joins the machine to threads: the server's thread answers requests and passes time, one thread copies and hashes job
// files, and each question to a person has a thread of its own. One mutex guards the state of the machine. O(1) for
// each request and tick, beside what the machine does; O(bytes) for a file.

#include "sim/cell/cell_sim.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/sha256.h"
#include "sim/cell/drafts.h"
#include "sim/cell/link/modbus_server.h"
#include "sim/cell/memory.h"
#include "sim/cell/modbus_pdu.h"
#include "sim/cell/panel.h"
#include "sim/cell/store.h"

namespace qchopper {
namespace {

constexpr std::int64_t off_ms = 1000;       // after a power cut by a fault
constexpr std::int64_t clock_step_ms = 50;  // by which a virtual clock goes on at most

// The clock of the computer, or one that goes on only when it is told to. It never goes back, also where it is changed
// from one kind to the other.
class SimClock {
 public:
    CellTime now() const {
        if (is_virtual_) return shown_;
        const CellTime real = read();
        return {real.steady_ms + ahead_ms_, real.unix_ms + static_cast<std::uint64_t>(ahead_ms_)};
    }
    bool is_virtual() const { return is_virtual_; }
    void set_virtual(bool is_virtual) {
        shown_ = now();
        is_virtual_ = is_virtual;
        ahead_ms_ = shown_.steady_ms - read().steady_ms;
    }
    // Precondition: the clock is virtual.
    void pass(std::int64_t ms) {
        shown_.steady_ms += ms;
        shown_.unix_ms += static_cast<std::uint64_t>(ms);
    }

 private:
    static CellTime read() {
        using namespace std::chrono;
        const auto steady = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
        const auto unix_time = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
        return {steady, static_cast<std::uint64_t>(unix_time)};
    }

    bool is_virtual_ = false;
    CellTime shown_;             // of the virtual clock
    std::int64_t ahead_ms_ = 0;  // of the computer's clock
};

// Where the answer of a person is delivered. Outlives the cell, because the answer may come after its end.
struct Mailbox {
    std::mutex mutex;
    bool is_open = true;
    std::function<void(std::uint64_t, bool)> deliver;
};

}  // namespace

struct CellSim::Parts {
    explicit Parts(CellSimOptions given) : options(std::move(given)) {}

    CellHooks hooks() {
        return {[this](const CellMemory& memory) { return write([&] { save_memory(store->memory(), memory); }); },
                [this](const std::string& line) { report(line); },
                [this](const CellMemory& memory, std::uint64_t bytes) {
                    store->remove_old_copies(memory, bytes);
                    return store->free_kib();
                },
                [this] { return load_marks(store->marks()); },
                [this](const SaveMarks& marks) { return write([&] { save_marks(store->marks(), marks); }); },
                options.trusted_keys};
    }

    // False: it could not be written.
    template <class Write>
    bool write(const Write& what) const {
        try {
            what();
            return true;
        } catch (const InputError& fault) {
            report(fault.what());
            return false;
        }
    }

    void report(const std::string& line) const {
        if (options.on_message) options.on_message(line);
    }

    ServerAnswer answer(const ServerRequest& request) {
        const std::lock_guard lock(mutex);
        if (is_off) return {};
        const std::uint16_t bad_frames = cell.bad_frames;
        drafts.begin(request.connection, cell);
        ServerAnswer made{answer_pdu(request.unit, request.pdu, cell, clock.now(), cell_hooks)};
        drafts.end(request.connection, request.pdu, cell);
        if (!has_power()) return {};
        pass_on_pending();
        made.is_valid = cell.bad_frames == bad_frames;
        made.lease = lease_named_in(request.pdu, cell);
        return made;
    }

    std::uint64_t lease() {
        const std::lock_guard lock(mutex);
        return is_off ? 0 : lease_number(cell);
    }

    void forget(std::uint64_t connection) {
        const std::lock_guard lock(mutex);
        drafts.forget(connection);
    }

    std::vector<Delivery> send(Bytes frame) {
        const std::lock_guard lock(mutex);
        return deliver(cell.faults, std::move(frame));
    }

    void tick() {
        const std::lock_guard lock(mutex);
        tick_now();
    }

    // The rest is called under the lock.

    void tick_now() {
        if (is_off && on_at_ms && clock.now().steady_ms >= *on_at_ms) turn_on(cell.power.store);
        if (is_off) return;
        pass_time(cell, clock.now(), cell_hooks);
        if (has_power()) pass_on_pending();
    }

    // False: a fault has cut it.
    bool has_power() {
        if (!cell.power.lost || is_off) return !is_off;
        turn_off();
        on_at_ms = clock.now().steady_ms + off_ms;
        return false;
    }

    void turn_off() {
        report("power is off");
        note_block(cell, clock.now());
        is_off = true;
        on_at_ms.reset();
        server->set_power(false);
    }

    void turn_on(PowerCut::Store store_is) {
        CellMemory memory;
        try {
            memory = memory_after(store_is, load_memory(store->memory()));
        } catch (const InputError& fault) {
            on_at_ms.reset();
            return report(std::string("power stays off: ") + fault.what());
        }
        if (store_is == PowerCut::Store::lost) store->empty();
        if (store_is == PowerCut::Store::all_back) cell_hooks.write_marks({memory.mark, memory.mark});
        cell = power_on(cell, memory, cell.random, clock.now(), cell_hooks);
        is_off = false;
        handled = 0;
        server->set_power(true);
        report("power is on");
    }

    bool perform(const ScriptLine& line) {
        switch (line.act) {
            case Act::consent:
                if (!asks()) return false;
                consent_given(cell, cell.pending->number, line.choice == 1, clock.now(), cell_hooks);
                return true;
            case Act::clock:
                clock.set_virtual(line.choice == 1);
                return true;
            case Act::power:
                if (line.choice == 0 && !is_off) turn_off();
                if (line.choice != 0 && is_off) turn_on(static_cast<PowerCut::Store>(line.choice - 1));
                return true;
            default:
                qchopper::perform(cell, line, clock.now(), cell_hooks);
                tick_now();
                return true;
        }
    }

    bool asks() const {
        return !is_off && cell.pending && cell.pending->waits == Pending::Waits::consent &&
               cell.limits.consent == Consent::ask;
    }

    // Passes a new pending question to another thread: the server waits for no file and no person.
    void pass_on_pending() {
        if (!cell.pending || cell.pending->number == handled) return;
        if (cell.pending->waits == Pending::Waits::file) {
            handled = cell.pending->number;
            check = FileTask{handled, cell.job.ticket, cell.job.chunks};
            wake.notify_all();
        } else if (cell.pending->waits == Pending::Waits::consent && cell.limits.consent == Consent::ask) {
            handled = cell.pending->number;
            if (options.on_question) return options.on_question(cell.pending->question);
            ask(handled, cell.pending->question);
        }
    }

    void ask(std::uint64_t number, const std::string& question) const {
        std::thread([box = mailbox, number, question, person = options.ask] {
            post(box, number, person && person(question));
        }).detach();
    }

    static void post(const std::shared_ptr<Mailbox>& box, std::uint64_t number, bool yes) {
        const std::lock_guard lock(box->mutex);
        if (box->is_open) box->deliver(number, yes);
    }

    struct FileTask {
        std::uint64_t number = 0;
        WireTicket ticket;
        Bytes chunks;
    };

    void check_files() {
        std::unique_lock lock(mutex);
        while (!ends) {
            if (!check) {
                wake.wait(lock);
                continue;
            }
            const FileTask task = std::move(*check);
            check.reset();
            lock.unlock();
            const FileCheck found = store_file(task);
            const std::uint32_t free_kib = store->free_kib();
            lock.lock();
            cell.store_free_kib = free_kib;
            if (is_off) continue;
            file_checked(cell, task.number, found, clock.now(), cell_hooks);
        }
    }

    // Copies the file to the store and hashes the bytes of the copy: the copy is what runs.
    FileCheck store_file(const FileTask& task) const {
        Bytes bytes = task.chunks;
        try {
            if (task.ticket.transfer == Transfer::drop_folder) {
                const std::filesystem::path file = options.drop_folder / task.ticket.file_name;
                std::error_code error;
                const std::uintmax_t size = std::filesystem::file_size(file, error);
                if (options.drop_folder.empty() || error || !std::filesystem::is_regular_file(file, error)) return {};
                // Never more is read than the ticket announces.
                if (size != task.ticket.file_size) return {FileCheck::End::ok, size, {}};
                bytes = read_file(file, {task.ticket.file_size, InputFault::io});
            }
        } catch (const InputError& fault) {
            report(fault.what());
            return {};
        }
        try {
            write_file(store->job(task.ticket.job_id), bytes);
        } catch (const InputError& fault) {
            report(fault.what());
            return {FileCheck::End::io_error, 0, {}};
        }
        FileCheck found{FileCheck::End::ok, bytes.size(), sha256(bytes)};
        const bool is_right = bytes.size() == task.ticket.file_size && found.sha256 == task.ticket.file_sha256;
        if (is_right && options.read_program) found.program = options.read_program(bytes, task.ticket.file_name);
        return found;
    }

    CellSimOptions options;
    std::unique_ptr<Store> store;
    CellHooks cell_hooks;
    mutable std::mutex mutex;  // guards all below
    SimClock clock;
    CellState cell;
    Drafts drafts;
    bool is_off = false;
    std::optional<std::int64_t> on_at_ms;  // of an end of a power cut that comes by itself
    std::uint64_t handled = 0;             // number of the question that was passed on last
    std::optional<FileTask> check;
    bool ends = false;
    std::condition_variable wake;
    std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>();
    std::thread checker;
    std::unique_ptr<ModbusServer> server;
};

CellSim::CellSim(CellSimOptions options) : parts_(std::make_unique<Parts>(std::move(options))) {}

CellSim::~CellSim() {
    stop();
}

void CellSim::start() {
    Parts& p = *parts_;
    if (p.server) return;
    std::error_code error;
    if (!p.options.drop_folder.empty() && !std::filesystem::is_directory(p.options.drop_folder, error)) {
        throw InputError(InputFault::missing, "the drop folder " + p.options.drop_folder.string() + " is not there",
                         "Make it, or give another.");
    }
    if (!(p.options.limits.speed > 0)) {
        throw InputError(InputFault::use, "the speed of a cell must be greater than 0",
                         "Give 1 for the speed of the real cell.");
    }
    p.store = std::make_unique<Store>(p.options.store_folder, p.options.max_store_bytes);
    p.cell_hooks = p.hooks();
    std::random_device device;
    const std::uint64_t seed = (std::uint64_t{device()} << 32U) | device();
    p.cell = boot(p.options.limits, load_memory(p.store->memory()), seed, p.clock.now(), p.cell_hooks);
    p.cell.store_free_kib = p.store->free_kib();
    p.mailbox->deliver = [&p](std::uint64_t number, bool yes) {
        const std::lock_guard lock(p.mutex);
        if (!p.is_off) consent_given(p.cell, number, yes, p.clock.now(), p.cell_hooks);
    };
    ModbusServerOptions listens;
    static_cast<ListenAt&>(listens) = p.options;
    listens.deliver = [&p](Bytes frame) { return p.send(std::move(frame)); };
    listens.lease = [&p] { return p.lease(); };
    listens.on_close = [&p](std::uint64_t connection) { p.forget(connection); };
    if (p.options.peer_rate > 0) listens.peer_rate = listens.peer_burst = p.options.peer_rate;
    p.server = std::make_unique<ModbusServer>(
        listens, [&p](const ServerRequest& request) { return p.answer(request); }, [&p] { p.tick(); },
        [&p](const std::string& line) { p.report(line); });
    try {
        p.server->start();
    } catch (...) {
        p.server.reset();
        throw;
    }
    p.checker = std::thread([&p] { p.check_files(); });
}

std::uint16_t CellSim::port() const {
    return parts_->server ? parts_->server->port() : std::uint16_t{0};
}

void CellSim::stop() {
    Parts& p = *parts_;
    {
        const std::lock_guard lock(p.mailbox->mutex);
        p.mailbox->is_open = false;
    }
    if (p.server) p.server->stop();
    {
        const std::lock_guard lock(p.mutex);
        p.ends = true;
    }
    p.wake.notify_all();
    if (p.checker.joinable()) p.checker.join();
    p.server.reset();
    p.store.reset();
}

Status CellSim::status() const {
    const std::lock_guard lock(parts_->mutex);
    return status_of(parts_->cell, parts_->clock.now());
}

std::optional<CarvedJob> CellSim::carved_job() const {
    const std::lock_guard lock(parts_->mutex);
    if (!parts_->is_off) note_block(parts_->cell, parts_->clock.now());
    const CarvedSoFar& carved = parts_->cell.surroundings.carved;
    if (carved.job == Uuid{} || !parts_->store) return std::nullopt;
    return CarvedJob{parts_->store->job(carved.job), carved.run_s};
}

bool CellSim::perform(const ScriptLine& line) {
    const std::lock_guard lock(parts_->mutex);
    return parts_->perform(line);
}

bool CellSim::holds(std::size_t choice) const {
    const std::lock_guard lock(parts_->mutex);
    return !parts_->is_off && qchopper::holds(parts_->cell, choice);
}

bool CellSim::is_clock_virtual() const {
    const std::lock_guard lock(parts_->mutex);
    return parts_->clock.is_virtual();
}

std::int64_t CellSim::steady_ms() const {
    const std::lock_guard lock(parts_->mutex);
    return parts_->clock.now().steady_ms;
}

// In steps, so that what is due on the way is done in its order.
void CellSim::pass(double seconds, const std::function<bool()>& is_stopped) {
    for (auto left_ms = static_cast<std::int64_t>(1000 * seconds); left_ms > 0; left_ms -= clock_step_ms) {
        if (is_stopped && is_stopped()) return;
        const std::lock_guard lock(parts_->mutex);
        parts_->clock.pass(std::min(left_ms, clock_step_ms));
        parts_->tick_now();
    }
}

}  // namespace qchopper
