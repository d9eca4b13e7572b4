// Many files at once, run as users run them.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::read_bytes;
using test::run_program;
using test::RunOptions;
using test::RunResult;
using test::write_bytes;

using Words = std::vector<std::string>;
using Statuses = std::map<std::string, std::string>;  // by input, or by output where there is none

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder with meshes `in/a.off`, `in/b.off` and `in/c.off`, in which the program is run.
class BatchTest : public testing::Test {
 protected:
  BatchTest() {
    fs::create_directory(directory_ / "in");
    for (const std::string name : {"a", "b", "c"}) {
      make(name, static_cast<int>(1 + inputs_.size()));
      inputs_.push_back(path(name));
    }
  }

  static std::string path(const std::string& name) { return "in/" + name + ".off"; }
  std::string full(const std::string& name) const { return directory_ / name; }
  bool exists(const std::string& name) const { return fs::exists(full(name)); }
  std::string bytes(const std::string& name) const { return read_bytes(full(name)); }

  RunResult run(const Words& arguments, RunOptions options = {}) const {
    options.directory = directory_.path().string();
    return run_program(arguments, options);
  }

  void make(const std::string& name, int seed, const std::string& subdivide = "2") const {
    const RunResult result = run({"make", "icosphere", path(name), "--noise", "0.1", "--overwrite",
                                  "--seed", std::to_string(seed), "--subdivide", subdivide});
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }

  /// What one run of the command makes of one input.
  std::string single(const std::string& input, const Words& options) const {
    const RunResult result = run(
        Words{"smooth", input, "-", "--format", fs::path(input).extension().string().substr(1)} +
        options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }

  /// Runs a batch that must end with this code, and tells what became of every item.
  Statuses statuses(const Words& arguments, int exit_code = 0) const {
    const RunResult result = run(arguments + Words{"--json"});
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    Statuses found;
    const json summary = json::parse(result.out);
    for (const json& item : summary.at("items")) {
      const std::string input = item.at("input");
      found[input.empty() ? item.at("output").get<std::string>() : input] = item.at("status");
    }
    return found;
  }

  /// Files that begin with `.ibmfair-` but are no journals.
  int temporaries(const std::string& folder) const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(full(folder))) {
      count += entry.path().extension() == ".tmp" ? 1 : 0;
    }
    return count;
  }

  std::size_t meshes(const std::string& folder) const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(full(folder), error)) {
      count += entry.path().extension() == ".off" ? 1 : 0;
    }
    return count;
  }

  test::TemporaryDirectory directory_;
  Words inputs_;
};

const Words options{"--steps", "2", "--cutoff", "4"};

TEST_F(BatchTest, ManyFilesBecomeTheBytesOfSingleRuns) {
  const RunResult result =
      run(Words{"smooth"} + inputs_ + Words{"--out-dir", "out/new", "--jobs", "2"} + options);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "");
  for (const std::string& input : inputs_) {
    EXPECT_EQ(bytes("out/new/" + fs::path(input).filename().string()), single(input, options));
    EXPECT_TRUE(contains(result.err, input + " -> out/new/")) << result.err;
  }
  EXPECT_TRUE(contains(result.err, "3 of 3 done")) << result.err;
  EXPECT_EQ(meshes("out/new"), 3U);
}

TEST_F(BatchTest, AJobFileRunsAnyCommandWithDefaultsGlobsAndPatterns) {
  write_bytes(full("jobs.json"), R"({
    // Comments are welcome.
    "defaults": {"command": "smooth", "options": {"steps": 2, "cutoff": 4, "weld": true}},
    "jobs": [
      {"input": "in/[ab].off", "output": "fair/"},
      {"input": ["in/c.off"], "output": "fair/{stem}-{ext}{{}}.off", "options": {"weld": null}},
      {"command": "make", "shape": "torus", "output": "torus.off", "options": {"rows": 8}},
      {"command": "compare", "a": "in/*.off", "b": "in/a.off",
       "options": {"report": "reports/{stem}.json", "samples": 10}}]})");
  const Statuses found = statuses({"batch", "jobs.json", "--jobs", "3"});
  EXPECT_EQ(found.size(), 4U);
  for (const std::string name : {"a", "b"}) {
    EXPECT_EQ(bytes("fair/" + name + ".off"), single(path(name), options + Words{"--weld"}));
  }
  EXPECT_EQ(bytes("fair/c-off{}.off"), single(path("c"), options));
  EXPECT_EQ(bytes("torus.off"), run({"make", "torus", "-", "--format", "off", "--rows", "8"}).out);
  for (const std::string name : {"a", "b", "c"}) {
    const json report = json::parse(bytes("reports/" + name + ".json"));
    EXPECT_EQ(report["a"], path(name));
    EXPECT_EQ(report["vertex_distance"]["max"] == 0.0, name == "a");
  }
}

