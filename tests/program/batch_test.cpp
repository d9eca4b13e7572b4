// Batches of many files, run as users run them.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

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
using test::runs_in_emulator;
using test::Statuses;
using test::Words;
using test::write_bytes;
using test::operator+;

TEST_F(BatchTest, ManyFilesBecomeTheBytesOfSingleRuns) {
  const RunResult result =
      run(Words{"smooth"} + inputs_ + Words{"--out-dir", "out/new", "--jobs", "2"} + options_);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& input : inputs_) {
    EXPECT_EQ(bytes("out/new/" + fs::path(input).filename().string()), single(input, options_));
    EXPECT_TRUE(contains(result.err, input + " -> out/new/")) << result.err;
  }
  EXPECT_TRUE(contains(result.err, "3 of 3 done")) << result.err;
  EXPECT_EQ(count("out/new"), 3U);
}

TEST_F(BatchTest, AFileThatFailsDoesNotKeepTheOthersFromBeingDone) {
  write_bytes(full("in/bad.off"), "OFF 3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n");
  const Words words =
      Words{"smooth", "in/bad.off"} + inputs_ + Words{"--out-dir", "out"} + options_;
  const RunResult result = run(words);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "in/bad.off -> out/bad.off (exit code 3): in/bad.off:4:3"))
      << result.err;
  EXPECT_EQ(count("out"), 3U);
  EXPECT_FALSE(exists("out/bad.off"));
  for (const std::string& input : inputs_) {
    EXPECT_EQ(bytes("out/" + fs::path(input).filename().string()), single(input, options_));
  }
  const RunResult quiet = run(words + Words{"--resume", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 1);
  EXPECT_TRUE(quiet.err.starts_with("ibmfair: error: [1/4] failed")) << quiet.err;
  EXPECT_EQ(std::count(quiet.err.begin(), quiet.err.end(), '\n'), 1) << quiet.err;
}

TEST_F(BatchTest, FailFastStartsNothingAfterAFailure) {
  write_bytes(full("in/bad.off"), "OFF\n");
  const Words words =
      Words{"smooth", path("a"), "in/bad.off", path("b"), path("c"), "--out-dir", "out"} + options_;
  const Statuses expected{
      {path("a"), "ok"}, {"in/bad.off", "failed"}, {path("b"), "not run"}, {path("c"), "not run"}};
  EXPECT_EQ(statuses(words + Words{"--keep-going", "--fail-fast"}, 1), expected);
  EXPECT_EQ(count("out"), 1U);
  // The last of the two decides.
  const Statuses all{
      {path("a"), "ok"}, {"in/bad.off", "failed"}, {path("b"), "ok"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words + Words{"--overwrite", "--fail-fast", "--keep-going"}, 1), all);
}

TEST_F(BatchTest, ShardsArePartsOfTheList) {
  const Words list = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  const auto lines = [&](const Words& more) {
    std::string text = run(list + Words{"--dry-run"} + more).out;
    Words found;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
      found.push_back(text.substr(0, end));
      text.erase(0, end + 1);
    }
    return found;
  };
  const Words all = lines({});
  ASSERT_EQ(all.size(), 3U);
  for (const int count : {1, 2, 3, 5}) {
    Words together;
    for (int i = 1; i <= count; ++i) {
      together = together + lines({"--shard", fmt::format("{}/{}", i, count)});
    }
    std::sort(together.begin(), together.end());
    EXPECT_EQ(together, all);
  }
  EXPECT_FALSE(exists("out"));

  for (const std::string part : {"1/2", "2/2"}) {
    EXPECT_EQ(run(list + Words{"--shard", part}).exit_code, 0);
  }
  EXPECT_TRUE(exists("out/.ibmfair-batch.journal.1-of-2"));
  EXPECT_TRUE(exists("out/.ibmfair-batch.journal.2-of-2"));
  const Statuses skipped{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses(list + Words{"--resume"}), skipped);
  for (const std::string bad : {"0/2", "3/2", "1", "1/0", "a/b", "1/2/3"}) {
    EXPECT_EQ(run(list + Words{"--shard", bad}).exit_code, 2) << bad;
  }
}

