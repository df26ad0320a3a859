// Copyright 2026 vegetation_sim developers
// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/snapshots/event_journal.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace vegetation_sim {
namespace {

namespace fs = std::filesystem;

class EventJournalTest : public testing::Test {
 protected:
  EventJournalTest() {
    std::string folder = (fs::temp_directory_path() / "journal_XXXXXX").string();
    folder_ = ::mkdtemp(folder.data());
    file_ = folder_ / "node.journal";
  }
  ~EventJournalTest() override { fs::remove_all(folder_); }
  static std::vector<Nanoseconds> stampsOf(const std::vector<JournalTick>& ticks) {
    std::vector<Nanoseconds> out;
    for (const JournalTick& tick : ticks) out.push_back(tick.stamp);
    return out;
  }

  fs::path folder_, file_;
};

TEST_F(EventJournalTest, ReturnsTheTicksAfterAStampWithTheirEvents) {
  EventJournal journal(file_);
  EXPECT_TRUE(journal.read(0).empty()) << "no file yet";
  journal.add({5, {}});
  EXPECT_FALSE(fs::exists(file_)) << "nothing is written before the first restart()";
  journal.restart();
  journal.add({10, {{"walk", ""}, {"wind", std::string("\0input", 6)}}});
  journal.add({20, {}});
  journal.add({30, {{"stop", ""}}});
  EXPECT_EQ(stampsOf(journal.read(10)), (std::vector<Nanoseconds>{20, 30}));
  const std::vector<JournalTick> all = EventJournal(file_).read(0);
  ASSERT_EQ(all.size(), 3u);
  ASSERT_EQ(all[0].events.size(), 2u);
  EXPECT_EQ(all[0].events[1].message, "wind");
  EXPECT_EQ(all[0].events[1].input, std::string("\0input", 6));
  journal.restart();
  EXPECT_TRUE(journal.read(0).empty());
}

// A process may be killed, or the disk full, within a write.
TEST_F(EventJournalTest, EndsBeforeTheFirstTickThatIsNotComplete) {
  EventJournal journal(file_);
  journal.restart();
  for (Nanoseconds stamp = 1; stamp <= 4; ++stamp) journal.add({stamp, {{"event", ""}}});
  const auto size = fs::file_size(file_);
  ASSERT_EQ(size % 4, 0u);
  for (std::uintmax_t cut = 0; cut < size; ++cut) {
    const fs::path part = folder_ / "part";
    fs::copy_file(file_, part, fs::copy_options::overwrite_existing);
    fs::resize_file(part, cut);
    EXPECT_EQ(EventJournal(part).read(0).size(), cut / (size / 4)) << cut;
  }
  std::fstream altered(file_, std::ios::in | std::ios::out | std::ios::binary);
  altered.seekp(static_cast<std::streamoff>(size / 4 + 12));
  altered.put('?');
  altered.close();
  EXPECT_EQ(stampsOf(journal.read(0)), (std::vector<Nanoseconds>{1}));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
