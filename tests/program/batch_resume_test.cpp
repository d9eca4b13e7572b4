// Batches that are interrupted, resumed and run again.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "support/batch_files.h"
#include "support/files.h"
#include "support/run_program.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::BatchTest;
using test::contains;
using test::RunOptions;
using test::RunResult;
using test::Statuses;
using test::Words;
using test::write_bytes;
using test::operator+;

TEST_F(BatchTest, ResumeRedoesExactlyWhatHasChanged) {
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out", "--resume"};
  const auto expect = [&](const Words& more, const std::string& a, const std::string& b,
                          const std::string& c) {
    const Statuses expected{{path("a"), a}, {path("b"), b}, {path("c"), c}};
    EXPECT_EQ(statuses(words + more), expected);
    for (const std::string& input : inputs_) {
      EXPECT_EQ(bytes("out/" + fs::path(input).filename().string()), single(input, more));
    }
  };
  expect(options_, "ok", "ok", "ok");
  expect(options_, "skipped", "skipped", "skipped");
  expect(options_ + Words{"--threads", "2"}, "skipped", "skipped", "skipped");
  fs::remove(full("out/a.off"));
  expect(options_, "ok", "skipped", "skipped");
  make("b", 77);
  expect(options_, "skipped", "ok", "skipped");
  write_bytes(full("out/c.off"), "somebody else's\n");
  expect(options_, "skipped", "skipped", "ok");
  expect(options_ + Words{"--no-mass"}, "ok", "ok", "ok");
  expect(options_ + Words{"--no-mass"}, "skipped", "skipped", "skipped");
  // A new date alone does not make an item run again, nor does an option with its default value.
  fs::last_write_time(full(path("a")), fs::file_time_type::clock::now());
  expect(options_ + Words{"--no-mass", "--metric", "mass"}, "skipped", "skipped", "skipped");
  // A file of the same size and date, but with other content, makes the item run again.
  const auto date = fs::last_write_time(full(path("a")));
  std::string text = bytes(path("a"));
  std::swap(text[text.find("0.")], text[text.find("0.") + 2]);
  write_bytes(full(path("a")), text);
  fs::last_write_time(full(path("a")), date);
  const RunResult changed = run(words + options_ + Words{"--no-mass", "--json"});
  EXPECT_TRUE(contains(changed.err, "[1/3] ok") || contains(changed.err, "[1/3] failed"))
      << changed.err;
  EXPECT_TRUE(contains(changed.err, "[2/3] skipped")) << changed.err;
}

TEST_F(BatchTest, WhatTheBatchHasNotMadeIsNeverReplacedUnasked) {
  fs::create_directory(full("out"));
  write_bytes(full("out/b.off"), "mine");
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  const Statuses expected{{path("a"), "ok"}, {path("b"), "failed"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words, 1), expected);
  const Statuses again{{path("a"), "skipped"}, {path("b"), "failed"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}, 1), again);
  EXPECT_EQ(bytes("out/b.off"), "mine");
  const Statuses without{{path("a"), "failed"}, {path("b"), "failed"}, {path("c"), "failed"}};
  EXPECT_EQ(statuses(words, 1), without);
  const Statuses asked{{path("a"), "ok"}, {path("b"), "ok"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words + Words{"--overwrite"}), asked);
  EXPECT_EQ(bytes("out/b.off"), single(path("b"), options_));
}

TEST_F(BatchTest, ResumeSaysWhichRecordKnowsNothingOfAFile) {
  // --out-dir and a job file keep separate records.
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"};
  ASSERT_EQ(run(words + options_).exit_code, 0);
  const RunResult jobs = run(words + options_ + Words{"--dump-config"});
  ASSERT_EQ(jobs.exit_code, 0) << jobs.err;
  write_bytes(full("jobs.json"), jobs.out);
  const RunResult result = run({"batch", "jobs.json", "--resume"});
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "jobs.json.journal does not record")) << result.err;
}