TEST_F(BatchTest, AFileThatFailsDoesNotKeepTheOthersFromBeingDone) {
  write_bytes(full("in/bad.off"), "OFF 3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n");
  const Words words = Words{"smooth", "in/bad.off"} + inputs_ + Words{"--out-dir", "out"} + options;
  const RunResult result = run(words);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_TRUE(contains(result.err, "in/bad.off -> out/bad.off (exit code 3): in/bad.off:4:3"))
      << result.err;
  EXPECT_EQ(meshes("out"), 3U);
  EXPECT_FALSE(exists("out/bad.off"));
  for (const std::string& input : inputs_) {
    EXPECT_EQ(bytes("out/" + fs::path(input).filename().string()), single(input, options));
  }
  const RunResult quiet = run(words + Words{"--resume", "--quiet"});
  EXPECT_EQ(quiet.exit_code, 1);
  EXPECT_TRUE(quiet.err.starts_with("ibmfair: error: [1/4] failed")) << quiet.err;
  EXPECT_EQ(std::count(quiet.err.begin(), quiet.err.end(), '\n'), 1) << quiet.err;
}

TEST_F(BatchTest, FailFastStartsNothingAfterAFailure) {
  write_bytes(full("in/bad.off"), "OFF\n");
  const Words words =
      Words{"smooth", path("a"), "in/bad.off", path("b"), path("c"), "--out-dir", "out"} + options;
  const Statuses expected{
      {path("a"), "ok"}, {"in/bad.off", "failed"}, {path("b"), "not run"}, {path("c"), "not run"}};
  EXPECT_EQ(statuses(words + Words{"--fail-fast"}, 1), expected);
  EXPECT_EQ(meshes("out"), 1U);
}

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
  expect(options, "ok", "ok", "ok");
  expect(options, "skipped", "skipped", "skipped");
  expect(options + Words{"--threads", "2"}, "skipped", "skipped", "skipped");
  fs::remove(full("out/a.off"));
  expect(options, "ok", "skipped", "skipped");
  make("b", 77);
  expect(options, "skipped", "ok", "skipped");
  write_bytes(full("out/c.off"), "somebody else's\n");
  expect(options, "skipped", "skipped", "ok");
  expect(options + Words{"--no-mass"}, "ok", "ok", "ok");
  expect(options + Words{"--no-mass"}, "skipped", "skipped", "skipped");
  // A new date alone does not matter, nor does a value that is the default anyway.
  fs::last_write_time(full(path("a")), fs::file_time_type::clock::now());
  expect(options + Words{"--no-mass", "--metric", "mass"}, "skipped", "skipped", "skipped");
  // The same size and date, other content.
  const auto date = fs::last_write_time(full(path("a")));
  std::string text = bytes(path("a"));
  std::swap(text[text.find("0.")], text[text.find("0.") + 2]);
  write_bytes(full(path("a")), text);
  fs::last_write_time(full(path("a")), date);
  const RunResult changed = run(words + options + Words{"--no-mass", "--json"});
  EXPECT_TRUE(contains(changed.err, "[1/3] ok") || contains(changed.err, "[1/3] failed"))
      << changed.err;
  EXPECT_TRUE(contains(changed.err, "[2/3] skipped")) << changed.err;
}

