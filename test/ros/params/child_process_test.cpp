// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/params/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/error_text.h"
#include "sanitized.h"

namespace vegetation_sim {
namespace {

constexpr ChildLimits WORKER{"the worker", 60.0, std::size_t{512} << 20, std::size_t{64} << 20};

std::string endlessWork() {
  for (volatile unsigned i = 0;; i = i + 1) {
  }
}

std::string errorOfWork(const std::function<std::string()>& work,
                        const ChildLimits& limits = WORKER) {
  return errorOf([&] { runInChild(work, limits); });
}

std::size_t openFiles() {
  const std::filesystem::directory_iterator files("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

TEST(ChildProcess, ReturnsTheBytesOfItsWork) {
  std::string sent(std::size_t{8} << 20, '\0');
  for (std::size_t i = 0; i < sent.size(); ++i) sent[i] = static_cast<char>(i * i >> 7);
  EXPECT_TRUE(runInChild([&] { return sent; }, WORKER) == sent);
  EXPECT_EQ(runInChild([] { return std::string(); }, WORKER), "");
}

TEST(ChildProcess, ItsWorkChangesNothingHere) {
  int calls = 0;
  const std::string process = runInChild(
      [&] {
        ++calls;
        return std::to_string(::getpid());
      },
      WORKER);
  EXPECT_NE(process, std::to_string(::getpid()));
  EXPECT_EQ(calls, 0);
}

TEST(ChildProcess, RejectionsKeepTheirTextAndCode) {
  try {
    runInChild([]() -> std::string { throw InvalidInput("x = 3", FaultCode::NO_ROOM); }, WORKER);
    ADD_FAILURE() << "is not rejected";
  } catch (const InvalidInput& error) {
    EXPECT_EQ(std::string(error.what()), "x = 3");
    EXPECT_EQ(error.code(), FaultCode::NO_ROOM);
  }
  const std::string longest(LONGEST_ERROR + 100, 'x');
  EXPECT_EQ(errorOfWork([&]() -> std::string { throw InvalidInput(longest); }),
            InvalidInput(longest).what());
}

TEST(ChildProcess, OtherExceptionsAreRejections) {
  EXPECT_EQ(errorOfWork([]() -> std::string { throw std::runtime_error("odd"); }),
            "the worker failed: odd");
  EXPECT_EQ(errorOfWork([]() -> std::string { throw 1; }), "the worker failed: unknown exception");
}

TEST(ChildProcess, CrashesAreNamed) {
  EXPECT_EQ(errorOfWork([]() -> std::string { std::abort(); }), "the worker crashed (SIGABRT)");
  for (const auto& [signal, text] : {std::pair{SIGSEGV, "crashed (SIGSEGV)"},
                                     {SIGTERM, "was ended by signal 15"},
                                     {SIGKILL, "was ended (SIGKILL), perhaps for lack of memory"}})
    EXPECT_EQ(errorOfWork([number = signal] {
                std::raise(number);
                return std::string();
              }),
              std::string("the worker ") + text);
  EXPECT_EQ(errorOfWork([]() -> std::string { std::_Exit(0); }),
            "the worker ended without a result");
}

TEST(ChildProcess, LoopsAndSleepEndAtTheLimit) {
  ChildLimits limits = WORKER;
  limits.seconds = 0.2;
  EXPECT_EQ(errorOfWork(endlessWork, limits), "the worker takes more than 0.2 s");
  EXPECT_EQ(errorOfWork(
                [] {
                  ::pause();
                  return std::string();
                },
                limits),
            "the worker takes more than 0.2 s");
}

TEST(ChildProcess, MemoryEndsAtTheLimit) {
  if (SANITIZED) return;  // a sanitizer needs the address space
  std::vector<std::string> all;
  EXPECT_EQ(errorOfWork([&]() -> std::string {
              for (;;) all.emplace_back(std::size_t{32} << 20, 'x');
            }),
            "the worker takes more than 512 MiB of memory");
  EXPECT_TRUE(all.empty());
}

TEST(ChildProcess, ResultsEndAtTheLimit) {
  ChildLimits limits = WORKER;
  limits.most_bytes = 1000;
  EXPECT_EQ(runInChild([] { return std::string(1000, 'x'); }, limits).size(), 1000U);
  EXPECT_EQ(errorOfWork([] { return std::string(1001, 'x'); }, limits),
            "the worker returns 1001 bytes, more than the 1000 allowed");
}

TEST(ChildProcess, SeveralRunAtOnce) {
  const auto run = [](char letter) {
    const std::string sent(300000, letter);
    for (int i = 0; i < 20; ++i) {
      EXPECT_TRUE(runInChild([&] { return sent; }, WORKER) == sent);
      EXPECT_EQ(errorOfWork([]() -> std::string { std::abort(); }), "the worker crashed (SIGABRT)");
    }
  };
  std::thread other(run, 'a');
  run('b');
  other.join();
}

TEST(ChildProcess, LeavesNeitherFilesNorZombies) {
  const std::size_t before = openFiles();
  ChildLimits limits = WORKER;
  limits.seconds = 0.05;
  limits.most_bytes = 10;
  errorOfWork(endlessWork, limits);
  errorOfWork([]() -> std::string { std::abort(); }, limits);
  errorOfWork([] { return std::string(1000000, 'x'); }, limits);
  errorOfWork([] { return std::string(); }, limits);
  EXPECT_EQ(openFiles(), before);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

// A program that ignores SIGCHLD does not learn how its children end.
TEST(ChildProcess, RunsInProgramsThatIgnoreChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(runInChild([] { return std::string("result"); }, WORKER), "result");
  EXPECT_EQ(errorOfWork([]() -> std::string { std::abort(); }),
            "the worker ended without a result");
  EXPECT_EQ(std::signal(SIGCHLD, before), SIG_IGN);
}

}  // namespace
}  // namespace vegetation_sim
