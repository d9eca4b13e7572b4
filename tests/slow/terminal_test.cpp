// The program on a terminal as a person sees it: progress, colours, and tables.
#include "support/terminal.h"

#include <algorithm>
#include <chrono>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

class Terminal : public testing::Test {
 protected:
  void SetUp() override {
    EXPECT_EQ(run_program({"make", "torus", in_, "--noise", "0.2", "--rows", "90"}).exit_code, 0);
  }

  /// A run that is long enough to be watched.
  Words smoothing(const Words& more = {}) const {
    return Words{"smooth", in_, out_, "--steps", "60", "--cutoff", "12", "--overwrite"} + more;
  }

  const TemporaryDirectory directory_;
  const std::string in_ = directory_ / "in.ply", out_ = directory_ / "out.ply";
};

bool has_frame(const TerminalResult& result, const std::string& part) {
  return std::any_of(result.frames.begin(), result.frames.end(),
                     [&](const std::string& frame) { return contains(frame, part); });
}

/// Whether a part of a progress line is left on the screen.
bool leaves_traces(const TerminalResult& result) {
  return std::any_of(result.lines.begin(), result.lines.end(), [](const std::string& line) {
    static const std::regex traces(R"(\[=|\[  |s left|step \d+ of)");
    return std::regex_search(line, traces);
  });
}

TEST_F(Terminal, ProgressTellsTheStageAndIsCleared) {
  const TerminalResult result = run_on_terminal(smoothing());
  EXPECT_EQ(result.exit_code, 0) << result.drawn;
  EXPECT_TRUE(has_frame(result, " of 60")) << result.drawn;
  EXPECT_TRUE(has_frame(result, "s left")) << result.drawn;
  EXPECT_TRUE(has_frame(result, "energy ")) << result.drawn;
  EXPECT_TRUE(has_frame(result, "[==")) << result.drawn;
  EXPECT_FALSE(leaves_traces(result)) << result.drawn;
  EXPECT_TRUE(contains(result.drawn, "bending energy"));
}

TEST_F(Terminal, ProgressOfFillingCountsHoles) {
  const std::string holes = directory_ / "holes.ply";
  EXPECT_EQ(run_program({"make", "cylinder", holes, "--rows", "60", "--columns", "400"}).exit_code,
            0);
  const TerminalResult result = run_on_terminal({"fill", holes, out_, "--all"});
  EXPECT_LE(result.exit_code, 1) << result.drawn;
  EXPECT_TRUE(has_frame(result, "hole 1 of 2")) << result.drawn;
  EXPECT_FALSE(leaves_traces(result)) << result.drawn;
}

TEST_F(Terminal, ProgressFitsIntoTheLine) {
  for (const int columns : {20, 40, 60, 200}) {
    const TerminalResult result = run_on_terminal(smoothing(), {.columns = columns});
    EXPECT_EQ(result.exit_code, 0);
    ASSERT_FALSE(result.frames.empty());
    for (const std::string& frame : result.frames) {
      if (contains(frame, " of 60")) {
        EXPECT_LT(frame.size(), static_cast<std::size_t>(columns)) << frame;
      }
    }
  }
}

TEST_F(Terminal, ProgressIsDrawnTenTimesASecondAtMost) {
  const auto start = std::chrono::steady_clock::now();
  const TerminalResult result = run_on_terminal(smoothing());
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto frames = std::count(result.drawn.begin(), result.drawn.end(), '\r') -
                      static_cast<long>(result.lines.size());
  // A frame that is shorter than the frame before is drawn twice, and clearing the line takes two
  // returns.
  EXPECT_LE(frames, 2 * (10 * seconds + 1) + 2) << result.drawn;
}

TEST_F(Terminal, ThereIsNoProgressWhereNobodyCouldSeeIt) {
  for (const TerminalOptions& options :
       {TerminalOptions{.environment = {"TERM=dumb"}}, TerminalOptions{}}) {
    const Words more = options.environment.empty() ? Words{"--quiet"} : Words{};
    const TerminalResult result = run_on_terminal(smoothing(more), options);
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_FALSE(has_frame(result, " of 60")) << result.drawn;
    EXPECT_FALSE(contains(result.drawn, "\x1b")) << result.drawn;
  }
  const RunResult piped = run_program(smoothing());
  EXPECT_FALSE(contains(piped.err, " of 60")) << piped.err;
  EXPECT_FALSE(contains(piped.err, "\r")) << piped.err;
}