TEST_F(BatchTest, WhatTheBatchHasNotMadeIsNeverReplacedUnasked) {
  fs::create_directory(full("out"));
  write_bytes(full("out/b.off"), "mine");
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options;
  const Statuses expected{{path("a"), "ok"}, {path("b"), "failed"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words, 1), expected);
  const Statuses again{{path("a"), "skipped"}, {path("b"), "failed"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}, 1), again);
  EXPECT_EQ(bytes("out/b.off"), "mine");
  const Statuses without{{path("a"), "failed"}, {path("b"), "failed"}, {path("c"), "failed"}};
  EXPECT_EQ(statuses(words, 1), without);
  const Statuses asked{{path("a"), "ok"}, {path("b"), "ok"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words + Words{"--overwrite"}), asked);
  EXPECT_EQ(bytes("out/b.off"), single(path("b"), options));
}

TEST_F(BatchTest, AJournalsHalfWrittenLastLineIsIgnored) {
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options;
  EXPECT_EQ(run(words).exit_code, 0);
  const std::string journal = full("out/.ibmfair-batch.journal");
  std::string text = read_bytes(journal);
  ASSERT_TRUE(text.ends_with("}\n"));
  write_bytes(journal, text.substr(0, text.size() - 20));  // c's end
  const Statuses expected{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "ok"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}), expected);
  const Statuses all{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses(words + Words{"--resume"}), all);
}

TEST_F(BatchTest, OneBatchAtATimeWritesAJournal) {
  write_bytes(full("journal"), "");
  const int fd = open(full("journal").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(flock(fd, LOCK_EX), 0);
  const Words words =
      Words{"smooth"} + inputs_ + Words{"--out-dir", "out", "--journal", "journal"} + options;
  const RunResult refused = run(words);
  EXPECT_EQ(refused.exit_code, 6);
  EXPECT_TRUE(contains(refused.err, "another batch")) << refused.err;
  EXPECT_EQ(meshes("out"), 0U);
  close(fd);
  EXPECT_EQ(run(words).exit_code, 0);
}

/// Files large enough that a batch of them can be met in the middle.
class InterruptedBatchTest : public BatchTest {
 protected:
  InterruptedBatchTest() {
    for (int i = 0; i < 8; ++i) {
      many_.push_back(path(fmt::format("m{}", i)));
      make(fmt::format("m{}", i), i, "3");
      whole_["out/" + fs::path(many_.back()).filename().string()] = single(many_.back(), {});
    }
    words_ = Words{"smooth"} + many_ + Words{"--jobs", "2", "--out-dir", "out"};
  }

  /// Stops the batch once more has been written than runs at a time: some, but not all, is done.
  RunResult stopped_by(int signal_number) {
    RunOptions options;
    options.signal_number = signal_number;
    options.signal_when = [this] { return meshes("out") >= 3; };
    return run(words_, options);
  }

  void expect_only_whole_files() {
    for (const auto& [output, whole] : whole_) {
      if (exists(output)) {
        EXPECT_EQ(bytes(output), whole) << output;
      }
    }
    EXPECT_GE(meshes("out"), 3U);
  }

  void expect_resume_finishes() {
    const Statuses found = statuses(words_ + Words{"--resume"});
    EXPECT_GE(std::count_if(found.begin(), found.end(),
                            [](const auto& item) { return item.second == "skipped"; }),
              1);
    EXPECT_EQ(meshes("out"), many_.size());
    EXPECT_EQ(temporaries("out"), 0);
    expect_only_whole_files();
  }

  Words many_;
  Words words_;
  std::map<std::string, std::string> whole_;  // outputs of single runs, by name
};

TEST_F(InterruptedBatchTest, KilledItLosesNothingAndResumes) {
  EXPECT_EQ(stopped_by(SIGKILL).exit_code, -SIGKILL);
  // Its processes end with it: nothing more appears.
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const std::size_t left = meshes("out");
  EXPECT_LT(left, many_.size());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(meshes("out"), left);
  expect_only_whole_files();
  expect_resume_finishes();
}

TEST_F(InterruptedBatchTest, ASignalEndsItInGoodOrder) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    fs::remove_all(full("out"));
    const RunResult result = stopped_by(signal_number);
    EXPECT_EQ(result.exit_code, 128 + signal_number) << result.err;
    EXPECT_TRUE(contains(result.err, "interrupted")) << result.err;
    EXPECT_LT(meshes("out"), many_.size());
    EXPECT_EQ(temporaries("out"), 0);
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
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options;
  EXPECT_EQ(run(words).exit_code, 0);
  EXPECT_TRUE(exists(stale));
  // The other parts of a list may be at work on other machines.
  EXPECT_EQ(run(words + Words{"--resume", "--shard", "1/2"}).exit_code, 0);
  EXPECT_TRUE(exists(stale));
  EXPECT_EQ(run(words + Words{"--resume"}).exit_code, 0);
  EXPECT_FALSE(exists(stale));
  EXPECT_TRUE(exists(live));
  EXPECT_TRUE(exists(other));
}

