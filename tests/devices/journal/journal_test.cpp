// The journal on the disk: chain, lock, power cuts, a full disk.

#include "devices/journal/journal.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "base/error.h"
#include "base/files/file.h"
#include "devices/hand_off/journal_history.h"
#include "tests/folder.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

const JournalCell cell_7{7, false, {}};

JournalEvent intent(std::uint32_t seq) {
    JournalEvent event;
    event.kind = JournalKind::start_intent;
    event.job_id = {1};
    event.seq = seq;
    return event;
}

JournalEvent created() {
    JournalEvent event;
    event.job_id = {1};
    event.ticket.assign(100, 7);
    return event;
}

template <class Call>
InputError error_of(const Call& call) {
    try {
        call();
    } catch (const InputError& error) {
        return error;
    }
    ADD_FAILURE() << "no error";
    return {InputFault::use, ""};
}

void change(const fs::path& folder, const std::string& sql) {
    sqlite3* handle = nullptr;
    ASSERT_EQ(sqlite3_open((folder / "journal.sqlite").c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(handle);
    sqlite3_close(handle);
}

TEST(Journal, RowsComeBackInTheNextRunAndAreReadableMeanwhile) {
    const Folder folder;
    {
        Journal journal(folder.path / "cell", cell_7);
        EXPECT_TRUE(journal.content().rows.empty());
        journal.append(created());
        journal.append(intent(5));
        const JournalContent read = read_journal(folder.path / "cell");
        ASSERT_EQ(read.rows.size(), 2U);
        EXPECT_EQ(read.rows[1].event, intent(5));
        EXPECT_EQ(read.hash, journal.content().hash);
    }
    Journal again(folder.path / "cell", cell_7);
    ASSERT_EQ(again.content().rows.size(), 2U);
    again.append(intent(6));
    EXPECT_EQ(read_journal(folder.path / "cell").rows[2].event.seq, 6U);
    EXPECT_EQ(fs::status(folder.path / "cell").permissions() & fs::perms::all, fs::perms::owner_all);
}

TEST(Journal, ThereIsOneWriter) {
    const Folder folder;
    Journal journal(folder.path, cell_7);
    const InputError error = error_of([&] { Journal second(folder.path, cell_7); });
    EXPECT_EQ(error.fault, InputFault::busy);
    EXPECT_NE(std::string(error.what()).find("cell 7"), std::string::npos) << error.what();
}

TEST(Fault, F28_TheJournalOfAnotherCellIsRefused) {
    const Folder folder;
    { Journal journal(folder.path, cell_7); }
    for (const JournalCell& other :
         {JournalCell{8, false, {}}, JournalCell{7, true, "127.0.0.1:15020"}, JournalCell{7, true, {}}}) {
        const InputError error = error_of([&] { Journal wrong(folder.path, other); });
        EXPECT_EQ(error.fault, InputFault::config);
        EXPECT_NE(std::string(error.what()).find("is the journal of cell 7"), std::string::npos) << error.what();
    }
    Journal right(folder.path, cell_7);
}

TEST(Journal, AChangedMissingOrForgedRowIsFoundAndNamed) {
    const std::pair<const char*, const char*> damages[] = {
        {"UPDATE event SET data = replace(data, 'seq=2', 'seq=9') WHERE n = 2", "row 2"},
        {"UPDATE event SET t = t + 1 WHERE n = 3", "row 3"},
        {"UPDATE event SET kind = 'STARTED' WHERE n = 1", "row 1"},
        {"DELETE FROM event WHERE n = 2", "row 2 is missing"},
        {"UPDATE event SET n = 40 WHERE n = 3", "row 3"},
        {"UPDATE meta SET cell_id = 8", "row 1"},
        {"UPDATE meta SET format = 'x'", "format"},
        {"DELETE FROM meta", "which cell"},
        {"DROP TABLE event", "no journal"},
    };
    for (const auto& [sql, words] : damages) {
        const Folder folder;
        {
            Journal journal(folder.path, cell_7);
            for (std::uint32_t seq = 1; seq <= 3; ++seq) journal.append(intent(seq));
        }
        change(folder.path, sql);
        const InputError error = error_of([&] { read_journal(folder.path); });
        EXPECT_EQ(error.fault, InputFault::config) << sql;
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << sql << ": " << error.what();
    }
    const Folder folder;
    EXPECT_EQ(error_of([&] { read_journal(folder.path); }).fault, InputFault::missing);
    std::ofstream(folder.path / "journal.sqlite") << std::string(5000, 'x');
    EXPECT_EQ(error_of([&] { Journal journal(folder.path, cell_7); }).fault, InputFault::config);
}

// Runs `child` in a process of its own, which ends by _exit(0) or a signal.
int status_of_child(const std::function<void()>& child) {
    const pid_t pid = fork();
    if (pid == 0) {
        child();
        _exit(0);
    }
    int status = 0;
    waitpid(pid, &status, 0);
    return status;
}

TEST(Journal, WhatWasAppendedBeforeKillNineIsThere) {
    const Folder folder;
    const int status = status_of_child([&] {
        Journal journal(folder.path, cell_7);
        for (std::uint32_t seq = 1; seq <= 20; ++seq) journal.append(intent(seq));
        raise(SIGKILL);
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    Journal journal(folder.path, cell_7);  // the lock went with the process
    EXPECT_EQ(journal.content().rows.size(), 20U);
}

TEST(Fault, F26_AJournalCutOffAtAnyByteOpensWithTheRowsBefore) {
    const Folder folder;
    const fs::path source = folder.path / "source";
    const int status = status_of_child([&] {
        Journal journal(source, cell_7);
        journal.append(created());
        for (std::uint32_t seq = 1; seq <= 3; ++seq) journal.append(intent(seq));
        raise(SIGKILL);  // so that the log is not folded into the file
    });
    ASSERT_TRUE(WIFSIGNALED(status));
    const fs::path log = source / "journal.sqlite-wal";
    fs::remove(source / "lock");  // the number of rows in it is never synced
    std::size_t before = 4;
    for (std::uintmax_t size = fs::file_size(log) + 1; size-- > 0;) {
        fs::resize_file(log, size);
        fs::remove(source / "journal.sqlite-shm");  // it is lost as well
        std::size_t rows = 0;
        try {
            const JournalContent content = read_journal(source);
            rows = content.rows.size();
            // The intent is there: the START may have arrived, whatever was lost after it.
            if (rows > 1) {
                EXPECT_TRUE(history_of(content.rows).jobs.at(0).start_sent) << size;
            }
        } catch (const InputError&) {
            ASSERT_EQ(before, 0U) << size;  // the tables were not yet there, and no command was sent before they were
        }
        ASSERT_LE(rows, before) << size;
        ASSERT_GE(rows + 1, before) << size;  // one at a time
        before = rows;
    }
    EXPECT_EQ(before, 0U);
    fs::remove(log);
    Journal journal(source, cell_7);  // from nothing, too
}

// What reading refuses, writing refuses: a dispatch never takes a journal that has lost rows for a new one.
void expect_refused(const fs::path& folder, const std::string& words) {
    for (const bool writes : {false, true}) {
        const InputError error =
            error_of([&] { writes ? Journal(folder, cell_7).append(created()) : void(read_journal(folder)); });
        EXPECT_EQ(error.fault, InputFault::config) << error.what();
        EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
}

TEST(Journal, WithoutItsLogIsRefusedByReaderAndWriter) {
    for (const bool has_rows_before : {false, true}) {
        const Folder folder;
        if (has_rows_before) Journal(folder.path, cell_7).append(created());
        const int status = status_of_child([&] {
            Journal journal(folder.path, cell_7);
            for (std::uint32_t seq = 1; seq <= 3; ++seq) journal.append(intent(seq));
            raise(SIGKILL);
        });
        ASSERT_TRUE(WIFSIGNALED(status));
        fs::remove(folder.path / "journal.sqlite-wal");
        fs::remove(folder.path / "journal.sqlite-shm");
        expect_refused(folder.path, has_rows_before ? "row 2 is missing, and 4 were written" : "row 1 is missing");
    }
}

TEST(Journal, WithoutItsTablesIsRefusedByReaderAndWriter) {
    const Folder folder;
    { Journal journal(folder.path, cell_7); }
    change(folder.path, "DROP TABLE event");
    expect_refused(folder.path, "is no journal");
    fs::resize_file(folder.path / "journal.sqlite", 0);
    expect_refused(folder.path, "is no journal");
}

TEST(Journal, AnOlderCopyIsRefused) {
    const Folder folder;
    Journal(folder.path, cell_7).append(created());
    fs::copy(folder.path / "journal.sqlite", folder.path / "copy");
    Journal(folder.path, cell_7).append(intent(1));
    fs::rename(folder.path / "copy", folder.path / "journal.sqlite");
    expect_refused(folder.path, "row 2 is missing");
}

// One that was killed while it made the journal leaves a file aside, which is no journal.
TEST(Journal, IsMadeWholeOrNotAtAll) {
    const Folder folder;
    std::ofstream(folder.path / "journal.sqlite.new") << "half";
    EXPECT_EQ(error_of([&] { read_journal(folder.path); }).fault, InputFault::missing);
    Journal(folder.path, cell_7).append(created());
    EXPECT_EQ(read_journal(folder.path).rows.size(), 1U);
    EXPECT_FALSE(fs::exists(folder.path / "journal.sqlite.new"));
}

// A pipe without a writer would block for ever, and so would this test.
TEST(Journal, APipeInItsPlaceIsRefused) {
    const Folder folder;
    ASSERT_EQ(::mkfifo((folder.path / "journal.sqlite").c_str(), 0600), 0);
    EXPECT_EQ(error_of([&] { read_journal(folder.path); }).fault, InputFault::missing);
    EXPECT_EQ(error_of([&] { Journal journal(folder.path, cell_7); }).fault, InputFault::missing);
}

TEST(Fault, F27_AJournalOnAFullDiskRefusesTheRowAndKeepsThoseBefore) {
    const Folder folder;
    const int status = status_of_child([&] {
        signal(SIGXFSZ, SIG_IGN);
        Journal journal(folder.path, cell_7);
        journal.append(created());
        const rlimit limit{fs::file_size(folder.path / "journal.sqlite-wal"),
                           fs::file_size(folder.path / "journal.sqlite-wal")};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            journal.append(intent(1));
            _exit(1);
        } catch (const InputError& error) {
            if (error.fault != InputFault::io || journal.content().rows.size() != 1) _exit(2);
        }
        _exit(0);
    });
    EXPECT_EQ(status, 0);
    EXPECT_EQ(read_journal(folder.path).rows.size(), 1U);
}

TEST(Fault, F27_AJournalThatCannotBeMadeIsRefused) {
    const Folder folder;
    std::ofstream(folder.path / "file") << "x";
    EXPECT_EQ(error_of([&] { Journal journal(folder.path / "file" / "cell", cell_7); }).fault, InputFault::create);
    fs::create_directories(folder.path / "cell" / "journal.sqlite");
    EXPECT_EQ(error_of([&] { Journal journal(folder.path / "cell", cell_7); }).fault, InputFault::missing);
}

TEST(Journal, FoldersOfCellsHaveNamesOfTheirOwn) {
    EXPECT_EQ(folder_name(cell_7), "cell-7");
    EXPECT_EQ(folder_name({65535, true, "127.0.0.1:15020"}), "simulated-65535-at-127.0.0.1_15020");
    EXPECT_EQ(folder_name({1, true, "[::1]:5/../x"}), "simulated-1-at-___1__5_.._x");
}

}  // namespace
}  // namespace qchopper
