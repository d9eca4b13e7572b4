// The program's descriptions of itself agree: help, JSON, man pages, completions and the README's
// exit codes.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/run_program.h"
#include "support/shell.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

using nlohmann::json;

/// The output of a question; the run must succeed and print nothing else.
std::string answer(const Words& question, const Words& environment = {}) {
  const RunResult result = run_program(question, {.environment = environment});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result.out;
}

const json& usage() {
  static const json parsed = json::parse(answer({"--json-usage"}));
  return parsed;
}

const json& usage_commands() {
  return usage()["commands"];
}

std::string replaced_in(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Whether the name stands in the text as a word of its own.
bool names_option(const std::string& text, const std::string& name) {
  const auto in_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-';
  };
  for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]))) {
      return true;
    }
  }
  return false;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    lines.push_back(line);
  }
  return lines;
}

TEST(Usage, HelpIsTheSameHoweverItIsAskedFor) {
  EXPECT_EQ(answer({"help"}), answer({"--help"}));
  EXPECT_EQ(answer({"help", "help"}), answer({"--help"}));
  for (const json& command : usage_commands()) {
    const std::string name = command["name"];
    EXPECT_EQ(answer({"help", name}), answer({name, "--help"})) << name;
    EXPECT_EQ(answer({"help", name}), answer({name, "-h"})) << name;
    EXPECT_EQ(answer({"help", name, "--all"}), answer({name, "--help", "--all"})) << name;
  }
}

TEST(Usage, ShortHelpNamesEveryOption) {
  for (const json& command : usage_commands()) {
    const std::string name = command["name"];
    const std::string help = answer({"help", name}), all = answer({"help", "--all", name});
    EXPECT_LE(lines_of(help).size(), 130U) << name;
    EXPECT_LE(help.size(), all.size()) << name;
    EXPECT_EQ(help == all, !contains(help, "help " + name + " --all")) << name;
    for (const json& option : command["options"]) {
      EXPECT_TRUE(names_option(help, option["name"])) << name << " " << option["name"];
    }
  }
}

