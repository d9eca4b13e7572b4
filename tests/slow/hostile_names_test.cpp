// File names that a careless program would take for options, patterns, commands, or control
// sequences of the terminal.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::contains;
using test::read_bytes;
using test::run_program;
using test::RunOptions;
using test::RunResult;
using test::Words;
using test::write_bytes;
using test::operator+;

/// All names have an extension, so that the format is known.
const Words odd_names{"a b.off",
                      "a\nb.off",
                      "-a.off",
                      "--help.off",
                      "a\xff\xfe.off",
                      "\x1b]0;title\x07\x1b[31mred.off",
                      "\302\23331m.off",  // octal: a hexadecimal number would include the 3
                      "\342\200\256ffo.off",
                      "[a,b].off",
                      "{name}.off",
                      "{}.off",
                      "*.off",
                      "~.off",
                      "$(touch pwned).off",
                      "`touch pwned`.off",
                      ";touch pwned;.off",
                      R"('q' "r" \.off)",
                      "%s%n.off",
                      "a=b,c.off",
                      "@a.off",
                      "++.off",
                      "\xc3\xa4\xe2\x82\xac.off",
                      std::string(251, 'x') + ".off"};

/// The program runs in this folder, so that names need no path.
class NamesTest : public testing::Test {
 protected:
  NamesTest() {
    mesh_ = run_program({"make", "icosphere", "-", "--format", "off", "--subdivide", "1"}).out;
    fs::create_directory(folder_ / "out");
  }

  RunResult run(const Words& words, std::string input = "") const {
    return run_program(words, {.input = std::move(input), .directory = folder_.path().string()});
  }

  std::string bytes(const std::string& name) const { return read_bytes(folder_ / name); }

  /// Checks that the text has printable characters only, line by line.
  static void expect_printable(const std::string& text) {
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](unsigned char c) {
      return (c < 0x20 && c != '\n') || c == 0x7f;
    })) << json(text).dump(-1, ' ', true, json::error_handler_t::replace);
    EXPECT_NO_THROW(json(text).dump()) << "not UTF-8";
    EXPECT_FALSE(contains(text, "\xc2\x9b"));
    EXPECT_FALSE(contains(text, "\xe2\x80\xae"));
  }

  /// Returns the report in a text. It is JSON whatever the names, and every line of it is
  /// printable.
  static json report_in(const std::string& text) {
    expect_printable(text);
    return json::parse(text, nullptr, false);
  }

  const test::TemporaryDirectory folder_;
  std::string mesh_;
};

TEST_F(NamesTest, AnyNameIsReadAndWritten) {
  for (const std::string& name : odd_names) {
    SCOPED_TRACE(name);
    const Words options{"--overwrite", "--steps", "0", "--"};
    write_bytes(folder_ / name, mesh_);
    const RunResult read = run(Words{"smooth"} + options + Words{name, "copy.off"});
    EXPECT_EQ(read.exit_code, 0) << read.err;
    expect_printable(read.err);
    EXPECT_EQ(bytes("copy.off"), mesh_);

    fs::remove(folder_ / name);
    const RunResult written = run(Words{"smooth"} + options + Words{"copy.off", name});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    expect_printable(written.err);
    EXPECT_EQ(bytes(name), mesh_);

    for (const Words& words : {Words{"info", "--", name}, Words{"holes", "--", name},
                               Words{"compare", "--samples", "10", "--", name, "copy.off"}}) {
      const RunResult told = run(words);
      EXPECT_EQ(told.exit_code, 0) << told.err;
      expect_printable(told.out + told.err);
      const RunResult figures =
          run(Words{words.front(), "--json"} + Words(words.begin() + 1, words.end()));
      EXPECT_TRUE(report_in(figures.out).is_object()) << figures.out;
    }
  }
  EXPECT_FALSE(fs::exists(folder_ / "pwned"));
}

