// Job files: the jobs that they describe, and the messages about bad job files.
#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
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
using test::Statuses;
using test::Words;
using test::write_bytes;
using test::operator+;

const Words options{"--steps", "2", "--cutoff", "4"};

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
    // Dumping a dumped job gives the dumped job again.
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
  EXPECT_EQ(count("in"), 6U);
}

struct BadList {
  std::string text;
  int exit_code;
  Words messages;  // parts of the error output
};

TEST_F(BatchTest, BadJobFilesAreRefusedBeforeAnythingRuns) {
  const std::string good = R"({"command": "make", "shape": "cube", "output": "good.off"})";
  constexpr std::size_t levels = 100000;  // more than a stack of 8 MiB holds
  const std::string nested = std::string(levels, '[') + std::string(levels, ']');
  const std::vector<BadList> lists{
      {"", 3, {"jobs.json:1:1:"}},
      {"{\"jobs\": [\n  {\"command\": \"make\",}\n]}", 3, {"jobs.json:2:22:"}},
      {"{\"jobs\": [\n\n" + good, 3, {"jobs.json:3:"}},
      {"[]", 3, {"list of jobs"}},
      {R"({"jobs": [GOOD], "job": 1})", 3, {"'job'", "did you mean 'jobs'"}},
      {R"({"jobs": [GOOD, 7]})", 3, {"job 2:", "object"}},
      {R"({"jobs": [GOOD, {"command": "make", "command": "info"}]})", 3, {"'command'", "twice"}},
      {R"({"jobs": [GOOD, {"command": "make", "shape": 1e999}]})", 3, {"jobs.json:", "1e999"}},
      {R"({"jobs": [GOOD, )" + nested + "]}", 3, {"jobs.json:", "nested more than 100 deep"}},
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
           "options": {"plain": 1}}]})",
       3,
       {"job 2:", "'options.plain'", "true or false"}},
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
  write_bytes(full("x.off"), bytes(path("a")));  // an earlier run may have left this file
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

}  // namespace
}  // namespace ibmfair
