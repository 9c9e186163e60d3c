// The set-up of docs/user/tls.md, taken from that page and run: an authority, certificates, two stunnel programs.

#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace qchopper::rig {

// stunnel4 and openssl are installed.
bool has_stunnel();

// The blocks of docs/user/tls.md in one language, "sh" or "ini", in their order.
std::vector<std::string> blocks_of_tls_page(const std::string& language);

// A TCP port that nobody listens on now.
std::uint16_t free_port();

// An authority in a folder of its own. Every function throws std::runtime_error if openssl fails.
class Authority {
 public:
    explicit Authority(std::filesystem::path parent);
    // NAME.pem and NAME.key; `dates` are options of `openssl ca`.
    void issue(const std::string& name, const std::string& dates = {}) const;
    void revoke(const std::string& name) const;
    void make_crl(const std::string& dates = {}) const;
    std::filesystem::path folder() const { return folder_; }

 private:
    void run(const std::string& commands) const;
    std::filesystem::path folder_;
};

// One stunnel program; it runs until the end of the object.
class Stunnel {
 public:
    // The block of the page, its /etc/stunnel/ replaced by `folder`, with these addresses. Waits until it listens, or
    // has ended.
    Stunnel(std::string configuration, const std::filesystem::path& folder, std::uint16_t accepts,
            std::uint16_t connects);
    ~Stunnel();
    Stunnel(const Stunnel&) = delete;
    Stunnel& operator=(const Stunnel&) = delete;
    bool is_listening() const { return is_listening_; }
    std::string log() const;

 private:
    std::filesystem::path log_;
    pid_t pid_ = -1;
    bool is_listening_ = false;
};

// `text` with every line that begins with this key left out.
std::string without_key(const std::string& text, const std::string& key);

}  // namespace qchopper::rig
