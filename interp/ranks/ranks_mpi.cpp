// SPDX-FileCopyrightText: The Terratet authors
// SPDX-License-Identifier: GPL-3.0-or-later
/// \file
/// With MPI: point-to-point messages alone, so that a rank that fails can say so in place of what was awaited of it.

#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <list>
#include <optional>
#include <thread>

#include "interp/ranks/ranks.hpp"
#include "tess/error.hpp"

namespace terratet {
namespace {

/// A message is parts of at most 1 GiB, since MPI counts by int.
enum Tag : int { last_part, more_parts, outcome, stop };
constexpr std::size_t most_in_part = std::size_t{1} << 30;
constexpr std::size_t most_on_the_way = std::size_t{256} << 20;  ///< bytes

/// By what the starters of the usual MPIs set: MPI_Init without one would start a daemon of its own.
bool started_by_mpirun() {
    constexpr const char* set_by_starters[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK", "MPI_LOCALNRANKS"};
    return std::ranges::any_of(set_by_starters, [](const char* name) { return std::getenv(name) != nullptr; });
}

/// Until `done` says so; asks often at first, then every half millisecond.
template <class Done>
void wait_until(const Done& done) {
    using namespace std::chrono_literals;
    for (auto pause = 1us; !done(); pause = std::min<std::chrono::microseconds>(2 * pause, 500us)) {
        std::this_thread::sleep_for(pause);
    }
}

struct OnTheWay {
    std::string bytes;
    std::vector<MPI_Request> parts;

    bool arrived() {
        int all = 0;
        MPI_Testall(static_cast<int>(parts.size()), parts.data(), &all, MPI_STATUSES_IGNORE);
        return all != 0;
    }
};

[[noreturn]] void throw_outcome(const RankOutcome& of_rank) {
    switch (of_rank.kind) {
        case RankOutcome::Kind::usage:
            throw UsageError(of_rank.message);
        case RankOutcome::Kind::input:
            throw InputError(of_rank.message);
        case RankOutcome::Kind::failed:
            throw Error(of_rank.message);
        default:
            throw Error("a rank ended before its work was done; were all given the same arguments?");
    }
}

}  // namespace

struct Ranks::Impl {
    int rank = 0;
    int count = 1;
    std::list<OnTheWay> sent;
    std::vector<std::optional<RankOutcome>> outcomes;  ///< at rank 0, of those that have ended

