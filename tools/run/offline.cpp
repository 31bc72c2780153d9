// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/run/offline.hpp"

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include "interp/ranks/ranks.hpp"
#include "io/base/needed_drivers.hpp"
#include "io/base/network.hpp"

namespace terratet::tools {
namespace {

/// socket(AF_INET or AF_INET6, …) fails with EACCES from here on; local sockets do not. Where the system knows no such
/// filter, GDAL is held back all the same (io/base/network.hpp).
void refuse_internet_sockets() {
    constexpr auto domain = static_cast<std::uint32_t>(offsetof(seccomp_data, args));  // its low half: little-endian
    std::array<sock_filter, 7> filter{{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_socket, 0, 4),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, domain),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_INET, 1, 0),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, AF_INET6, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EACCES),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0) {
        prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
    }
}

bool wants_grids() {
    const char* const value = std::getenv("PROJ_NETWORK");
    constexpr std::array yes{"ON", "on", "YES", "yes", "TRUE", "true"};
    return value && std::find(yes.begin(), yes.end(), std::string(value)) != yes.end();
}

}  // namespace

void stay_offline(const std::vector<std::string>& arguments, const Ranks& ranks) {
    if (ranks.count() == 1 && std::none_of(arguments.begin(), arguments.end(), names_network) && !wants_grids()) {
        refuse_internet_sockets();
    }
    keep_needed_gdal_drivers();
}

}  // namespace terratet::tools
