// Only one run at a time records in a journal.
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <functional>
#include <future>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include "support/batch_files.h"
#include "support/faults.h"
#include "support/files.h"
#include "support/run_program.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::BatchTest;
using test::contains;
using test::RunResult;
using test::Words;
using test::operator+;

constexpr int usage = 2;  // exit code

/// Waits for a condition that must come true sooner or later.
void await(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + test::patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) {
      throw std::runtime_error("waited in vain");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Starts runs and stops their process (SIGSTOP) once it has started an item, so that the run is
/// certainly going on while the test does something else.
class BatchLockTest : public BatchTest {
 protected:
  struct Suspended {
    std::future<RunResult> result;
    pid_t process = 0;
  };

  BatchLockTest() {
    for (const std::string name : {"d", "e", "f"}) {
      inputs_.push_back(path(name));
      make(name, static_cast<int>(inputs_.size()), 3);
    }
    for (const std::string& input : inputs_) {
      whole_["out/" + fs::path(input).filename().string()] = single(input, options_);
    }
    list_ = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  }

  /// The lines of a journal that are complete.
  std::vector<json> lines_of(const std::string& journal) const {
    std::vector<json> lines;
    std::istringstream text(exists(journal) ? bytes(journal) : "");
    for (std::string line; std::getline(text, line) && !text.eof();) {
      lines.push_back(json::parse(line));
    }
    return lines;
  }

  std::size_t count_events(const std::string& event, const std::string& journal) const {
    std::size_t found = 0;
    for (const json& line : lines_of(journal)) {
      found += line.at("event") == event ? 1 : 0;
    }
    return found;
  }

  /// Starts a run of `items` items. If the run is so quick that it starts its last item before it
  /// is suspended, everything begins anew.
  Suspended start_and_suspend(const Words& words, const std::string& journal,
                              std::size_t items) const {
    while (true) {
      Suspended run{
          std::async(std::launch::async, [this, words] { return BatchTest::run(words); })};
      await([&] { return count_events("start", journal) > 0; });
      run.process = lines_of(journal).front().at("process");
      kill(run.process, SIGSTOP);
      if (count_events("start", journal) < items) {
        return run;
      }
      kill(run.process, SIGCONT);
      run.result.get();
      fs::remove_all(full("out"));
    }
  }

  void expect_all_is_done() const {
    for (const auto& [output, bytes_of_single_run] : whole_) {
      EXPECT_EQ(bytes(output), bytes_of_single_run) << output;
    }
    EXPECT_EQ(count("out"), whole_.size());
    EXPECT_EQ(count("out", ".tmp"), 0U);
    EXPECT_EQ(run(list_ + Words{"--merge"}).exit_code, 0);
  }

  Words list_;
  std::map<std::string, std::string> whole_;  // outputs of single runs, by name
  const std::string journal_ = "out/.ibmfair-batch.journal";
  const std::string journal_of_first_ = journal_ + ".1-of-2";
};

TEST_F(BatchLockTest, ASecondRunIsRefusedAndToldOfTheFirst) {
  Suspended first = start_and_suspend(list_, journal_, inputs_.size());
  for (const Words& more : {Words{}, Words{"--resume"}, Words{"--overwrite"}}) {
    const RunResult second = run(list_ + more);
    EXPECT_EQ(second.exit_code, usage);
    for (const std::string& part :
         {journal_ + ": ", fmt::format("process {} on {}", first.process, host_name()),
          std::string("since 2"), std::string("--resume"), std::string("--journal")}) {
      EXPECT_TRUE(contains(second.err, part)) << part << " in " << second.err;
    }
    EXPECT_EQ(second.out, "");
  }
  EXPECT_EQ(count_events("run", journal_), 1U);
  kill(first.process, SIGCONT);
  EXPECT_EQ(first.result.get().exit_code, 0);
  EXPECT_EQ(count_events("start", journal_), inputs_.size());
  expect_all_is_done();
}

TEST_F(BatchLockTest, WhatOnlyReadsMayRunBeside) {
  Suspended first = start_and_suspend(list_, journal_, inputs_.size());
  const std::string before = bytes(journal_);
  const RunResult merged = run(list_ + Words{"--merge", "--json"});
  EXPECT_EQ(merged.exit_code, 1) << merged.err;
  EXPECT_EQ(json::parse(merged.out).at("items").size(), inputs_.size());
  for (const Words& more :
       {Words{"--dry-run"}, Words{"--dry-run", "--resume"}, Words{"--dump-config"}}) {
    const RunResult other = run(list_ + more);
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_TRUE(contains(other.out, "f.off")) << other.out;
  }
  EXPECT_EQ(bytes(journal_), before);
  kill(first.process, SIGCONT);
  EXPECT_EQ(first.result.get().exit_code, 0);
  expect_all_is_done();
}

TEST_F(BatchLockTest, DifferentPartsRunAtTheSameTime) {
  Suspended first = start_and_suspend(list_ + Words{"--shard", "1/2"}, journal_of_first_, 3);
  EXPECT_EQ(run(list_ + Words{"--shard", "1/2", "--resume"}).exit_code, usage);
  EXPECT_EQ(run(list_ + Words{"--shard", "2/2", "--resume"}).exit_code, 0);
  kill(first.process, SIGCONT);
  EXPECT_EQ(first.result.get().exit_code, 0);
  EXPECT_EQ(count_events("start", journal_of_first_), 3U);
  EXPECT_EQ(count_events("start", journal_ + ".2-of-2"), 3U);
  expect_all_is_done();
}

TEST_F(BatchLockTest, AfterKillTheNextRunTakesOver) {
  const Words part = list_ + Words{"--shard", "1/2", "--resume"};
  Suspended first = start_and_suspend(part, journal_of_first_, 3);
  kill(first.process, SIGKILL);
  EXPECT_EQ(first.result.get().exit_code, -SIGKILL);
  const std::size_t done = count_events("end", journal_of_first_);
  const std::size_t started = count_events("start", journal_of_first_);
  RunResult next = run(part);
  // A job that was about to start when its batch was killed holds the lock until it has started.
  for (int tries = 0; next.exit_code == usage && tries < 100; ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    next = run(part);
  }
  EXPECT_EQ(next.exit_code, 0) << next.err;
  EXPECT_EQ(count_events("start", journal_of_first_), started + 3 - done);
  EXPECT_EQ(run(list_ + Words{"--shard", "2/2"}).exit_code, 0);
  expect_all_is_done();
}

TEST_F(BatchLockTest, OfManyRunsAtOnceNoneRepeatsWhatAnotherHasDone) {
  for (int round = 0; round < 3; ++round) {
    fs::remove_all(full("out"));
    std::vector<std::future<RunResult>> running;
    running.reserve(8);
    for (int i = 0; i < 8; ++i) {
      running.push_back(std::async(std::launch::async, [this, i] {
        // Some start when the first one is about to end.
        std::this_thread::sleep_for(std::chrono::milliseconds(i * 20));
        return run(list_ + Words{"--resume"});
      }));
    }
    std::size_t done = 0;
    for (auto& process : running) {
      const RunResult result = process.get();
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == usage) << result.err;
      done += result.exit_code == 0 ? 1 : 0;
    }
    EXPECT_GE(done, 1U);
    EXPECT_EQ(count_events("run", journal_), done);
    EXPECT_EQ(count_events("start", journal_), inputs_.size());
    expect_all_is_done();
  }
}

