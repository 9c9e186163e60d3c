// Makes, shows, trusts and revokes keys, signs jobs and checks their signatures. O(keys), O(bytes of the jobs).

#include <sys/stat.h>

#include <algorithm>

#include "app/cli/commands.h"
#include "app/cli/exit_code.h"
#include "app/cli/passphrase.h"
#include "app/report/cell/keys_report.h"
#include "base/error.h"
#include "base/files/file.h"
#include "base/files/portable_name.h"
#include "devices/journal/journal.h"
#include "devices/wire/ticket_signature.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

// For this user alone.
void make_keys_folder() {
    std::error_code error;
    fs::create_directories(keys_folder(), error);
    if (error) {
        throw InputError(InputFault::create, keys_folder().string() + " cannot be made: " + error.message(),
                         "Make it, or set XDG_STATE_HOME to a folder that stays.");
    }
    ::chmod(keys_folder().c_str(), S_IRWXU);
}

std::string text_id(const Ed25519PublicKey& key) {
    return key_id_text(key_id_of(key));
}

ChangedKey make(const KeysArguments& a) {
    const std::string name = fs::path(a.key).stem().string();
    if (!is_portable_name(name)) {
        throw InputError(InputFault::use, "'" + name + "' is no name for a key",
                         "use 1 to 32 of A-Z a-z 0-9 . _ -, no dot in front");
    }
    const fs::path file = private_key_path(a.key);
    fs::path shown = file;
    shown.replace_extension(".pub");
    refuse_in_project(file);
    make_keys_folder();
    const fs::path list_file = trusted_keys_file(a.list);
    TrustedKeys list = read_trusted_keys(list_file);
    const Ed25519PrivateKey key = Ed25519PrivateKey::make();
    trust(list, name, key.public_key(), unix_ms());  // before anything is written: the name may be taken
    const Passphrase passphrase = a.no_passphrase ? Passphrase() : new_passphrase(a.passphrase_fd, name);
    write_private_key(file, key, passphrase.text());
    write_file(shown, to_pem(key.public_key()));
    write_trusted_keys(list_file, list);
    return {"made",
            name,
            text_id(key.public_key()),
            {file.string(), shown.string(), list_file.string()},
            "It is trusted on this computer. Have " + shown.string() +
                " trusted on the box that verifies for the cell: qchopper keys trust FILE"};
}

ChangedKey add_trusted(const KeysArguments& a) {
    const Bytes bytes = read_file(a.key, settings_limit);
    const auto read = public_key_from_pem({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    if (!read.key) {
        throw InputError(InputFault::config,
                         a.key + (bytes.empty()                        ? " is empty"
                                  : read.fault == PemFault::other_kind ? " holds no public Ed25519 key"
                                                                       : " is cut short, or no public key in PEM"),
                         "name the file NAME.pub that keys make has written");
    }
    make_keys_folder();
    const fs::path list_file = trusted_keys_file(a.list);
    TrustedKeys list = read_trusted_keys(list_file);
    trust(list, a.name.value_or(fs::path(a.key).stem().string()), *read.key, unix_ms());
    write_trusted_keys(list_file, list);
    return {"trusted", find_key(list, key_id_of(*read.key))->name, text_id(*read.key), {list_file.string()}, {}};
}

ChangedKey add_revoked(const KeysArguments& a) {
    const fs::path list_file = trusted_keys_file(a.list);
    TrustedKeys list = read_trusted_keys(list_file);
    const TrustedKey key = revoke(list, a.key, unix_ms());
    write_trusted_keys(list_file, list);
    return {
        "revoked",
        key.name,
        text_id(key.key),
        {list_file.string()},
        "Revoke it on every other box that trusts it. A job that has started runs on: stop it by qchopper cell stop."};
}

OwnKey own_key(const fs::path& file) {
    try {
        const PrivateKeyFile read = read_own_key(file.string());
        return {file.string(), text_id(read.public_key), read.is_encrypted, {}};
    } catch (const InputError& error) {
        return {file.string(), {}, false, error.what()};
    }
}

KeysReport shown_keys(const KeysArguments& a) {
    KeysReport report;
    report.list = trusted_keys_file(a.list).string();
    report.trusted = read_trusted_keys(report.list);
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(keys_folder(), error), end; !error && entry != end; entry.increment(error)) {
        if (entry->path().extension() == ".key") files.push_back(entry->path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) report.own.push_back(own_key(file));
    return report;
}

template <class Report>
int shown(const Report& report, Terminal& terminal, int code = exit_done) {
    terminal.show(lines(report), document(report));
    return code;
}

}  // namespace

int run(const KeysArguments& a, Terminal& terminal) {
    terminal.set_unchanged("No key and no list was changed.");
    if (a.action == "show") return shown(shown_keys(a), terminal);
    if (a.action == "make") return shown(make(a), terminal);
    if (a.action == "trust") return shown(add_trusted(a), terminal);
    if (a.action == "revoke") return shown(add_revoked(a), terminal);
    if (a.action == "sign") {
        terminal.set_unchanged("No job was signed.");
        const Ed25519PrivateKey key = open_own_key(a.signing.key.value_or(""), a.signing.passphrase_fd);
        return shown(sign_jobs(a.inputs.front(), key, terminal.context()), terminal);
    }
    terminal.set_unchanged("Nothing was changed.");
    const auto checked = check_signatures(a.inputs, a.cell_id, read_trusted_keys(trusted_keys_file(a.list)));
    return shown(checked, terminal, is_all_right(checked) ? exit_done : exit_demand_broken);
}

}  // namespace qchopper