TEST_F(BatchTest, ShardsArePartsOfTheList) {
  const Words list = Words{"smooth"} + inputs_ + Words{"--out-dir", "out"} + options;
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
}

TEST_F(BatchTest, DumpedArgumentsAreAJobThatDoesTheSame) {
  write_bytes(full("fixed.txt"), "0 1 2\n");
  const std::vector<std::pair<Words, std::string>> runs{
      {{"smooth", path("a"), "OUT"}, ".off"},
      {{"smooth", path("a"), "OUT", "--time-step", "1e-5", "--steps", "3", "--no-mass"}, ".off"},
      {{"smooth", path("a"), "OUT", "--cutoff", "2%", "--fix", "fixed.txt", "--plain"}, ".off"},
      {{"smooth", path("b"), "OUT", "--max-move", "0.5e", "--laplacian", "lagrange"}, ".off"},
      {{"make", "torus", "OUT", "--rows", "8", "--move", "-1,2.5,1e2", "--noise", "0.25"}, ".ply"},
      {{"make", "icosphere", "OUT", "--seed", "3", "--noise", "1"}, ".obj"},
      {{"make", "plane", "OUT", "--straight"}, ".obj"},
      {{"info", path("a"), "--report", "OUT", "--sphere"}, ".json"},
      {{"compare", path("a"), path("b"), "--report", "OUT", "--samples", "9"}, ".json"},
      {{"compare", path("a"), "--torus", "1,0.25", "--center", "-1,0,0", "--report", "OUT"},
       ".json"}};
  for (const auto& [words, extension] : runs) {
    SCOPED_TRACE(fmt::format("{}", fmt::join(words, " ")));
    Words named = words;
    std::replace(named.begin(), named.end(), std::string("OUT"), "out" + extension);
    const RunResult dump = run(named + Words{"--dump-config"});
    EXPECT_EQ(dump.exit_code, 0) << dump.err;
    EXPECT_FALSE(exists("out" + extension));
    EXPECT_EQ(run(named).exit_code, 0);
    const std::string expected = bytes("out" + extension);
    fs::remove(full("out" + extension));
    const RunResult batch = run({"batch", "-"}, {.input = dump.out});
    EXPECT_EQ(batch.exit_code, 0) << batch.err << dump.out;
    EXPECT_EQ(bytes("out" + extension), expected);
    fs::remove(full("out" + extension));
    // Dumping the job gives the job.
    EXPECT_EQ(run({"batch", "-", "--dump-config"}, {.input = dump.out}).out, dump.out);
  }
}

TEST_F(BatchTest, DumpingManyFilesKeepsTheirPattern) {
  const Words words =
      Words{"smooth"} + inputs_ + Words{"--out-dir", "o{u}t", "--out-name", "{stem}.obj"} + options;
  const RunResult dump = run(words + Words{"--dump-config"});
  EXPECT_EQ(dump.exit_code, 0) << dump.err;
  const json job = json::parse(dump.out)["jobs"][0];
  EXPECT_EQ(job["input"], json(inputs_));
  EXPECT_EQ(job["output"], "o{{u}}t/{stem}.obj");
  EXPECT_EQ(job["options"]["steps"], 2);
  EXPECT_EQ(job["options"]["metric"], "mass");
  EXPECT_EQ(run({"batch", "-"}, {.input = dump.out}).exit_code, 0);
  const std::string a = bytes("o{u}t/a.obj");
  EXPECT_EQ(run(words + Words{"--overwrite"}).exit_code, 0);
  EXPECT_EQ(bytes("o{u}t/a.obj"), a);
  EXPECT_TRUE(exists("o{u}t/c.obj"));
}

