// The defaults of `smooth` that depend on other options: they are settings that could be given.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/files.h"
#include "support/program_figures.h"
#include "support/run_program.h"
#include "support/temporary_directory.h"

namespace ibmfair {
namespace {

using nlohmann::json;
using test::made;
using test::run_program;
using test::Words;
using test::operator+;

/// Closed, open, with creases, and without noise.
std::vector<std::string> meshes() {
  return {made({"torus", "--rows", "24", "--columns", "60", "--noise", "0.2"}),
          made({"cylinder", "--rows", "24", "--columns", "40", "--noise", "0.1"}),
          made({"cube", "--subdivide", "3", "--noise", "0.3"}),
          made({"icosphere", "--subdivide", "3", "--jitter", "0.3"})};
}

std::string smoothed(const std::string& mesh, const Words& options) {
  const auto run =
      run_program(Words{"smooth", "-", "-", "--format", "off"} + options, {.input = mesh});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return run.out;
}

/// The options in force, as the report tells them.
json options_in_force(const std::string& mesh, const Words& options) {
  const test::TemporaryDirectory directory;
  const Words words{"smooth", "-", directory / "out.off", "--json", "--quiet"};
  const auto run = run_program(words + options, {.input = mesh});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  json told = json::parse(run.out);
  told["options"]["edge"] = told["mesh"]["mean_edge_length"];
  return told["options"];
}

TEST(SmoothDefaults, AreSettingsThatCouldBeGiven) {
  for (const std::string& mesh : meshes()) {
    for (const Words& options : {Words{}, Words{"--twicing", "1"}, Words{"--laplacian", "lagrange"},
                                 Words{"--keep-sharp", "30"}, Words{"--boundary", "free"},
                                 Words{"--metric", "identity"}}) {
      SCOPED_TRACE(fmt::format("{} {}", mesh.size(), fmt::join(options, " ")));
      const json told = options_in_force(mesh, options);
      const Words steps{"--steps", told["steps"].dump(), "--solver-tolerance",
                        told["solver_tolerance"].dump()};
      EXPECT_EQ(smoothed(mesh, options), smoothed(mesh, options + steps + Words{"--cutoff", "8"}));
      EXPECT_EQ(smoothed(mesh, options + Words{"--cutoff", "5"}),
                smoothed(mesh, options + steps + Words{"--cutoff", "5e"}));
      EXPECT_NEAR(told["cutoff"].get<double>() / told["edge"].get<double>(), 8, 1e-9);
    }
  }
}

/// What is given is taken, and nothing else changes: a number of steps has always meant the same.
TEST(SmoothDefaults, ANumberOfStepsMeansTheSame) {
  const std::string mesh = meshes().front();
  for (const int steps : {1, 4, 16, 32}) {
    const json told = options_in_force(mesh, {"--steps", fmt::format("{}", steps)});
    EXPECT_EQ(told["steps"], steps);
    EXPECT_EQ(told["solver_tolerance"], 0.05);
    EXPECT_NEAR(told["cutoff"].get<double>() / told["edge"].get<double>(),
                8 * std::pow(steps / 16.0, 0.25), 1e-9);
    const std::string length = fmt::format("{:.17g}u", told["cutoff"].get<double>());
    EXPECT_NEAR(options_in_force(
                    mesh, {"--steps", fmt::format("{}", steps), "--cutoff", length})["total_time"]
                    .get<double>(),
                told["total_time"].get<double>(), 1e-12 * told["total_time"].get<double>());
  }
  EXPECT_EQ(smoothed(mesh, {"--steps", "16"}),
            smoothed(mesh, {"--steps", "16", "--cutoff", "8", "--solver-tolerance", "0.05"}));
  EXPECT_EQ(options_in_force(mesh, {"--solver-tolerance", "0.3"})["solver_tolerance"], 0.3);
}

TEST(SmoothDefaults, AreSixteenStepsWhereFewWouldNotDo) {
  const std::string mesh = meshes().front();
  for (const Words& options : {Words{"--time-step", "1e-7"}, Words{"--plain"},
                               Words{"--cutoff", "auto"}, Words{"--plain", "--cutoff", "4"}}) {
    const json told = options_in_force(mesh, options);
    EXPECT_EQ(told["steps"], 16) << options.front();
    EXPECT_EQ(told["solver_tolerance"], 0.05) << options.front();
    EXPECT_EQ(smoothed(mesh, options), smoothed(mesh, options + Words{"--steps", "16"}));
  }
  for (const std::string length : {"12e", "11.9", "0.5e"}) {
    EXPECT_LT(options_in_force(mesh, {"--cutoff", length})["steps"], 16) << length;
  }
  EXPECT_NEAR(options_in_force(mesh, {"--time-step", "1e-7"})["total_time"].get<double>(), 1.6e-6,
              1e-15);
}

/// A sheet of `size` x `size` unit squares with ripples along x.
std::string rippled_sheet(int size, double wavelength, double height) {
  std::string text = fmt::format("OFF\n{} {} 0\n", (size + 1) * (size + 1), size * size);
  for (int i = 0; i <= size; ++i) {
    for (int j = 0; j <= size; ++j) {
      text +=
          fmt::format("{} {} {}\n", i, j, height * std::sin(2 * std::numbers::pi * i / wavelength));
    }
  }
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) {
      const int a = i * (size + 1) + j, b = a + size + 1;
      text += fmt::format("4 {} {} {} {}\n", a, b, b + 1, a + 1);
    }
  }
  return text;
}