TEST_F(BatchTest, DryRunPrintsCommandsForAShell) {
  write_bytes(full("in/it's $1.off"), bytes(path("a")));
  const RunResult result = run({"smooth", "in/it's $1.off", path("b"), "--out-dir", "out", "--jobs",
                                "2", "--max-move", "2%", "--dry-run"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "ibmfair smooth 'in/it'\\''s $1.off' 'out/it'\\''s $1.off' --max-move=2%\n"
            "ibmfair smooth in/b.off out/b.off --max-move=2%\n");
  EXPECT_FALSE(exists("out"));
  // When a list is resumed, only the remaining items are listed.
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options_;
  EXPECT_EQ(run(words).exit_code, 0);
  fs::remove(full("out/b.off"));
  const RunResult left = run(words + Words{"--resume", "--dry-run"});
  EXPECT_TRUE(left.out.starts_with("ibmfair smooth in/b.off ")) << left.out;
  EXPECT_EQ(std::count(left.out.begin(), left.out.end(), '\n'), 1) << left.out;
}

TEST_F(BatchTest, ManyFilesAreCheckedBeforeAnythingRuns) {
  fs::create_directory(full("other"));
  write_bytes(full("other/a.off"), bytes(path("a")));
  const std::vector<std::pair<Words, std::string>> misuses{
      {{"smooth", path("a"), "other/a.off", "--out-dir", "out"}, "out/a.off"},
      {{"smooth", path("a"), path("a"), "--out-dir", "out"}, "out/a.off"},
      {{"smooth", path("a"), path("b"), "--out-dir", "in", "--overwrite"}, "in/a.off"},
      {{"smooth", path("a"), path("b"), "--out-dir", "out", "--report", "r.json"}, "r.json"},
      {{"smooth", path("a"), "--out-dir", "out", "--stesp", "2"}, "did you mean '--steps'"},
      {{"smooth", path("a"), "--out-dir", "out", "--steps", "2.5"}, "--steps"},
      {{"smooth", "--out-dir", "out"}, "IN"},
      {{"smooth", path("a"), "out.off", "--jobs", "2"}, "--out-dir"},
      {{"smooth", path("a"), path("b"), path("c")}, "--out-dir"},
      {{"smooth", path("a"), path("b"), path("c"), "--engine", "petsc"}, "one argument too many"},
      {{"smooth", path("a"), path("b"), "-ksp_type", "cg"}, "unknown option '-ksp_type'"},
      {{"smooth", path("a"), "--out-dir", "out", "--checkpoint", "c.off"}, "--checkpoint"},
      {{"smooth", path("a"), "--out-dir", "out", "--summary", "s.txt"}, "--summary"},
      {{"info", path("a"), "--out-dir", "out"}, "--out-dir"},
  };
  for (const auto& [words, message] : misuses) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(words, " ")));
    const RunResult result = run(words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_TRUE(contains(result.err, message)) << result.err;
    EXPECT_FALSE(exists("out"));
  }
  EXPECT_EQ(run({"smooth", path("a"), path("z"), "--out-dir", "out"}).exit_code, 3);
  EXPECT_FALSE(exists("out"));
}

TEST_F(BatchTest, TheSummaryHoldsEveryItemWithItsFigures) {
  write_bytes(full("in/bad.off"), "OFF 1 0 0\n\"a, b\"\n");
  const Words words = Words{"smooth", "in/bad.off"} + inputs_ + options_;
  const RunResult result =
      run(words + Words{"--out-dir", "out", "--json", "--summary", "s.csv", "--jobs", "0"});
  EXPECT_EQ(result.exit_code, 1);
  const json summary = json::parse(result.out);
  EXPECT_EQ(summary["command"], "batch");
  EXPECT_EQ(summary["counts"]["ok"], 3);
  EXPECT_EQ(summary["counts"]["failed"], 1);
  ASSERT_EQ(summary["items"].size(), 4U);
  EXPECT_EQ(summary["items"][0]["exit_code"], 3);
  EXPECT_TRUE(contains(summary["items"][0]["message"], "in/bad.off:2"));
  const json& first = summary["items"][1];
  EXPECT_EQ(first["input"], path("a"));
  EXPECT_EQ(first["output"], "out/a.off");
  EXPECT_EQ(first["status"], "ok");
  EXPECT_GT(first["seconds"], 0.0);
  EXPECT_GT(first["peak_megabytes"], 1.0);
  const json report =
      json::parse(run(Words{"smooth", path("a"), "again.off", "--json"} + options_).out);
  EXPECT_EQ(first["figures"]["after.energy"], report["after"]["energy"]);
  EXPECT_EQ(first["figures"]["status"], report["status"]);

  const std::string csv = bytes("s.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_TRUE(
      csv.starts_with("command,input,output,status,exit_code,seconds,peak_megabytes,message,"));
  EXPECT_TRUE(contains(csv, "\r\nsmooth,in/a.off,out/a.off,ok,0,")) << csv;
  EXPECT_TRUE(contains(csv, "after.energy"));
  EXPECT_TRUE(contains(csv, ",\"in/bad.off:2")) << csv;
  // A resumed run also reports the figures of the items that it skips.
  const RunResult resumed =
      run(words + Words{"--out-dir", "out", "--json", "--resume", "--summary", "s.csv"});
  EXPECT_EQ(json::parse(resumed.out)["items"][1]["figures"], first["figures"]);
  EXPECT_EQ(run(words + Words{"--out-dir", "new", "--summary", "s.csv"}).exit_code, 6);
  EXPECT_FALSE(exists("new"));
}

TEST_F(BatchTest, WantOfMemoryEndsOneItemOnly) {
  if (runs_in_emulator()) GTEST_SKIP() << "the emulator needs more address space than that";
#ifdef IBMFAIR_SANITIZED
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  if (!fs::exists("/usr/bin/prlimit")) {
    GTEST_SKIP() << "no prlimit";
  }
  write_bytes(full("jobs.json"),
              R"({"defaults": {"command": "make", "shape": "icosphere"}, "jobs": [
      {"output": "large.off", "options": {"subdivide": 9}}, {"output": "small.off"}]})");
  const RunResult result =
      run({"batch", "jobs.json", "--json"}, {.address_space = std::int64_t{3} << 26U});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const json items = json::parse(result.out)["items"];
  EXPECT_EQ(items[0]["exit_code"], 5);
  EXPECT_TRUE(contains(items[0]["message"], "memory"));
  EXPECT_EQ(items[1]["status"], "ok");
}

}  // namespace
}  // namespace ibmfair
