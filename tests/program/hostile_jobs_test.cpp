// Actions that neither a job file nor a folder prepared by somebody else can make a batch perform.
#include <filesystem>
#include <string>

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
using test::Words;
using test::write_bytes;
using test::operator+;

/// A batch of one job, given as its JSON.
std::string job_file(const json& job) {
  return json{{"jobs", {job}}}.dump();
}

TEST_F(BatchTest, AJobRunsNothingButThisProgram) {
  const std::string command = "x; touch pwned; $(touch pwned) `touch pwned` | touch pwned";
  for (const json& job :
       {json{{"command", command}}, json{{"command", "info"}, {"input", command}},
        json{{"command", "info"}, {"input", {path("a"), command}}},
        json{{"command", "make"}, {"shape", command}, {"output", "o.off"}},
        json{{"command", "make"}, {"shape", "cube"}, {"output", "|touch pwned"}},
        json{{"command", "smooth"}, {"input", path("a")}, {"output", "o/" + command}},
        json{{"command", "smooth"},
             {"input", path("a")},
             {"output", "o.off"},
             {"options", {{"fix", command}}}}}) {
    run({"batch", "-"}, {.input = job_file(job)});
    EXPECT_FALSE(exists("pwned")) << job;
    EXPECT_FALSE(exists("o/pwned")) << job;
  }
}

TEST_F(BatchTest, AValueOfAJobIsNeverAnOption) {
  write_bytes(full("mine.off"), "mine");
  for (const std::string value : {"--overwrite", "-q", "--", "++"}) {
    const json job{{"command", "smooth"},
                   {"input", path("a")},
                   {"output", value},
                   {"options", {{"steps", 0}, {"format", "off"}}}};
    const RunResult result = run({"batch", "-"}, {.input = job_file(job)});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(bytes(value), bytes(path("a"))) << value;
  }
  const json job{{"command", "smooth"},
                 {"input", path("a")},
                 {"output", "mine.off"},
                 {"options", {{"steps", 1}, {"mask", "--overwrite"}}}};
  EXPECT_EQ(run({"batch", "-"}, {.input = job_file(job)}).exit_code, 1);
  EXPECT_EQ(bytes("mine.off"), "mine");
}

TEST_F(BatchTest, AJobCannotSetWhatBelongsToTheBatch) {
  for (const std::string key : {"jobs", "journal", "summary", "resume", "fail-fast", "dry-run",
                                "out-dir", "dump-config", "help", "version", "json"}) {
    const json job{{"command", "smooth"},
                   {"input", path("a")},
                   {"output", "o.off"},
                   {"options", {{key, "x"}}}};
    const RunResult result = run({"batch", "-"}, {.input = job_file(job)});
    EXPECT_EQ(result.exit_code, 3) << key << result.err;
    EXPECT_FALSE(exists("o.off")) << key;
  }
}

TEST_F(BatchTest, ANameDoesNotEndWhereTheSystemWouldEndIt) {
  const std::string before = bytes(path("a"));
  // The whole name differs from the input's name; as an argument, which ends at the zero character,
  // it would be the input.
  const std::string name = path("a") + std::string(1, '\0') + ".off";
  const json job{{"command", "smooth"},
                 {"input", path("a")},
                 {"output", name},
                 {"options", {{"steps", 1}, {"overwrite", true}}}};
  const RunResult result = run({"batch", "-"}, {.input = job_file(job)});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(contains(result.err, "zero character")) << result.err;
  EXPECT_EQ(bytes(path("a")), before);
}

TEST_F(BatchTest, DeepNestingIsAnErrorNotACrash) {
  for (const int depth : {200, 10'000, 1'000'000}) {
    for (const auto& [open, close] : {std::pair("[", "]"), std::pair("{\"a\":", "}")}) {
      std::string nested, end;
      for (int i = 0; i < depth; ++i) {
        nested += open;
        end += close;
      }
      nested += "1" + end;
      for (const std::string& text :
           {nested, R"({"jobs": [)" + nested + "]}", R"({"jobs": [], "defaults": )" + nested + "}",
            R"({"jobs": [{"command": "info", "input": )" + nested + "}]}"}) {
        const RunResult result = run({"batch", "-"}, {.input = text});
        EXPECT_EQ(result.exit_code, 3) << depth;
        EXPECT_TRUE(contains(result.err, "standard input: ")) << result.err.substr(0, 200);
      }
    }
  }
}

TEST_F(BatchTest, TheJournalIsNeverWrittenIntoAnotherFile) {
  const std::string job = R"({"command": "make", "shape": "cube", "output": "$(touch pwned).off"})";
  write_bytes(full("jobs.json"), "{\"jobs\": [" + job + "]}");
  write_bytes(full("profile"), "# a file that a shell runs\n");
  const auto refused = [&](const Words& words) {
    const RunResult result = run(words);
    EXPECT_EQ(result.exit_code, 6) << result.err;
    EXPECT_TRUE(contains(result.err, "journal")) << result.err;
    EXPECT_EQ(bytes("profile"), "# a file that a shell runs\n");
    EXPECT_FALSE(exists("$(touch pwned).off"));
  };
  refused({"batch", "jobs.json", "--journal", "profile"});
  fs::create_symlink("profile", full("jobs.json.journal"));
  refused({"batch", "jobs.json"});
  fs::remove(full("jobs.json.journal"));
  fs::create_hard_link(full("profile"), full("jobs.json.journal"));
  refused({"batch", "jobs.json"});
  fs::remove(full("jobs.json.journal"));
  fs::create_symlink("not-there", full("jobs.json.journal"));
  refused({"batch", "jobs.json"});
  EXPECT_FALSE(exists("not-there"));
  fs::remove(full("jobs.json.journal"));

  for (const std::string begun : {"", "{", R"({"event":"sta)"}) {  // left by a killed run
    write_bytes(full("jobs.json.journal"), begun);
    EXPECT_EQ(run({"batch", "jobs.json", "--overwrite"}).exit_code, 0) << begun;
  }
  EXPECT_FALSE(exists("pwned"));
}

TEST_F(BatchTest, ALinkInTheOutputFolderLeadsNowhereUnasked) {
  fs::create_directory(full("fair"));
  write_bytes(full("mine.off"), "mine");
  fs::create_symlink("../mine.off", full("fair/a.off"));
  fs::create_symlink("../new.off", full("fair/b.off"));
  const Words words = Words{"smooth"} + inputs_ + Words{"--out-dir", "fair"} + options_;
  const test::Statuses found = statuses(words, 1);
  EXPECT_EQ(found.at(path("a")), "failed");
  EXPECT_EQ(found.at(path("b")), "failed");
  EXPECT_EQ(found.at(path("c")), "ok");
  EXPECT_EQ(bytes("mine.off"), "mine");
  EXPECT_FALSE(exists("new.off"));
}

}  // namespace
}  // namespace ibmfair
