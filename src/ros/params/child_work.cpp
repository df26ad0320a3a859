// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/child_work.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <exception>
#include <fstream>
#include <new>

namespace vegetation_sim {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool LIMITS_MEMORY = false;  // a sanitizer maps terabytes
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool LIMITS_MEMORY = false;
#else
constexpr bool LIMITS_MEMORY = true;
#endif
#else
constexpr bool LIMITS_MEMORY = true;
#endif

constexpr long MOST_CLOSED = 65536;  // of open files, one by one

void lowerLimit(decltype(RLIMIT_AS) resource, rlim_t most) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, most);
  ::setrlimit(resource, &limit);
}

#ifndef SYS_close_range
#define SYS_close_range 436  // the headers of Debian 11 and Ubuntu 20.04 have no name for it
#endif

void closeOneByOne(int kept) {
  const int end = static_cast<int>(std::min(::sysconf(_SC_OPEN_MAX), MOST_CLOSED));
  for (int file = 3; file < end; ++file)
    if (file != kept) ::close(file);
}

void closeOthers(int kept) {
  if (kept > 3) ::syscall(SYS_close_range, 3U, static_cast<unsigned>(kept - 1), 0U);
  if (::syscall(SYS_close_range, static_cast<unsigned>(kept + 1), ~0U, 0U) == 0) return;
  closeOneByOne(kept);  // Linux before 5.9
}

void writeAll(int out, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(out, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

}  // namespace

std::size_t addressSpace() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

void enterChild(const ChildLimits& limits, std::size_t present, pid_t parent, int in, int out) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);
  for (int number = 1; number < NSIG; ++number) ::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::close(in);
  closeOthers(out);
  ::prctl(PR_SET_DUMPABLE, 0);  // programs that collect dumps do not heed RLIMIT_CORE
  lowerLimit(RLIMIT_CORE, 0);
  lowerLimit(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(limits.seconds)));
  if (LIMITS_MEMORY && present > 0) lowerLimit(RLIMIT_AS, present + limits.memory);
}

void workAndExit(const std::function<std::string()>& work, int out) noexcept {
  ChildHeader header;
  std::string bytes;
  try {
    bytes = work();
  } catch (const InvalidInput& error) {
    header.outcome = ChildOutcome::REJECTED;
    header.code = error.code();
    bytes = error.what();
  } catch (const std::bad_alloc&) {
    header.outcome = ChildOutcome::NO_MEMORY;
  } catch (const std::exception& error) {
    header.outcome = ChildOutcome::FAILED;
    bytes = shortened(error.what(), LONGEST_ERROR);
  } catch (...) {
    header.outcome = ChildOutcome::FAILED;
    bytes = "unknown exception";
  }
  header.size = bytes.size();
  writeAll(out, reinterpret_cast<const char*>(&header), sizeof header);
  writeAll(out, bytes.data(), bytes.size());
  ::_exit(0);
}

}  // namespace vegetation_sim