TEST_F(BatchTest, AJournalsHalfWrittenLastLineIsIgnored) {
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  EXPECT_EQ(run(words).exit_code, 0);
  const std::string journal = full("out/.ibmfair-batch.journal");
  const std::string text = test::read_bytes(journal);
  ASSERT_TRUE(text.ends_with("}\n"));
  write_bytes(journal, text.substr(0, text.size() - 20));  // cuts off the end record of item c
  const Statuses expected{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}), expected);
  const Statuses all{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}), all);
}

/// A batch of files large enough that a signal can reach it in the middle of its work.
class InterruptedBatchTest : public BatchTest {
 protected:
  InterruptedBatchTest() {
    for (int i = 0; i < 8; ++i) {
      many_.push_back(path(fmt::format("m{}", i)));
      make(fmt::format("m{}", i), i, 5);
      whole_["out/" + fs::path(many_.back()).filename().string()] = single(many_.back(), {});
    }
    words_ = Words{"smooth"} + many_ + Words{"--jobs", "2", "--out-dir", "out"};
  }

  /// Stops the batch once more files are written than processes run at a time: some items, but not
  /// all, are done.
  RunResult stopped_by(int signal_number) {
    RunOptions options;
    options.signal_number = signal_number;
    options.signal_when = [this] { return count("out") >= 3; };
    return run(words_, options);
  }

  void expect_only_whole_files() {
    for (const auto& [output, whole] : whole_) {
      if (exists(output)) {
        EXPECT_EQ(bytes(output), whole) << output;
      }
    }
    EXPECT_GE(count("out"), 3U);
  }

  void expect_resume_finishes() {
    const Statuses found = statuses(words_ + Words{"--resume"});
    EXPECT_GE(std::count_if(found.begin(), found.end(),
                            [](const auto& item) { return item.second == "skipped"; }),
              1);
    EXPECT_EQ(count("out"), many_.size());
    EXPECT_EQ(count("out", ".tmp"), 0);
    expect_only_whole_files();
  }

  Words many_;
  Words words_;
  std::map<std::string, std::string> whole_;  // outputs of single runs, by name
};

TEST_F(InterruptedBatchTest, KilledItLosesNothingAndResumes) {
  EXPECT_EQ(stopped_by(SIGKILL).exit_code, -SIGKILL);
  // The processes of the batch end with it: no more files appear.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::size_t left = count("out");
  EXPECT_LT(left, many_.size());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(count("out"), left);
  expect_only_whole_files();
  expect_resume_finishes();
}

TEST_F(InterruptedBatchTest, ASignalEndsItInGoodOrder) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    fs::remove_all(full("out"));
    const RunResult result = stopped_by(signal_number);
    EXPECT_EQ(result.exit_code, 128 + signal_number) << result.err;
    EXPECT_TRUE(contains(result.err, "interrupted")) << result.err;
    EXPECT_LT(count("out"), many_.size());
    EXPECT_EQ(count("out", ".tmp"), 0);
    expect_only_whole_files();
  }
  expect_resume_finishes();
}

TEST_F(BatchTest, ResumeClearsAwayWhatDeadProcessesLeft) {
  const pid_t dead = fork();
  if (dead == 0) {
    _exit(0);
  }
  waitpid(dead, nullptr, 0);
  fs::create_directory(full("out"));
  const std::string stale = fmt::format("out/.ibmfair-{}-0.tmp", dead);
  const std::string live = fmt::format("out/.ibmfair-{}-0.tmp", getpid());
  const std::string other = "out/.ibmfair-mine.tmp";
  for (const std::string& name : {stale, live, other}) {
    write_bytes(full(name), "part");
  }
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  EXPECT_EQ(run(words).exit_code, 0);
  EXPECT_TRUE(exists(stale));
  // The other parts of a list may still be at work on other machines.
  EXPECT_EQ(run(words + Words{"--resume", "--shard", "1/2"}).exit_code, 0);
  EXPECT_TRUE(exists(stale));
  EXPECT_EQ(run(words + Words{"--resume"}).exit_code, 0);
  EXPECT_FALSE(exists(stale));
  EXPECT_TRUE(exists(live));
  EXPECT_TRUE(exists(other));
}

}  // namespace
}  // namespace ibmfair