TEST(Usage, NamesThatLookLikeQuestionsAreNames) {
  const RunResult result = run_program({"fill", "--", "--help", "--all"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_TRUE(contains(result.err, "--help: cannot be read")) << result.err;
}

TEST(Usage, AnUnknownCommandIsNoReasonForHelp) {
  for (const Words& words : {Words{"help", "smoth"}, Words{"smoth", "--help"}, Words{"smoth"}}) {
    const RunResult result = run_program(words);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(contains(result.err, "did you mean 'smooth'")) << result.err;
  }
  EXPECT_TRUE(contains(run_program({"hlep", "smooth"}).err, "did you mean 'help'"));
  EXPECT_EQ(run_program({"help", "smooth", "fill"}).exit_code, 2);
}

TEST(Usage, LinesOfTheHelpFitIntoTheTerminal) {
  struct Width {
    std::string columns;
    std::size_t most;
  };
  std::size_t longest = 0;
  for (const Width& width : std::vector<Width>{
           {"20", 80}, {"80", 80}, {"97", 97}, {"110", 110}, {"400", 110}, {"wide", 80}}) {
    for (const json& command : usage_commands()) {
      const std::string name = command["name"];
      longest = 0;
      for (const std::string& line :
           lines_of(answer({"help", name}, {"COLUMNS=" + width.columns}) +
                    answer({"help", name, "--all"}, {"COLUMNS=" + width.columns}))) {
        EXPECT_LE(line.size(), width.most) << name << ": " << line;
        EXPECT_FALSE(line.ends_with(' ')) << name << ": " << line;
        longest = std::max(longest, line.size());
      }
      EXPECT_GT(longest, width.most - 20) << name;
    }
    for (const std::string& line : lines_of(answer({"help"}, {"COLUMNS=" + width.columns}))) {
      EXPECT_LE(line.size(), width.most) << line;
    }
  }
}

TEST(Usage, EveryOptionIsInEveryListOfThem) {
  const std::string bash = answer({"--generate", "bash"}), zsh = answer({"--generate", "zsh"}),
                    fish = answer({"--generate", "fish"});
  ASSERT_GE(usage_commands().size(), 7U);
  for (const json& command : usage_commands()) {
    const std::string name = command["name"];
    const std::string help = answer({"help", name, "--all"});
    std::string page = replaced_in(answer({name, "--generate", "man"}), "\\-", "-");
    for (const std::string font : {"\\fB", "\\fI", "\\fR"}) {
      page = replaced_in(page, font, "");
    }
    ASSERT_GE(command["options"].size(), 5U);
    for (const json& option : command["options"]) {
      const std::string word = option["name"];
      SCOPED_TRACE(testing::Message() << name << " " << word);
      ASSERT_TRUE(word.starts_with("--"));
      EXPECT_TRUE(names_option(help, word));
      EXPECT_TRUE(names_option(page, word));
      EXPECT_TRUE(names_option(bash, word));
      EXPECT_TRUE(names_option(zsh, word));
      EXPECT_TRUE(contains(fish, "'__ibmfair_on " + name + "' -l " + word.substr(2) + " "));
      for (const std::string choice : option["choices"]) {
        for (const std::string& text : {help, page, bash, zsh, fish}) {
          EXPECT_TRUE(names_option(text, choice)) << choice;
        }
      }
    }
  }
}

TEST(Usage, TheReadmeListsTheExitCodes) {
  const std::string readme = read_bytes(project_file("README.md"));
  for (const json& row : usage()["exit_codes"]) {
    const std::string code = row["code"].is_string() ? row["code"].get<std::string>()
                                                     : std::to_string(row["code"].get<int>());
    EXPECT_TRUE(contains(readme, "| " + code + " | " + row["meaning"].get<std::string>())) << row;
  }
}

TEST(Usage, OptionsHaveUnitsAndDefaultsAndReferToEachOther) {
  EXPECT_EQ(usage()["version"], 1);
  for (const json& command : usage_commands()) {
    const auto find = [&](const std::string& name) -> json {
      for (const json& option : command["options"]) {
        if (option["name"] == name) {
          return option;
        }
      }
      return {};
    };
    for (const json& option : command["options"]) {
      SCOPED_TRACE(testing::Message() << command["name"] << " " << option["name"]);
      EXPECT_FALSE(option["help"].get<std::string>().empty());
      EXPECT_FALSE(option["group"].get<std::string>().empty());
      EXPECT_EQ(option["type"] == "flag", option["value"].is_null());
      const std::string type = option["type"];
      if (type == "integer" || type == "number" || type == "length" || type == "bytes") {
        EXPECT_FALSE(option["unit"].is_null());
        EXPECT_FALSE(option["default"].is_null() && option["default_text"].is_null());
      }
      if (type == "choice") {
        const auto& choices = option["choices"];
        EXPECT_TRUE(option["default"].is_null() ||
                    std::find(choices.begin(), choices.end(), option["default"]) != choices.end());
        EXPECT_FALSE(option["default"].is_null() && option["default_text"].is_null());
      }
      for (const std::string other : option["excludes"]) {
        const json back = find(other)["excludes"];
        EXPECT_NE(std::find(back.begin(), back.end(), option["name"]), back.end()) << other;
      }
      for (const std::string other : option["needs"]) {
        EXPECT_FALSE(find(other).is_null()) << other;
      }
    }
  }
}

TEST(Usage, OfACommandIsPartOfThatOfTheProgram) {
  for (const json& command : usage_commands()) {
    json one = json::parse(answer({command["name"], "--json-usage"}));
    ASSERT_EQ(one["commands"].size(), 1U);
    EXPECT_EQ(one["commands"][0], command);
    EXPECT_EQ(one["exit_codes"], usage()["exit_codes"]);
  }
}

/// A folder with the files that the examples of a command read, and no others.
void prepare_files(const std::string& command, const std::string& folder) {
  std::vector<std::string> lines{
      "ibmfair make plane scan.ply --noise 0.1 --rows 12 --columns 12",
      "ibmfair make icosahedron plain.obj --subdivide 3",
      "awk '/^f/ && ++n == 1200 {print \"g blend\"} {print}' plain.obj > part.obj",
      R"(echo '{"jobs": [{"command": "make", "shape": "cube", "output": "a.obj"}]}' > jobs.json)"};
  if (command == "compare" || command == "view") {
    lines.emplace_back("ibmfair smooth -q scan.ply fair.ply");
  }
  if (command == "compare") {
    lines.emplace_back("ibmfair make icosphere ball.ply");
  }
  for (const std::string& line : lines) {
    const ShellResult result = run_shell(line, folder);
    ASSERT_EQ(result.exit_code, 0) << line << "\n" << result.out;
  }
}

TEST(Usage, EveryExampleRuns) {
  for (const json& command : usage_commands()) {
    const std::string name = command["name"];
    EXPECT_GE(command["examples"].size(), 2U) << name;
    for (const json& example : command["examples"]) {
      const std::string line = example["command"];
      EXPECT_TRUE(line.starts_with("ibmfair ")) << line;
      EXPECT_TRUE(contains(line, " " + name + " ")) << line;
      EXPECT_FALSE(example["meaning"].get<std::string>().empty());
      EXPECT_TRUE(contains(answer({"help", name}), "  " + line + "\n")) << line;
      const TemporaryDirectory directory;
      prepare_files(name, directory.path().string());
      const ShellResult result = run_shell(line, directory.path().string());
      if (name != "view" || writes_pages()) {
        EXPECT_EQ(result.exit_code, 0) << line << "\n" << result.out;
      }
    }
  }
}

TEST(Usage, ManPagesAreWithoutFault) {
  const TemporaryDirectory directory;
  write_bytes(directory / "ibmfair.1", answer({"--generate", "man"}));
  std::string pages = "ibmfair.1";
  for (const json& command : usage_commands()) {
    const std::string name = "ibmfair-" + command["name"].get<std::string>() + ".1";
    write_bytes(directory / name, answer({command["name"], "--generate", "man"}));
    pages += " " + name;
  }
  int checkers = 0;
  for (const std::string checker :
       {"mandoc -T lint -W warning ", "groff -ww -man -T utf8 -z ", "man --warnings -l "}) {
    if (is_installed(checker.substr(0, checker.find(' ')))) {
      const std::string ignored = checker.starts_with("man ") ? " 2>&1 > /dev/null" : "";
      const ShellResult result =
          run_shell(fmt::format("{}{}{}", checker, pages, ignored), directory.path().string());
      EXPECT_EQ(result.exit_code, 0) << checker;
      EXPECT_EQ(result.out, "") << checker;
      ++checkers;
    }
  }
  if (checkers == 0) {
    GTEST_SKIP() << "no mandoc, groff or man";
  }
}

TEST(Usage, ManPagesAreTheSameOnTheSameDay) {
  const Words day{"SOURCE_DATE_EPOCH=1700000000"};
  EXPECT_EQ(answer({"--generate", "man"}, day), answer({"--generate", "man"}, day));
  EXPECT_TRUE(contains(answer({"--generate", "man"}, day), "2023-11-14"));
}

}  // namespace
}  // namespace ibmfair::test
