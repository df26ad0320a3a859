// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <optional>
#include <sstream>
#include <system_error>
#include <utility>
#include <vector>

#include "ros/params/child_work.h"
#include "vegetation_sim/core/config/faults.h"

namespace vegetation_sim {
namespace {

constexpr double LONGEST_WAIT = 0.1;    // [s] for the pipe at once
constexpr std::size_t PIECE = 1 << 16;  // [B] that are read at once

class Pipe {
 public:
  explicit Pipe(const char* name) {
    if (::pipe2(ends_, O_CLOEXEC) == 0) return;
    throw InvalidInput(
        std::string(name) + " cannot be started: " + std::generic_category().message(errno),
        FaultCode::NOT_AVAILABLE);
  }
  ~Pipe() {
    ::close(ends_[0]);
    closeWriting();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reading() const { return ends_[0]; }
  int writing() const { return ends_[1]; }
  void closeWriting() {
    if (ends_[1] >= 0) ::close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2]{-1, -1};
};

/// Ends a child, however this scope is left, and leaves no zombie.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (hasEnded()) return;
    ::kill(id_, SIGKILL);
    wait(0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  bool hasEnded() {
    if (id_ != 0) wait(WNOHANG);
    return id_ == 0;
  }
  /// As of waitpid(); nothing if another part of the program has taken it, or ignores SIGCHLD.
  std::optional<int> status() const { return status_; }

 private:
  void wait(int options) {
    int status = 0;
    pid_t ended = -1;
    do ended = ::waitpid(id_, &status, options);
    while (ended < 0 && errno == EINTR);
    if (ended == 0) return;
    if (ended > 0) status_ = status;
    id_ = 0;
  }

  pid_t id_;  // 0 if it has ended
  std::optional<int> status_;
};

/// Receives a header and its bytes.
class ChildMessage {
 public:
  explicit ChildMessage(const ChildLimits& limits) : limits_(limits), piece_(PIECE) {}

  bool isComplete() const { return at_ == sizeof header_ && bytes_.size() == header_.size; }
  /// Whether the child has closed the pipe.
  bool isClosed() const { return closed_; }
  /// Takes what has come. @return whether there was something.
  bool receive(int in) {
    const bool header = at_ < sizeof header_;
    char* to = header ? reinterpret_cast<char*>(&header_) + at_ : piece_.data();
    ssize_t got = -1;
    do got = ::read(in, to, header ? sizeof header_ - at_ : wanted());
    while (got < 0 && errno == EINTR);
    closed_ = closed_ || got == 0;
    if (got <= 0) return false;
    if (!header) bytes_.append(to, static_cast<std::size_t>(got));
    if (!header) return true;
    at_ += static_cast<std::size_t>(got);
    if (at_ == sizeof header_) checkSize();
    return true;
  }
  /// @throws InvalidInput if the bytes are no result.
  std::string result() {
    const std::string name = limits_.name;
    switch (header_.outcome) {
      case ChildOutcome::RESULT:
        return std::move(bytes_);
      case ChildOutcome::REJECTED:
        throw InvalidInput(bytes_, std::min(header_.code, FaultCode::INTERNAL));
      case ChildOutcome::NO_MEMORY:
        throw InvalidInput(name + " takes more than " + std::to_string(limits_.memory >> 20) +
                           " MiB of memory");
      default:
        throw InvalidInput(name + " failed: " + bytes_);
    }
  }

 private:
  std::size_t wanted() const {
    return std::min<std::size_t>(piece_.size(), header_.size - bytes_.size());
  }
  void checkSize() {
    const std::size_t most =
        header_.outcome == ChildOutcome::RESULT ? limits_.most_bytes : LONGEST_ERROR + 3;  // "..."
    if (header_.size > most)
      throw InvalidInput(std::string(limits_.name) + " returns " + std::to_string(header_.size) +
                         " bytes, more than the " + std::to_string(most) + " allowed");
    bytes_.reserve(header_.size);
  }