TEST_F(BatchLockTest, WhatAnotherRunDoesJustBeforeTheLockIsKnown) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  test::Fault fault{"flock", 1, 1};
  fault.signal_number = SIGSTOP;
  test::RunOptions options{.environment = test::environment_of(fault)};
  options.signal_number = SIGCONT;
  options.signal_when = [this] {
    return exists(journal_) && run(list_ + Words{"--resume"}).exit_code == 0;
  };
  const RunResult late = run(list_ + Words{"--resume"}, options);
  EXPECT_EQ(late.exit_code, 0) << late.err;
  EXPECT_EQ(count_events("run", journal_), 2U);
  EXPECT_EQ(count_events("start", journal_), inputs_.size());
  expect_all_is_done();
}

TEST_F(BatchLockTest, AJournalThatAnotherProgramLocksIsNotWritten) {
  test::write_bytes(full("journal"), "");
  const int fd = open(full("journal").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(fd, LOCK_EX), 0);
  const RunResult refused = run(list_ + Words{"--journal", "journal"});
  EXPECT_EQ(refused.exit_code, usage);
  EXPECT_TRUE(contains(refused.err, "its process is not known")) << refused.err;
  EXPECT_EQ(bytes("journal"), "");
  EXPECT_EQ(count("out"), 0U);
  close(fd);
  EXPECT_EQ(run(list_ + Words{"--journal", "journal"}).exit_code, 0);
}

TEST_F(BatchLockTest, OddLinesInTheJournalDoNotHideTheRun) {
  const std::string odd =
      "{\"event\":\"run\",\"host\":\"\\u001b[31mred\",\"process\":1,\"time\":1}\n"
      "{\"event\":\"run\",\"host\":7,\"process\":\"x\"}\n{\"event\":\"run\"}\n[]\n{\n"
      "{\"event\":\"run\",\"host\":\"far\",\"process\":2,\"time\":9223372036854775807}\n";
  test::write_bytes(full("journal"), odd);
  const int fd = open(full("journal").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(fd, LOCK_EX), 0);
  const RunResult refused = run(list_ + Words{"--journal", "journal"});
  EXPECT_EQ(refused.exit_code, usage);
  EXPECT_TRUE(contains(refused.err, "process 1 on \\x1b[31mred, since 1970-01-01 00:00:01 UTC"))
      << refused.err;
  close(fd);
}

TEST_F(BatchLockTest, WithoutLocksARunWarnsAndWorks) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  test::Fault fault{"flock", 1, 1};
  fault.error = ENOLCK;
  const RunResult result = run(list_, {.environment = test::environment_of(fault)});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(contains(result.err, journal_ + ": the file system cannot lock")) << result.err;
  expect_all_is_done();
}

}  // namespace
}  // namespace ibmfair