/// The root mean square height of an OFF file's sheet, far from its boundary.
double middle_height(const std::string& off, int size) {
  std::istringstream in(off);
  std::string word;
  in >> word >> word >> word >> word;
  double sum = 0;
  int count = 0;
  double x = 0, y = 0, z = 0;
  for (int v = 0; v < (size + 1) * (size + 1) && in >> x >> y >> z; ++v) {
    if (std::min({x, y, size - x, size - y}) > size / 4.0) {
      sum += z * z;
      ++count;
    }
  }
  EXPECT_GT(count, 0);
  return std::sqrt(sum / count);
}

/// Backward Euler with n steps leaves (1 + T k^4 / n)^-n of a ripple of wave number k. A cut-off
/// means about the same with the default number of steps as with 16: what is left of a ripple
/// differs by less than 5 % of the ripple, and the wavelength of which half is left by less than
/// 3 %.
TEST(SmoothDefaults, ACutoffMeansTheSameAsWithSixteenSteps) {
  constexpr int size = 64;
  constexpr double cutoff = 10;
  const auto left = [&](double wavelength, const Words& more) {
    const std::string sheet = rippled_sheet(size, wavelength, 0.02);
    const std::string out = smoothed(sheet, Words{"--cutoff", fmt::format("{}u", cutoff)} + more);
    return middle_height(out, size) / middle_height(sheet, size);
  };
  const auto half = [&](const Words& more) {  // the wavelength of which half is left
    double shorter = cutoff / 2, longer = 2 * cutoff;
    for (int k = 0; k < 8; ++k) {
      const double middle = (shorter + longer) / 2;
      (left(middle, more) < 0.5 ? shorter : longer) = middle;
    }
    return (shorter + longer) / 2;
  };
  for (const double wavelength : {0.6 * cutoff, cutoff, 1.6 * cutoff}) {
    EXPECT_NEAR(left(wavelength, {}), left(wavelength, {"--steps", "16"}), 0.05) << wavelength;
  }
  EXPECT_NEAR(half({}) / half({"--steps", "16"}), 1, 0.03);
  for (const Words& steps : {Words{}, Words{"--steps", "16"}}) {
    EXPECT_NEAR(left(cutoff, steps + Words{"--laplacian", "lagrange"}), std::pow(1 + 1.0 / 16, -16),
                0.05);
  }
}

}  // namespace
}  // namespace ibmfair
