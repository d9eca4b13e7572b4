// `batch --merge` gives one summary of a list whose parts were run separately.
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/batch_files.h"
#include "support/files.h"
#include "support/run_program.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::BatchTest;
using test::contains;
using test::RunResult;
using test::Statuses;
using test::Words;
using test::write_bytes;
using test::operator+;

/// A list in which one item fails, and the output of another item exists already as somebody else's
/// file.
class MergeTest : public BatchTest {
 protected:
  MergeTest() {
    write_bytes(full("in/bad.off"), "OFF 3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n");
    make("d", 4);
    list_ = Words{"smooth", path("a"), "in/bad.off", path("b"), path("c"), path("d")} +
            Words{"--out-dir", "out"} + options_;
    start_anew();
  }

  void start_anew() const {
    fs::remove_all(full("out"));
    fs::create_directory(full("out"));
    write_bytes(full("out/b.off"), "mine");
  }

  void run_parts(int count) const {
    for (int i = 1; i <= count; ++i) {
      const RunResult result = run(list_ + Words{"--shard", fmt::format("{}/{}", i, count)});
      EXPECT_LE(result.exit_code, 1) << result.err;
    }
  }

  /// A report without the values that differ from one run to the next.
  static json lasting(const std::string& text) {
    json report = json::parse(text);
    for (json& item : report.at("items")) {
      EXPECT_GE(item.at("seconds"), 0.0);
      item.erase("seconds");
      item.erase("peak_megabytes");
    }
    report.erase("seconds");
    report.erase("arguments");
    return report;
  }

  static std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

  Words list_;
};

TEST_F(MergeTest, ItIsTheSummaryOfOneRun) {
  const Words reports{"--summary", "s.csv", "--summary", "s.json"};
  const RunResult whole = run(list_ + Words{"--json", "--summary", "whole.csv"});
  EXPECT_EQ(whole.exit_code, 1) << whole.err;
  for (const int count : {1, 2, 3, 5, 8}) {
    SCOPED_TRACE(count);
    start_anew();
    run_parts(count);
    std::string csv, report;
    for (int again = 0; again < 2; ++again) {
      const RunResult merged = run(list_ + Words{"--merge", "--json"} + reports);
      EXPECT_EQ(merged.exit_code, 1) << merged.err;
      EXPECT_EQ(lasting(merged.out), lasting(whole.out));
      EXPECT_TRUE(contains(merged.err, "3 of 5 done")) << merged.err;
      EXPECT_TRUE(contains(merged.err, "in/bad.off:4:3")) << merged.err;
      EXPECT_EQ(first_line(bytes("s.csv")), first_line(bytes("whole.csv")));
      EXPECT_TRUE(again == 0 || (csv == bytes("s.csv") && report == bytes("s.json")));
      csv = bytes("s.csv");
      report = bytes("s.json");
    }
    EXPECT_EQ(bytes("out/b.off"), "mine");
  }
}

TEST_F(MergeTest, WhatHasNotBeenRunIsNotDone) {
  Statuses expected{{path("a"), "not run"},
                    {"in/bad.off", "not run"},
                    {path("b"), "not run"},
                    {path("c"), "not run"},
                    {path("d"), "not run"}};
  EXPECT_EQ(statuses(list_ + Words{"--merge"}, 1), expected);
  EXPECT_EQ(run(list_ + Words{"--shard", "2/2"}).exit_code, 1);
  expected["in/bad.off"] = "failed";
  expected[path("c")] = "ok";
  EXPECT_EQ(statuses(list_ + Words{"--merge"}, 1), expected);

  make("bad", 5);
  fs::remove(full("out/b.off"));
  expected["in/bad.off"] = "not run";
  EXPECT_EQ(statuses(list_ + Words{"--merge"}, 1), expected);
  EXPECT_EQ(run(list_ + Words{"--resume"}).exit_code, 0);
  for (auto& [input, status] : expected) {
    status = "ok";
  }
  EXPECT_EQ(statuses(list_ + Words{"--merge"}), expected);

  // The summary depends on the items as they are now.
  make("c", 77);
  fs::remove(full("out/d.off"));
  expected[path("c")] = expected[path("d")] = "not run";
  EXPECT_EQ(statuses(list_ + Words{"--merge"}, 1), expected);
  const json items = json::parse(run(list_ + Words{"--merge", "--json"}).out)["items"];
  EXPECT_TRUE(contains(items[3]["message"], "have changed")) << items[3];
  EXPECT_FALSE(exists("out/d.off"));
}

TEST_F(MergeTest, AnItemThatWasKilledIsBegunNotEnded) {
  run_parts(1);
  const std::string journal = full("out/.ibmfair-batch.journal");
  std::string text = test::read_bytes(journal);
  write_bytes(journal, text.substr(0, text.size() - 20));  // cuts off the end record of item d
  const json items = json::parse(run(list_ + Words{"--merge", "--json"}).out)["items"];
  EXPECT_EQ(items[4]["status"], "not run");
  EXPECT_EQ(items[4]["message"], "started, but not finished");
}

TEST_F(MergeTest, ItDoesNotGoWithWhatRunsOrSelects) {
  for (const Words& other : {Words{"--shard", "1/2"}, Words{"--resume"}, Words{"--dry-run"}}) {
    const RunResult result = run(list_ + Words{"--merge"} + other);
    EXPECT_EQ(result.exit_code, 2) << other.front();
    EXPECT_TRUE(contains(result.err, "--merge")) << result.err;
  }
}

}  // namespace
}  // namespace ibmfair
