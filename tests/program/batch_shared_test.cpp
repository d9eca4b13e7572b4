// One list of items is run by several processes at once, as on the nodes of a cluster.
#include <algorithm>
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

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

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
using test::RunOptions;
using test::RunResult;
using test::Statuses;
using test::Words;
using test::write_bytes;
using test::operator+;

constexpr std::chrono::minutes past_any_expiry{60};

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

class SharedBatchTest : public BatchTest {
 protected:
  SharedBatchTest() {
    for (const std::string name : {"d", "e", "f"}) {
      inputs_.push_back(path(name));
      make(name, static_cast<int>(inputs_.size()), 3);
    }
    for (const std::string& input : inputs_) {
      whole_["out/" + fs::path(input).filename().string()] = single(input, options_);
    }
    list_ = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
    shared_ = list_ + Words{"--shared"};
  }

  void TearDown() override { EXPECT_EQ(count(folder_, ".tmp"), 0U); }

  /// Runs all of these processes at once.
  std::vector<RunResult> run_together(const std::vector<Words>& processes) const {
    std::vector<std::future<RunResult>> running;
    running.reserve(processes.size());
    for (const Words& words : processes) {
      running.push_back(std::async(std::launch::async, [this, words] { return run(words); }));
    }
    std::vector<RunResult> results;
    for (auto& process : running) {
      results.push_back(process.get());
    }
    return results;
  }

  /// The number of times that each item was started, by the name of its output.
  std::map<std::string, int> starts() const {
    std::map<std::string, int> found;
    for (const auto& entry : fs::directory_iterator(full(folder_))) {
      if (entry.path().extension() != ".journal") {
        continue;
      }
      std::istringstream text(test::read_bytes(entry.path().string()));
      for (std::string line; std::getline(text, line);) {
        const json event = json::parse(line);
        found[event.at("key")] += event.at("event") == "start" ? 1 : 0;
      }
    }
    return found;
  }

  void expect_each_was_run_once() const {
    const std::map<std::string, int> found = starts();
    EXPECT_EQ(found.size(), whole_.size());
    for (const auto& [key, count] : found) {
      EXPECT_EQ(count, 1) << key;
    }
  }

  void expect_all_is_done() const {
    for (const auto& [output, bytes_of_single_run] : whole_) {
      EXPECT_EQ(bytes(output), bytes_of_single_run) << output;
    }
    EXPECT_EQ(count("out"), whole_.size());
    EXPECT_EQ(count("out", ".tmp"), 0U);
    EXPECT_EQ(count(folder_, ".claim"), 0U);
    EXPECT_EQ(run(list_ + Words{"--merge"}).exit_code, 0);
  }

  std::string only_claim() const {
    std::string found;
    for (const auto& entry : fs::directory_iterator(full(folder_))) {
      if (entry.path().extension() == ".claim") {
        EXPECT_EQ(found, "");
        found = entry.path().string();
      }
    }
    return found;
  }

  static void make_old(const std::string& file) {
    fs::last_write_time(file, fs::file_time_type::clock::now() - past_any_expiry);
  }

  static bool is_old(const std::string& file) {
    return fs::file_time_type::clock::now() - fs::last_write_time(file) > past_any_expiry / 2;
  }

  /// Changes a claim as if a process of another machine held it.
  static void make_foreign(const std::string& claim) {
    const auto date = fs::last_write_time(claim);
    std::string text = test::read_bytes(claim);
    const std::string name = "\"processes_of\":\"";
    text.insert(text.find(name) + name.size(), "elsewhere");
    write_bytes(claim, text);
    fs::last_write_time(claim, date);
  }

  /// Changes dates of files as if all processes that are at work had been dead for an hour.
  void make_stale() const {
    for (const std::string& folder : {std::string("out"), folder_}) {
      for (const auto& entry : fs::directory_iterator(full(folder))) {
        const fs::path extension = entry.path().extension();
        if (extension == ".claim" || extension == ".tmp") {
          make_old(entry.path().string());
        }
      }
    }
  }

  /// Options with which a process never finishes an item: it stops before it puts the file in
  /// place.
  RunOptions in_the_midst() const {
    test::Fault fault{"rename", 1, 1};
    fault.signal_number = SIGSTOP;
    fault.no_unnamed_files = true;
    return {.environment = test::environment_of(fault)};
  }

  bool is_in_the_midst() const {
    return has_written() && count(folder_, ".claim") == 1 &&
           contains(test::read_bytes(only_claim()), "\"process\"");
  }

  /// Whether a process has written a part of its output. A process begins by making and removing an
  /// empty file to see whether it may write; this empty file does not count.
  bool has_written() const {
    std::error_code gone;
    for (const auto& entry : fs::directory_iterator(full("out"), gone)) {
      if (entry.path().extension() == ".tmp") {
        const std::uintmax_t size = fs::file_size(entry.path(), gone);
        return !gone && size > 0;
      }
    }
    return false;
  }

