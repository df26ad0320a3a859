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
  static std::vector<Nanoseconds> stampsOf(const std::vector<JournalRecord>& records) {
    std::vector<Nanoseconds> out;
    for (const JournalRecord& record : records) out.push_back(record.stamp);
    return out;
  }

  static constexpr std::uint64_t KEY = 77;
  fs::path folder_, file_;
};

TEST_F(EventJournalTest, ReturnsTheRecordsOfACheckpointWithTheirEvents) {
  EventJournal journal(file_);
  EXPECT_TRUE(journal.read(KEY).empty()) << "no file yet";
  journal.add({5, {}});
  EXPECT_FALSE(fs::exists(file_)) << "nothing is written before the first restart()";
  EXPECT_EQ(journal.size(), 0u);
  journal.restart(KEY);
  journal.add({0, {{"walk", ""}}});
  journal.add({10, {{"walk", ""}, {"wind", std::string("\0input", 6)}}});
  journal.add({20, {}});
  EXPECT_EQ(journal.size(), fs::file_size(file_));
  const std::vector<JournalRecord> all = EventJournal(file_).read(KEY);
  EXPECT_EQ(stampsOf(all), (std::vector<Nanoseconds>{0, 10, 20}));
  ASSERT_EQ(all[1].events.size(), 2u);
  EXPECT_EQ(all[1].events[1].message, "wind");
  EXPECT_EQ(all[1].events[1].input, std::string("\0input", 6));
  EXPECT_TRUE(journal.read(KEY + 1).empty()) << "it continues another checkpoint";
  journal.restart(KEY + 1);
  EXPECT_TRUE(journal.read(KEY + 1).empty());
}

// A process may be killed, or the disk full, within a write.
TEST_F(EventJournalTest, EndsBeforeTheFirstRecordThatIsNotComplete) {
  EventJournal journal(file_);
  journal.restart(KEY);
  const auto head = fs::file_size(file_);
  for (Nanoseconds stamp = 1; stamp <= 4; ++stamp) journal.add({stamp, {{"event", ""}}});
  const auto size = fs::file_size(file_), each = (size - head) / 4;
  ASSERT_EQ(head + 4 * each, size);
  for (std::uintmax_t cut = 0; cut < size; ++cut) {
    const fs::path part = folder_ / "part";
    fs::copy_file(file_, part, fs::copy_options::overwrite_existing);
    fs::resize_file(part, cut);
    EXPECT_EQ(EventJournal(part).read(KEY).size(), cut < head ? 0 : (cut - head) / each) << cut;
  }
  std::fstream altered(file_, std::ios::in | std::ios::out | std::ios::binary);
  altered.seekp(static_cast<std::streamoff>(head + each + 12));
  altered.put('?');
  altered.close();
  EXPECT_EQ(stampsOf(journal.read(KEY)), (std::vector<Nanoseconds>{1}));
}

}  // namespace
}  // namespace vegetation_sim

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