TEST_F(NamesTest, ABatchTakesThemAll) {
  for (const std::string& name : odd_names) {
    write_bytes(folder_ / name, mesh_);
  }
  const Words batch =
      Words{"smooth", "--steps", "0", "--out-dir", "out", "--json", "--"} + odd_names;
  const RunResult first = run(batch);
  EXPECT_EQ(first.exit_code, 0) << first.err;
  expect_printable(first.err);
  EXPECT_EQ(report_in(first.out)["counts"]["ok"], odd_names.size());
  for (const std::string& name : odd_names) {
    EXPECT_EQ(bytes("out/" + name), mesh_) << name;
  }
  const RunResult again = run(Words{"smooth", "--resume"} + Words(batch.begin() + 1, batch.end()));
  EXPECT_EQ(report_in(again.out)["counts"]["skipped"], odd_names.size()) << again.err;
  const RunResult listed =
      run(Words{"smooth", "--dry-run"} + Words(batch.begin() + 1, batch.end()));
  expect_printable(listed.out);
  EXPECT_TRUE(contains(listed.out, "'$(touch pwned).off'")) << listed.out;
  EXPECT_TRUE(contains(listed.out, "$'a\\xff\\xfe.off'")) << listed.out;
  EXPECT_FALSE(fs::exists(folder_ / "pwned"));
}

TEST_F(NamesTest, AJobFileTakesThoseThatItCanHold) {
  for (const std::string& name : odd_names) {
    const bool is_utf8 = !contains(name, "\xff");
    SCOPED_TRACE(name);
    write_bytes(folder_ / name, mesh_);
    const RunResult dump =
        run({"smooth", "--steps", "0", "--overwrite", "--dump-config", "--", name, "o.off"});
    EXPECT_EQ(dump.exit_code, is_utf8 ? 0 : 2) << dump.err;
    if (is_utf8) {
      EXPECT_TRUE(report_in(dump.out).is_object());
      write_bytes(folder_ / "jobs.json", dump.out);
      const RunResult batch = run({"batch", "jobs.json", "--json"});
      EXPECT_EQ(batch.exit_code, 0) << batch.err;
      const std::string input = json::parse(batch.out)["items"][0]["input"];
      EXPECT_TRUE(input == name || input == "./" + name) << input;
      EXPECT_EQ(bytes("o.off"), mesh_);
    }
  }
}

TEST_F(NamesTest, NamesThatNothingCanHaveAreRefused) {
  write_bytes(folder_ / "a.off", mesh_);
  for (const std::string& name :
       {std::string(), std::string("."), std::string(".."), std::string("a.off/b.off"),
        std::string("no/a.off"), std::string(300, 'x') + ".off", std::string(5000, 'x')}) {
    SCOPED_TRACE(name);
    EXPECT_EQ(run({"info", name}).exit_code, 3);
    const RunResult written = run({"smooth", "a.off", name, "--format", "off", "--overwrite"});
    EXPECT_EQ(written.exit_code, 6) << written.err;
    EXPECT_TRUE(contains(written.err, "cannot be written")) << written.err;
  }
}

TEST_F(NamesTest, WhatAFileHoldsIsShownNotObeyed) {
  const std::string escape =
      "\x1b[31m\xc2\x9b"
      "2J\x7f";
  write_bytes(folder_ / "a.obj",
              "g " + escape + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2 " + escape + "\n");
  write_bytes(folder_ / "b.obj", "v 0 0 " + escape + "\n");
  write_bytes(folder_ / "c.ply", "ply\nformat ascii 1.0\nelement " + escape + " 1\nfoo\n");
  write_bytes(folder_ / "d.off", "OFF 3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 " + escape + "\n");
  write_bytes(folder_ / "e.dae", R"(<COLLADA version="1.4.1"><)" + escape + "/></COLLADA>");
  write_bytes(folder_ / "f.json", R"({"jobs": [{")" + escape + R"(": 1}]})");
  for (const Words& words :
       {Words{"smooth", "a.obj", "o.obj", "--mask", "none"}, Words{"info", "b.obj"},
        Words{"info", "c.ply"}, Words{"info", "d.off"}, Words{"info", "e.dae"},
        Words{"batch", "f.json"}, Words{"info", escape}, Words{escape}, Words{"info", "-" + escape},
        Words{"smooth", "a.obj", "o.obj", "--steps", escape}}) {
    const RunResult result = run(words);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_NE(result.err, "");
    expect_printable(result.out + result.err);
  }
}

}  // namespace
}  // namespace ibmfair