TEST_F(BatchTest, AGlobLeavesOutWhatItsOwnJobWrites) {
  write_bytes(
      full("jobs.json"),
      R"({"jobs": [{"command": "smooth", "input": "in/*.off", "output": "{dir}/{stem}.fair.off",
                            "options": {"steps": 1}}]})");
  EXPECT_EQ(statuses({"batch", "jobs.json"}).size(), 3U);
  const Statuses skipped{{path("a"), "skipped"}, {path("b"), "skipped"}, {path("c"), "skipped"}};
  EXPECT_EQ(statuses({"batch", "jobs.json", "--resume"}), skipped);
  EXPECT_EQ(meshes("in"), 6U);
}

struct BadList {
  std::string text;
  int exit_code;
  Words messages;  // parts of what is said
};

TEST_F(BatchTest, BadJobFilesAreRefusedBeforeAnythingRuns) {
  const std::string good = R"({"command": "make", "shape": "cube", "output": "good.off"})";
  const std::vector<BadList> lists{
      {"", 3, {"jobs.json:1:1:"}},
      {"{\"jobs\": [\n  {\"command\": \"make\",}\n]}", 3, {"jobs.json:2:22:"}},
      {"{\"jobs\": [\n\n" + good, 3, {"jobs.json:3:"}},
      {"[]", 3, {"list of jobs"}},
      {R"({"jobs": [GOOD], "job": 1})", 3, {"'job'", "did you mean 'jobs'"}},
      {R"({"jobs": [GOOD, 7]})", 3, {"job 2:", "object"}},
      {R"({"jobs": [GOOD, {"command": "make", "command": "info"}]})", 3, {"'command'", "twice"}},
      {R"({"jobs": [GOOD, {"shape": "cube"}]})", 3, {"job 2:", "'command'"}},
      {R"({"jobs": [GOOD, {"command": "smoth"}]})", 2, {"job 2:", "did you mean 'smooth'"}},
      {R"({"jobs": [GOOD, {"command": "batch", "jobs": "x"}]})", 3, {"job 2:", "batch"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "inptu": "in/a.off", "output": "x.off"}]})",
       3,
       {"job 2:", "'inptu'", "did you mean 'input'"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "x.off",
           "options": {"stesp": 3}}]})",
       3,
       {"job 2:", "'options.stesp'", "did you mean 'steps'"}},
      {R"({"defaults": {"options": {"stesp": 3}}, "jobs": [GOOD]})",
       3,
       {"defaults:", "'options.stesp'"}},
      {R"({"defaults": {"shpae": "torus"}, "jobs": [GOOD]})",
       3,
       {"defaults:", "'shpae'", "did you mean 'shape'"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "x.off",
           "options": {"steps": "many"}}]})",
       2,
       {"job 2:", "--steps: 'many'"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "x.off",
           "options": {"steps": true}}]})",
       3,
       {"job 2:", "'options.steps'", "true"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "x.off",
           "options": {"weld": 1}}]})",
       3,
       {"job 2:", "'options.weld'", "true or false"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "x.off",
           "options": {"metric": "mess"}}]})",
       2,
       {"job 2:", "mess"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "output": "x.off"}]})",
       3,
       {"job 2:", "'input'", "missing"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off"}]})", 2, {"job 2:", "OUT"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/z.off", "output": "x.off"}]})",
       3,
       {"job 2:", "in/z.off"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/*.obj", "output": "x/"}]})",
       3,
       {"job 2:", "in/*.obj"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/*.off", "output": "x.off"}]})",
       2,
       {"job 2:", "x.off", "two items"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "in/../good.off"}]})",
       2,
       {"job 2:", "good.off", "two items"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/*.off", "output": "{dir}/{name}",
           "options": {"overwrite": true}}]})",
       2,
       {"job 2:", "in/a.off", "replaced"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "in/a.off", "output": "{stme}.off"}]})",
       2,
       {"job 2:", "did you mean 'stem'"}},
      {R"({"jobs": [GOOD, {"command": "smooth", "input": "-", "output": "x.off"}]})",
       2,
       {"job 2:", "standard input"}},
      {R"({"jobs": [{"command": "smooth", "input": "in/a.off", "output": "x.off"},
                    {"command": "info", "input": ["in/b.off", "x.off"]}]})",
       2,
       {"job 2:", "x.off", "second batch"}},
  };
  write_bytes(full("x.off"), bytes(path("a")));  // what an earlier run may have left
  for (const auto& [pattern, exit_code, messages] : lists) {
    std::string text = pattern;
    if (const std::size_t at = text.find("GOOD"); at != std::string::npos) {
      text.replace(at, 4, good);
    }
    SCOPED_TRACE(text);
    write_bytes(full("jobs.json"), text);
    const RunResult result = run({"batch", "jobs.json", "--overwrite"});
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    for (const std::string& message : messages) {
      EXPECT_TRUE(contains(result.err, message)) << message << "\n" << result.err;
    }
    EXPECT_FALSE(exists("good.off"));
  }
  write_bytes(full("jobs.json"), "{\"jobs\": [" + good + "]}");
  EXPECT_EQ(run({"batch", "jobs.json"}).exit_code, 0);
  EXPECT_TRUE(exists("good.off"));
  EXPECT_EQ(run({"batch", "missing.json"}).exit_code, 3);
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
      {{"smooth", path("a"), "--out-dir", "out", "--summary", "s.txt"}, "--summary"},
      {{"smooth", path("a"), "--out-dir", "out", "--fail-fast", "--keep-going"}, "--fail-fast"},
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
  const Words words = Words{"smooth", "in/bad.off"} + inputs_ + options;
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
      json::parse(run(Words{"smooth", path("a"), "again.off", "--json"} + options).out);
  EXPECT_EQ(first["figures"]["after.energy"], report["after"]["energy"]);
  EXPECT_EQ(first["figures"]["status"], report["status"]);

  const std::string csv = bytes("s.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_TRUE(
      csv.starts_with("command,input,output,status,exit_code,seconds,peak_megabytes,message,"));
  EXPECT_TRUE(contains(csv, "\r\nsmooth,in/a.off,out/a.off,ok,0,")) << csv;
  EXPECT_TRUE(contains(csv, "after.energy"));
  EXPECT_TRUE(contains(csv, ",\"in/bad.off:2")) << csv;
  // Resuming tells the figures of what it skips.
  const RunResult resumed =
      run(words + Words{"--out-dir", "out", "--json", "--resume", "--summary", "s.csv"});
  EXPECT_EQ(json::parse(resumed.out)["items"][1]["figures"], first["figures"]);
  EXPECT_EQ(run(words + Words{"--out-dir", "new", "--summary", "s.csv"}).exit_code, 6);
  EXPECT_FALSE(exists("new"));
}

TEST_F(BatchTest, WantOfMemoryEndsOneItemOnly) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "AddressSanitizer needs all of the address space";
#endif
  if (!fs::exists("/usr/bin/prlimit")) {
    GTEST_SKIP() << "no prlimit";
  }
  write_bytes(full("jobs.json"),
              R"({"defaults": {"command": "make", "shape": "icosphere"}, "jobs": [
      {"output": "large.off", "options": {"subdivide": 9}}, {"output": "small.off"}]})");
  const RunResult result =
      run({"batch", "jobs.json", "--json"}, {.address_space = std::int64_t{3} << 27U});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const json items = json::parse(result.out)["items"];
  EXPECT_EQ(items[0]["exit_code"], 5);
  EXPECT_TRUE(contains(items[0]["message"], "memory"));
  EXPECT_EQ(items[1]["status"], "ok");
}

}  // namespace
}  // namespace ibmfair
