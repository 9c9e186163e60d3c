// Joins the machine to threads: the server's thread answers requests and passes time, one thread copies and hashes job
// files, and each question to a person has a thread of its own. One mutex guards the state of the machine.

#include "sim/cell_sim.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>
#include <thread>

#include "base/error.h"
#include "base/sha256.h"
#include "sim/memory.h"
#include "sim/modbus_pdu.h"
#include "sim/modbus_server.h"
#include "sim/store.h"

namespace qchopper {
namespace {

CellTime now() {
    using namespace std::chrono;
    const auto steady = duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
    const auto unix_time = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
    return {steady, static_cast<std::uint64_t>(unix_time)};
}

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
        return {[this](const CellMemory& memory) {
                    try {
                        save_memory(store->memory(), memory);
                        return true;
                    } catch (const InputError& fault) {
                        report(fault.what());
                        return false;
                    }
                },
                [this](const std::string& line) { report(line); },
                [this](const CellMemory& memory, std::uint64_t bytes) {
                    store->remove_old_copies(memory, bytes);
                    return store->free_kib();
                }};
    }

    void report(const std::string& line) const {
        if (options.on_message) options.on_message(line);
    }

    Bytes answer(std::uint8_t unit, std::span<const std::uint8_t> pdu) {
        const std::lock_guard lock(mutex);
        Bytes bytes = answer_pdu(unit, pdu, cell, now(), cell_hooks);
        pass_on_pending();
        return bytes;
    }

    void tick() {
        const std::lock_guard lock(mutex);
        pass_time(cell, now(), cell_hooks);
        pass_on_pending();
    }

    // Under the lock. Passes a new pending question to another thread: the server waits for no file and no person.
    void pass_on_pending() {
        if (!cell.pending || cell.pending->number == handled) return;
        if (cell.pending->waits == Pending::Waits::file) {
            handled = cell.pending->number;
            check = FileTask{handled, cell.job.ticket, cell.job.chunks};
            wake.notify_all();
        } else if (cell.pending->waits == Pending::Waits::consent && cell.limits.consent == Consent::ask) {
            handled = cell.pending->number;
            ask(handled, cell.pending->question);
        }
    }

    void ask(std::uint64_t number, const std::string& question) const {
        if (!options.ask) {
            std::thread([box = mailbox, number] { post(box, number, false); }).detach();
            return;
        }
        std::thread([box = mailbox, number, question, person = options.ask] {
            post(box, number, person(question));
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
            file_checked(cell, task.number, found, now(), cell_hooks);
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
        return {FileCheck::End::ok, bytes.size(), sha256(bytes)};
    }

    CellSimOptions options;
    std::unique_ptr<Store> store;
    CellHooks cell_hooks;
    mutable std::mutex mutex;  // guards all below
    CellState cell;
    std::uint64_t handled = 0;  // number of the question that was passed on last
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
    p.store = std::make_unique<Store>(p.options.store_folder, p.options.most_store_bytes);
    p.cell_hooks = p.hooks();
    std::random_device device;
    const std::uint64_t seed = (std::uint64_t{device()} << 32U) | device();
    p.cell = boot(p.options.limits, load_memory(p.store->memory()), seed, now(), p.cell_hooks);
    p.cell.store_free_kib = p.store->free_kib();
    p.mailbox->deliver = [&p](std::uint64_t number, bool yes) {
        const std::lock_guard lock(p.mutex);
        consent_given(p.cell, number, yes, now(), p.cell_hooks);
    };
    auto server = std::make_unique<ModbusServer>(
        ModbusServerOptions{p.options.listen_host, p.options.port, p.options.allow},
        [&p](std::uint8_t unit, std::span<const std::uint8_t> pdu) { return p.answer(unit, pdu); }, [&p] { p.tick(); },
        [&p](const std::string& line) { p.report(line); });
    server->start();
    p.checker = std::thread([&p] { p.check_files(); });
    p.server = std::move(server);
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
    return status_of(parts_->cell, now());
}

}  // namespace qchopper