    void post(int to, std::string bytes, Tag tag);
    std::string take(int from, Tag& tag) const;
    void settle(std::size_t most);
    [[nodiscard]] bool told_to_stop() const;
};

Ranks::Ranks() {
    if (!started_by_mpirun()) {
        return;
    }
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    impl_ = std::make_unique<Impl>();
    MPI_Comm_rank(MPI_COMM_WORLD, &impl_->rank);
    MPI_Comm_size(MPI_COMM_WORLD, &impl_->count);
    impl_->outcomes.resize(static_cast<std::size_t>(impl_->count));
    if (provided < MPI_THREAD_SERIALIZED && impl_->count > 1) {
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
}

Ranks::~Ranks() {
    if (impl_) {
        MPI_Finalize();
    }
}

bool Ranks::available() {
    return true;
}

int Ranks::rank() const {
    return impl_ ? impl_->rank : 0;
}

int Ranks::count() const {
    return impl_ ? impl_->count : 1;
}

void Ranks::Impl::post(int to, std::string bytes, Tag tag) {
    OnTheWay& message = sent.emplace_back();
    message.bytes = std::move(bytes);
    std::size_t begin = 0;
    do {
        const std::size_t size = std::min(most_in_part, message.bytes.size() - begin);
        const bool last = begin + size == message.bytes.size();
        MPI_Isend(message.bytes.data() + begin, static_cast<int>(size), MPI_BYTE, to, last ? tag : more_parts,
                  MPI_COMM_WORLD, &message.parts.emplace_back());
        begin += size;
    } while (begin < message.bytes.size());
}

/// The next message from a rank, whatever it is.
std::string Ranks::Impl::take(int from, Tag& tag) const {
    std::string bytes;
    do {
        MPI_Message message = MPI_MESSAGE_NULL;
        MPI_Status status;
        wait_until([&] {
            int there = 0;
            MPI_Improbe(from, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &message, &status);
            return there != 0;
        });
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        const std::size_t begin = bytes.size();
        bytes.resize(begin + static_cast<std::size_t>(size));
        MPI_Request request = MPI_REQUEST_NULL;
        MPI_Imrecv(bytes.data() + begin, size, MPI_BYTE, &message, &request);
        wait_until([&] {
            int arrived = 0;
            MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
            return arrived != 0;
        });
        tag = static_cast<Tag>(status.MPI_TAG);
    } while (tag == more_parts);
    return bytes;
}

/// Waits until at most so many bytes are on their way.
void Ranks::Impl::settle(std::size_t most) {
    wait_until([&] {
        std::erase_if(sent, [](OnTheWay& message) { return message.arrived(); });
        std::size_t bytes = 0;
        for (const OnTheWay& message : sent) {
            bytes += message.bytes.size();
        }
        return bytes <= most && (most > 0 || sent.empty());
    });
}

bool Ranks::Impl::told_to_stop() const {
    int there = 0;
    MPI_Iprobe(0, stop, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
    return there != 0;
}

void Ranks::send(std::string bytes) const {
    if (impl_->told_to_stop()) {
        throw Cancelled();
    }
    impl_->post(0, std::move(bytes), last_part);
    impl_->settle(most_on_the_way);
}

std::string Ranks::receive(int from) const {
    auto& ended = impl_->outcomes[static_cast<std::size_t>(from)];
    if (!ended) {
        Tag tag = last_part;
        std::string bytes = impl_->take(from, tag);
        if (tag != outcome) {
            return bytes;
        }
        ended = RankOutcome{static_cast<RankOutcome::Kind>(bytes.at(0)), bytes.substr(1)};
    }
    throw_outcome(*ended);
}

std::string Ranks::broadcast(std::string bytes) const {
    if (count() == 1) {
        return bytes;
    }
    if (is_root()) {
        for (int to = 1; to < count(); ++to) {
            impl_->post(to, bytes, last_part);
        }
        impl_->settle(most_on_the_way);
        return bytes;
    }
    bool stopped = false;
    wait_until([&] {
        int there = 0;
        MPI_Iprobe(0, last_part, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        if (there == 0) {
            MPI_Iprobe(0, more_parts, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE);
        }
        stopped = impl_->told_to_stop();
        return there != 0 || stopped;
    });
    if (stopped) {
        throw Cancelled();
    }
    Tag tag = last_part;
    return impl_->take(0, tag);
}

std::vector<std::string> Ranks::exchange(std::string bytes) const {
    std::vector<std::string> all{std::move(bytes)};
    if (count() == 1) {
        return all;
    }
    if (is_root()) {
        for (int from = 1; from < count(); ++from) {
            all.push_back(receive(from));
        }
        for (std::string& one : all) {
            static_cast<void>(broadcast(one));
        }
        return all;
    }
    send(std::move(all.front()));
    all.clear();
    for (int from = 0; from < count(); ++from) {
        all.push_back(broadcast());
    }
    return all;
}

/// Rank 0 tells all to stop and drops what they still send until they have ended; a rank says what it came to and then
/// drops all until it is told to stop, so that no message is left over.
RankOutcome Ranks::finish(RankOutcome own) const {
    if (count() == 1) {
        return own;
    }
    Tag tag = last_part;
    if (!is_root()) {
        impl_->post(0, static_cast<char>(own.kind) + own.message, outcome);
        do {
            static_cast<void>(impl_->take(0, tag));
        } while (tag != stop);
        impl_->settle(0);
        return own;
    }
    for (int to = 1; to < count(); ++to) {
        impl_->post(to, {}, stop);
    }
    RankOutcome first = std::move(own);
    for (int from = 1; from < count(); ++from) {
        auto& ended = impl_->outcomes[static_cast<std::size_t>(from)];
        while (!ended) {
            const std::string bytes = impl_->take(from, tag);
            if (tag == outcome) {
                ended = RankOutcome{static_cast<RankOutcome::Kind>(bytes.at(0)), bytes.substr(1)};
            }
        }
        const bool failed = ended->kind != RankOutcome::Kind::done && ended->kind != RankOutcome::Kind::stopped;
        if (failed && first.kind == RankOutcome::Kind::done) {
            first = *ended;
        }
    }
    impl_->settle(0);
    return first;
}

}  // namespace terratet