TEST_F(Terminal, WithNoColorThereAreNoEscapeCodes) {
  const TerminalResult result = run_on_terminal(smoothing(), {.environment = {"NO_COLOR=1"}});
  EXPECT_TRUE(has_frame(result, " of 60")) << result.drawn;
  EXPECT_FALSE(contains(result.drawn, "\x1b")) << result.drawn;
}

TEST_F(Terminal, AnInterruptLeavesACleanLine) {
  const auto drawing = [](const std::string& drawn) { return contains(drawn, " of 4000"); };
  const Words many{"smooth", in_, out_, "--steps", "4000", "--cutoff", "40"};
  const TerminalResult result = run_on_terminal(many, {.interrupt_when = drawing});
  EXPECT_EQ(result.exit_code, 130) << result.drawn;
  EXPECT_FALSE(leaves_traces(result)) << result.drawn;
  EXPECT_EQ(result.lines.front(), "ibmfair: interrupted");
  EXPECT_FALSE(contains(result.lines.back(), "^C")) << result.drawn;

  const std::string state = directory_ / "state.ply";
  const TerminalResult kept =
      run_on_terminal(many + Words{"--checkpoint", state}, {.interrupt_when = drawing});
  EXPECT_EQ(kept.exit_code, 130) << kept.drawn;
  EXPECT_FALSE(leaves_traces(kept)) << kept.drawn;
  EXPECT_TRUE(kept.lines.front().starts_with("ibmfair: interrupted; finishing")) << kept.drawn;
}

TEST_F(Terminal, ColoursAreForTerminalsAndThoseWhoForceThem) {
  const Words failing{"info", directory_ / "missing.ply"};
  const std::string red = "\x1b[1;31m";
  EXPECT_TRUE(contains(run_on_terminal(failing).drawn, red));
  EXPECT_FALSE(contains(run_on_terminal(failing, {.environment = {"NO_COLOR=1"}}).drawn, red));
  EXPECT_FALSE(contains(run_on_terminal(failing, {.environment = {"TERM=dumb"}}).drawn, red));
  const auto piped = [&](const Words& environment) {
    return contains(run_program(failing, {.environment = environment}).err, red);
  };
  EXPECT_FALSE(piped({"CLICOLOR_FORCE=", "NO_COLOR=", "TERM=xterm"}));
  EXPECT_TRUE(piped({"CLICOLOR_FORCE=1", "NO_COLOR=", "TERM=xterm"}));
  EXPECT_FALSE(piped({"CLICOLOR_FORCE=0", "NO_COLOR=", "TERM=xterm"}));
  EXPECT_FALSE(piped({"CLICOLOR_FORCE=1", "NO_COLOR=1", "TERM=xterm"}));
  EXPECT_FALSE(piped({"CLICOLOR_FORCE=1", "NO_COLOR=", "TERM=dumb"}));
}

TEST_F(Terminal, HelpIsAsWideAsTheTerminal) {
  for (const int columns : {60, 80, 100, 140}) {
    const TerminalResult result = run_on_terminal({"help", "smooth"}, {.columns = columns});
    std::size_t longest = 0;
    for (const std::string& line : result.lines) {
      longest = std::max(longest, line.size());
    }
    const auto width = static_cast<std::size_t>(std::clamp(columns, 80, 110));
    EXPECT_LE(longest, width);
    EXPECT_GT(longest, width - 10);
  }
}

TEST_F(Terminal, DetailsShowTheEnergyAsACurve) {
  const auto details = [&](const std::string& locale) {
    return run_program(smoothing({"-v"}), {.environment = {"LC_ALL=" + locale}}).err;
  };
  EXPECT_TRUE(contains(details("C.UTF-8"), "\u2588")) << details("C.UTF-8");
  const std::string ascii = details("C");
  EXPECT_TRUE(contains(ascii, "energy by step  9")) << ascii;
  EXPECT_TRUE(std::all_of(ascii.begin(), ascii.end(), [](char c) { return c > 0; })) << ascii;
  EXPECT_FALSE(contains(run_program(smoothing()).err, "energy by step"));
}

}  // namespace
}  // namespace ibmfair::test