  /// Leaves a list whose first item was running when the process was killed.
  void kill_one_in_the_midst() const {
    RunOptions options = in_the_midst();
    options.signal_number = SIGKILL;
    options.signal_when = [this] { return is_in_the_midst(); };
    EXPECT_EQ(run(shared_, options).exit_code, -SIGKILL);
  }

  Words list_, shared_;
  std::map<std::string, std::string> whole_;  // outputs of single runs, by name
  const std::string folder_ = "out/.ibmfair-batch.journal.shared";
};

TEST_F(SharedBatchTest, EachItemIsRunOnceHoweverManyRunTheList) {
  for (std::size_t count = 1; count <= 8; ++count) {
    SCOPED_TRACE(count);
    fs::remove_all(full("out"));
    for (const RunResult& result : run_together(std::vector<Words>(count, shared_))) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_TRUE(contains(result.err, "6 of 6 done")) << result.err;
    }
    expect_each_was_run_once();
    expect_all_is_done();
  }
}

TEST_F(SharedBatchTest, PartsMayOverlap) {
  const std::vector<RunResult> results =
      run_together({shared_ + Words{"--shard", "1/2"}, shared_ + Words{"--shard", "1/2"},
                    shared_ + Words{"--shard", "2/2", "--jobs", "2"},
                    shared_ + Words{"--shard", "2/3"}, shared_ + Words{"--jobs", "3"}});
  for (const RunResult& result : results) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  expect_each_was_run_once();
  expect_all_is_done();
}

TEST_F(SharedBatchTest, WhatFailsIsTriedOnceUnlessAskedForAgain) {
  write_bytes(full(path("b")), "OFF 3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n");
  whole_.erase("out/b.off");
  std::vector<RunResult> results = run_together(std::vector<Words>(4, shared_));
  results.push_back(run(shared_));  // a process that starts when all items are done
  for (const RunResult& result : results) {
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(contains(result.err, "in/b.off:4:3")) << result.err;
  }
  EXPECT_EQ(starts().at("b.off"), 1);
  EXPECT_EQ(run(shared_ + Words{"--resume"}).exit_code, 1);
  EXPECT_EQ(starts().at("b.off"), 2);
  // An item with changed input is a new task.
  make("b", 5);
  EXPECT_EQ(run(shared_).exit_code, 0);
  EXPECT_EQ(starts().at("b.off"), 3);
  EXPECT_EQ(starts().at("a.off"), 1);
}

TEST_F(SharedBatchTest, WhereAllIsDoneNothingIsDone) {
  run_together({shared_, shared_});
  const auto before = fs::last_write_time(full("out/a.off"));
  const std::map<std::string, int> starts_before = starts();
  const std::size_t journals = count(folder_, ".journal");
  for (const Words& words :
       {shared_, shared_ + Words{"--shard", "1/3", "--resume"}, list_ + Words{"--resume"}}) {
    const RunResult result = run(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_FALSE(contains(result.err, " ok ")) << result.err;
  }
  EXPECT_EQ(starts(), starts_before);
  EXPECT_EQ(count(folder_, ".journal"), journals);
  EXPECT_EQ(fs::last_write_time(full("out/a.off")), before);
}

TEST_F(SharedBatchTest, OthersMakeUpForOneThatIsKilled) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  for (const bool elsewhere : {true, false}) {
    fs::remove_all(full("out"));
    kill_one_in_the_midst();
    EXPECT_EQ(count("out"), 0U);
    EXPECT_EQ(count("out", ".tmp"), 1U);
    Words words = shared_;
    if (elsewhere) {
      // The claim of the killed process expires after a second; until then the others do the other
      // items.
      make_foreign(only_claim());
      // The killed process had another expiry time, and gave no sign of life after it had written
      // its file; writing may have taken longer than a second.
      fs::last_write_time(only_claim(), fs::file_time_type::clock::now());
      words = words + Words{"--claim-expiry", "1"};
    }
    for (const RunResult& result : run_together({words, words})) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    EXPECT_EQ(starts().at("a.off"), 2);
    expect_all_is_done();
  }
}

TEST_F(SharedBatchTest, OneOfManyTakesOverWhatADeadOneLeft) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  for (const std::size_t contenders : {2, 5, 8}) {
    SCOPED_TRACE(contenders);
    fs::remove_all(full("out"));
    kill_one_in_the_midst();
    if (contenders != 5) {
      make_foreign(only_claim());
    }
    make_stale();
    for (const RunResult& result : run_together(std::vector<Words>(contenders, shared_))) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    for (const auto& [key, count] : starts()) {
      EXPECT_EQ(count, key == "a.off" ? 2 : 1) << key;
    }
    expect_all_is_done();
  }
}

