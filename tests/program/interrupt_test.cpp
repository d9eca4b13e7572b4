// Runs that are asked to stop end at once, or after the current step with --checkpoint.
#include <csignal>
#include <filesystem>
#include <regex>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/faults.h"
#include "support/files.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Interrupt : public testing::Test {
 protected:
  void SetUp() override {
    if (!faults_can_be_injected()) {
      GTEST_SKIP() << "AddressSanitizer is in the way";
    }
    EXPECT_EQ(run_program({"make", "torus", in_, "--noise", "0.2", "--rows", "20"}).exit_code, 0);
    // The number of allocations in a run of one step. In a run of very many steps, the allocation
    // of this number happens somewhere in the middle of the steps.
    in_a_step_ = count_calls({"malloc"}, steps(1));
    fs::remove(out_);
    EXPECT_EQ(run_program(steps(many)).exit_code, 0);
    fs::rename(out_, whole_);
  }

  Words steps(int count) const {
    return {"smooth", in_, out_, "--steps", std::to_string(count), "--threads", "1"};
  }

  /// Runs many steps and sends one signal or two during one of the steps.
  RunResult interrupted(const Words& more, int signal_number = SIGINT, int signals = 1) const {
    Fault fault{"malloc", in_a_step_, in_a_step_ + signals - 1};
    fault.signal_number = signal_number;
    return run_program(steps(many) + more, {.environment = environment_of(fault)});
  }

  static double energy(const std::string& mesh) {
    const RunResult result = run_program({"info", mesh, "--json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out)["bending_energy"]["crouzeix-raviart"];
  }

  static constexpr int many = 400;
  const TemporaryDirectory directory_;
  const std::string in_ = directory_ / "in.ply", out_ = directory_ / "out.ply",
                    state_ = directory_ / "state.ply", whole_ = directory_ / "whole.ply";
  long in_a_step_ = 0;
};

TEST_F(Interrupt, WithACheckpointTheStateIsKeptAndCanBeGoneOnFrom) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    const RunResult result =
        interrupted({"--checkpoint", state_, "--report", directory_ / "report.json", "--overwrite"},
                    signal_number);
    ASSERT_EQ(result.exit_code, 128 + signal_number) << result.err;
    EXPECT_TRUE(contains(result.err, "once more to end at once")) << result.err;
    EXPECT_FALSE(fs::exists(out_));
    const json report = json::parse(read_bytes(directory_ / "report.json"));
    EXPECT_EQ(report["status"], "interrupted");
    EXPECT_EQ(report["output"], state_);
    const double at_start = energy(in_), at_state = energy(state_), at_end = energy(whole_);
    EXPECT_LT(at_state, at_start);
    EXPECT_GT(at_state, at_end);

    std::smatch way_on;
    ASSERT_TRUE(std::regex_search(result.err, way_on,
                                  std::regex("--steps (\\d+) --time-step ([-+.e0-9]+)")))
        << result.err;
    EXPECT_LT(std::stoi(way_on[1]), many);
    EXPECT_EQ(run_program({"smooth", state_, out_, "--steps", way_on[1], "--time-step", way_on[2]})
                  .exit_code,
              0);
    EXPECT_NEAR(energy(out_), at_end, 0.01 * at_end);
    fs::remove(out_);
  }
}

TEST_F(Interrupt, ItTellsWhatGoingOnWillMeasureFromTheCheckpoint) {
  const std::string anew = " to that mesh";
  EXPECT_FALSE(contains(interrupted({"--checkpoint", state_, "--overwrite"}).err, anew));
  const RunResult result =
      interrupted({"--checkpoint", state_, "--overwrite", "--max-move", "5e", "--twicing", "1"});
  EXPECT_TRUE(contains(result.err, "--max-move and --twicing then refer" + anew)) << result.err;
}

TEST_F(Interrupt, WithoutOneOrASecondTimeItEndsAtOnce) {
  const RunResult plain = interrupted({});
  EXPECT_EQ(plain.exit_code, 130);
  EXPECT_TRUE(contains(plain.err, "interrupted")) << plain.err;
  EXPECT_EQ(interrupted({}, SIGHUP).exit_code, 128 + SIGHUP);
  const RunResult second = interrupted({"--checkpoint", state_}, SIGINT, 2);
  EXPECT_EQ(second.exit_code, 130);
  EXPECT_TRUE(contains(second.err, "once more")) << second.err;
  EXPECT_EQ(directory_.entries(), 2U);  // the input and the result of the uninterrupted run
}

TEST_F(Interrupt, ARunThatIsNotInterruptedLeavesNoCheckpoint) {
  EXPECT_EQ(run_program(steps(many) + Words{"--checkpoint", state_}).exit_code, 0);
  EXPECT_EQ(read_bytes(out_), read_bytes(whole_));
  EXPECT_FALSE(fs::exists(state_));
}

TEST_F(Interrupt, ACheckpointThatCannotBeWrittenIsRefusedBeforeTheWork) {
  write_bytes(state_, "mine");
  EXPECT_EQ(interrupted({"--checkpoint", state_}).exit_code, 6);
  EXPECT_EQ(read_bytes(state_), "mine");
  EXPECT_EQ(interrupted({"--checkpoint", directory_ / "state.vtk"}).exit_code, 2);
  EXPECT_EQ(interrupted({"--checkpoint", out_}).exit_code, 2);
  EXPECT_EQ(interrupted({"--checkpoint", directory_ / "missing/state.ply"}).exit_code, 6);
}

// Each signal comes during a call of malloc, so that the program must not allocate memory for its
// message.
TEST_F(Interrupt, ACrashTellsVersionKernelsStageAndSignal) {
  const std::vector<std::pair<int, std::string>> signals{{SIGSEGV, "SIGSEGV"},
                                                         {SIGBUS, "SIGBUS"},
                                                         {SIGILL, "SIGILL"},
                                                         {SIGFPE, "SIGFPE"},
                                                         {SIGABRT, "SIGABRT"}};
  for (const auto& [number, name] : signals) {
    const RunResult result = interrupted({}, number);
    EXPECT_EQ(result.exit_code, -number) << result.err;
    const std::regex told("ibmfair: error: the program crashed \\(" + name +
                          ", version [0-9.]+, kernels (baseline|avx2), "
                          "stage: step [0-9]+ of 400(, [a-z ]+)?\\)\n");
    EXPECT_TRUE(std::regex_search(result.err, told)) << result.err;
    EXPECT_TRUE(contains(result.err, "Please report this")) << result.err;
    EXPECT_FALSE(fs::exists(out_));
  }
}

TEST_F(Interrupt, ACrashWhileReadingSaysSo) {
  RunOptions options;
  // The input is more than a pipe holds, so that the program is reading when the signal comes.
  options.input = std::string(1 << 20, '#');
  options.signal_number = SIGSEGV;
  const RunResult result = run_program({"smooth", "-", out_, "--input-format", "obj"}, options);
  EXPECT_EQ(result.exit_code, -SIGSEGV);
  EXPECT_TRUE(contains(result.err, "stage: read)")) << result.err;
}

TEST_F(Interrupt, SignalsThatAreIgnoredStaySo) {
  // SIGINT is ignored, as under nohup or in the background of a shell without job control.
  signal(SIGINT, SIG_IGN);
  const RunResult result = interrupted({"--checkpoint", state_});
  signal(SIGINT, SIG_DFL);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_bytes(out_), read_bytes(whole_));
}

}  // namespace
}  // namespace ibmfair::test