  const ChildLimits& limits_;
  std::vector<char> piece_;
  ChildHeader header_;
  std::size_t at_{0};  // bytes of the header that have come
  std::string bytes_;
  bool closed_{false};
};

/// Counts the seconds of waiting. Those in which this process was stopped are left out: what the
/// child has sent meanwhile is still to be read.
class WaitingTime {
 public:
  double passed() {
    const Clock::time_point now = Clock::now();
    seconds_ += std::min(2.0 * LONGEST_WAIT, std::chrono::duration<double>(now - last_).count());
    last_ = now;
    return seconds_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_{Clock::now()};
  double seconds_{0.0};
};

/// Forks with all signals blocked: no handler of the program runs in the child.
pid_t startChild(const std::function<std::string()>& work, const ChildLimits& limits,
                 const Pipe& pipe) {
  const std::size_t present = addressSpace();
  const pid_t parent = ::getpid();
  sigset_t all, before;
  sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  const int error = errno;
  if (child == 0) {
    enterChild(limits, present, parent, pipe.reading(), pipe.writing());
    workAndExit(work, pipe.writing());
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (child > 0) return child;
  throw InvalidInput(
      std::string(limits.name) + " cannot be started: " + std::generic_category().message(error),
      FaultCode::NOT_AVAILABLE);
}

[[noreturn]] void rejectSlow(const ChildLimits& limits) {
  std::ostringstream text;
  text << limits.name << " takes more than " << limits.seconds << " s";
  throw InvalidInput(text.str());
}

/// Throws why a child has ended without a result.
[[noreturn]] void rejectEnd(const ChildLimits& limits, std::optional<int> status) {
  static const std::map<int, const char*> CRASHES{{SIGSEGV, "SIGSEGV"},
                                                  {SIGABRT, "SIGABRT"},
                                                  {SIGBUS, "SIGBUS"},
                                                  {SIGFPE, "SIGFPE"},
                                                  {SIGILL, "SIGILL"}};
  const std::string name = limits.name;
  if (!status || !WIFSIGNALED(*status)) throw InvalidInput(name + " ended without a result");
  const int signal = WTERMSIG(*status);
  if (signal == SIGXCPU) rejectSlow(limits);
  const auto crash = CRASHES.find(signal);
  if (crash != CRASHES.end()) throw InvalidInput(name + " crashed (" + crash->second + ")");
  throw InvalidInput(name + " was ended " +
                     (signal == SIGKILL ? std::string("(SIGKILL), perhaps for lack of memory")
                                        : "by signal " + std::to_string(signal)));
}

/// Waits until the child sends something or ends, or for a part of the time that is left [s].
void waitFor(const Pipe& pipe, bool closed, double left) {
  const int milliseconds = 1 + static_cast<int>(1000.0 * std::min(left, LONGEST_WAIT));
  pollfd ready{pipe.reading(), POLLIN, 0};
  if (closed)  // it would always be ready, and the child is about to end
    ::poll(nullptr, 0, 1);
  else
    ::poll(&ready, 1, milliseconds);
}

}  // namespace

std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits) {
  Pipe pipe(limits.name);
  ::fcntl(pipe.reading(), F_SETFL, O_NONBLOCK);
  Child child(startChild(work, limits, pipe));
  pipe.closeWriting();
  ChildMessage message(limits);
  WaitingTime time;
  while (!message.isComplete()) {
    const bool ended = child.hasEnded();  // asked first: then the pipe has all that there will be
    const bool received = message.receive(pipe.reading());
    if (ended && !received) rejectEnd(limits, child.status());
    const double left = limits.seconds - time.passed();
    if (left < 0.0) rejectSlow(limits);
    if (!received) waitFor(pipe, message.isClosed(), left);
  }
  return message.result();
}

}  // namespace vegetation_sim