TEST_F(SharedBatchTest, ATakerThatDiesIsMadeUpForAsWell) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  kill_one_in_the_midst();
  make_foreign(only_claim());
  make_stale();
  RunOptions options = in_the_midst();
  options.signal_number = SIGKILL;
  options.signal_when = [this] {
    return count(folder_, ".claim") == 2 && count("out", ".tmp") == 1;
  };
  EXPECT_EQ(run(shared_, options).exit_code, -SIGKILL);
  make_stale();
  for (const RunResult& result : run_together(std::vector<Words>(3, shared_))) {
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  EXPECT_GE(starts().at("a.off"), 2);  // the second process may not have started item a
  expect_all_is_done();
}

TEST_F(SharedBatchTest, OneThatLivesKeepsWhatItHasAndOneThatSleptGivesWay) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  RunOptions options = in_the_midst();
  auto sleeper = std::async(std::launch::async, [this, options] {
    return run(shared_ + Words{"--claim-expiry", "0.05"}, options);
  });
  await([this] { return is_in_the_midst(); });
  const std::string claim = only_claim();
  const int process = json::parse(
      std::string(test::read_bytes(claim), 0, test::read_bytes(claim).find('\n')))["pid"];
  // The process gives signs of life, although the item itself sleeps.
  make_old(claim);
  await([&] { return !is_old(claim); });
  // Meanwhile another process does the other items and waits.
  RunOptions waiting;
  waiting.signal_number = SIGINT;
  waiting.signal_when = [this] { return count("out") + 1 == whole_.size(); };
  const RunResult patient = run(shared_, waiting);
  EXPECT_EQ(patient.exit_code, 128 + SIGINT);
  EXPECT_FALSE(contains(patient.err, "failed")) << patient.err;
  kill(process, SIGSTOP);
  await([&] {  // waits until all threads of the process have stopped
    make_old(claim);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return is_old(claim);
  });
  const RunResult other = run(shared_);
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(count("out"), whole_.size());
  kill(process, SIGCONT);
  const RunResult late = sleeper.get();
  EXPECT_EQ(late.exit_code, 0) << late.err;
  EXPECT_FALSE(contains(late.err, " ok ")) << late.err;
  EXPECT_EQ(starts().at("a.off"), 2);
  expect_all_is_done();
}

TEST_F(SharedBatchTest, WhatIsLeftOfAClaimToWhatIsDoneIsClearedAway) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  kill_one_in_the_midst();
  const std::string claim = only_claim();
  const std::string left = bytes(folder_ + "/" + fs::path(claim).filename().string());
  EXPECT_EQ(run(shared_).exit_code, 0);
  write_bytes(claim, left);  // as left by a process that is killed after it noted the end
  EXPECT_EQ(run(shared_).exit_code, 0);
  EXPECT_EQ(starts().at("a.off"), 2);
  expect_all_is_done();
}

TEST_F(SharedBatchTest, ASignalGivesTheItemsBack) {
  if (!test::faults_can_be_injected()) {
    GTEST_SKIP() << "AddressSanitizer is in the way";
  }
  RunOptions options = in_the_midst();
  options.signal_number = SIGTERM;
  options.signal_when = [this] { return is_in_the_midst(); };
  EXPECT_EQ(run(shared_, options).exit_code, 128 + SIGTERM);
  EXPECT_EQ(count(folder_, ".claim"), 0U);
  EXPECT_EQ(run(shared_).exit_code, 0);
  expect_all_is_done();
}

TEST_F(SharedBatchTest, WhoeverIsInTheWayIsSaidToBe) {
  write_bytes(full("journal.shared"), "mine");
  const RunResult no_folder = run(shared_ + Words{"--journal", "journal"});
  EXPECT_EQ(no_folder.exit_code, 6);
  EXPECT_TRUE(contains(no_folder.err, "journal.shared")) << no_folder.err;
  EXPECT_EQ(bytes("journal.shared"), "mine");

  EXPECT_EQ(run(shared_ + Words{"--claim-expiry", "0"}).exit_code, 2);
  EXPECT_EQ(run(list_ + Words{"--claim-expiry", "9"}).exit_code, 2);
  EXPECT_EQ(run(shared_ + Words{"--merge"}).exit_code, 2);
  EXPECT_FALSE(exists("out"));

  // Other things that somebody has put at the names of claims are neither followed nor waited for.
  if (!test::faults_can_be_injected()) {
    return;
  }
  kill_one_in_the_midst();
  const std::string claim = only_claim();
  for (const auto& plant : std::vector<std::function<void()>>{
           [&] { fs::create_symlink(full(path("a")), claim); },
           [&] { mkfifo(claim.c_str(), 0600); }, [&] { fs::create_directory(claim); }}) {
    fs::remove(claim);
    plant();
    const RunResult result = run(shared_);
    EXPECT_EQ(result.exit_code, 6);
    EXPECT_TRUE(contains(result.err, ".claim: cannot be used")) << result.err;
  }
  EXPECT_EQ(fs::file_size(full(path("a"))), bytes(path("a")).size());
}

}  // namespace
}  // namespace ibmfair
