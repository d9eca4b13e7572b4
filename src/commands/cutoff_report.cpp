#include "commands/cutoff_report.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/angle.h"

namespace ibmfair::commands {
namespace {

using nlohmann::ordered_json;

/// The distance to the surface without noise that a trial of a cut-off is expected to leave.
double expected_distance(const CutoffTrial& trial) {
  return std::sqrt(std::max(trial.risk, 0.0));
}

/// Whether the distance that the chosen cut-off leaves can be estimated.
bool tells_distance(const CutoffChoice& choice) {
  return !choice.trials.empty() &&
         (choice.kind == NoiseKind::independent || choice.kind == NoiseKind::outliers);
}

/// The growth of the expected distance if the risk grows by its standard error.
double distance_error(const CutoffChoice& choice) {
  const double risk = std::max(choice.best().risk, 0.0);
  return std::sqrt(risk + choice.risk_error) - std::sqrt(risk);
}

/// The expected distance in units of `edge`, and how sure it is; only a bound if it may be 0.
std::string error_left(const CutoffChoice& choice, double edge) {
  const double left = expected_distance(choice.best()) / edge,
               error = distance_error(choice) / edge;
  return error < left ? fmt::format("{:.2g} +- {:.1g}", left, error)
                      : fmt::format("at most about {:.2g}", left + error);
}

/// What the line with the noise says about its kind.
std::string addition_for(const CutoffChoice& choice) {
  switch (choice.kind) {
    case NoiseKind::none:
      return " by estimate; none was found";
    case NoiseKind::outliers:
      return ", with outliers";
    case NoiseKind::correlated:
      return fmt::format(", correlated over about {:.0f} edges{}", choice.noise.reach(),
                         choice.noise.white_share > 0 ? ", with independent noise" : "");
    case NoiseKind::steps:
      return ", steps between levels";
    case NoiseKind::independent:
      break;
  }
  return {};
}

}  // namespace

std::string length_text(double length, double edge) {
  return fmt::format("{:.4g} u = {:.3g} mean edge lengths", length, length / edge);
}

std::string cutoff_lines(const SmoothPlan& plan, bool detailed) {
  const double edge = plan.mean_edge_length;
  std::string text;
  if (plan.cutoff > 0) {
    text += fmt::format("  {:<16}{}\n", "cut-off", length_text(plan.cutoff, edge));
  }
  if (plan.choice) {
    text += fmt::format("  {:<16}{}{}\n", "noise", length_text(plan.choice->noise.deviation, edge),
                        addition_for(*plan.choice));
    if (const auto& creases = plan.creases) {
      text += fmt::format("  {:<16}edges of more than {:.0f} degrees are kept{}\n", "creases",
                          degrees(creases->sharp_angle),
                          tells_distance(creases->without)
                              ? fmt::format("; without that the error would be {:.3g} mean edge "
                                            "lengths",
                                            expected_distance(creases->without.best()) / edge)
                              : "");
    }
    if (tells_distance(*plan.choice)) {
      text += fmt::format("  {:<16}{} mean edge lengths, by estimate\n", "error left",
                          error_left(*plan.choice, edge));
    }
    if (detailed) {
      const bool tells = tells_distance(*plan.choice);
      text += fmt::format("  {:<16}{:>7}{}  mean edge lengths\n", "tried", "cut-off",
                          tells ? "    distance left" : "");
      for (const CutoffTrial& trial : plan.choice->trials) {
        text += fmt::format("  {:<16}{:>7.3g}{}\n", "", trial.cutoff / edge,
                            tells ? fmt::format("{:>17.3g}", expected_distance(trial) / edge) : "");
      }
    }
  }
  return text;
}

void add_cutoff_choice(const SmoothPlan& plan, Report& report) {
  if (!plan.outliers.empty()) {
    report.figures["outliers"] = plan.outliers.vertices;
  }
  if (!plan.choice) {
    return;
  }
  ordered_json trials = ordered_json::array();
  for (const CutoffTrial& trial : plan.choice->trials) {
    trials.push_back({{"cutoff", trial.cutoff}, {"distance_expected", expected_distance(trial)}});
  }
  ordered_json& json = report.figures["cutoff_choice"];
  json = {{"cutoff", plan.choice->cutoff},
          {"noise", plan.choice->noise.deviation},
          {"kind", name_of(plan.choice->kind)},
          {"trials", trials}};
  if (plan.choice->kind == NoiseKind::correlated) {
    json["correlated_edges"] = plan.choice->noise.reach();
    json["independent_share"] = plan.choice->noise.white_share;
  }
  if (tells_distance(*plan.choice)) {
    json["distance_expected"] = expected_distance(plan.choice->best());
    json["distance_expected_error"] = distance_error(*plan.choice);
  }
  if (const auto& creases = plan.creases) {
    json["keep_sharp"] = degrees(creases->sharp_angle);
    if (tells_distance(creases->without)) {
      json["distance_expected_without"] = expected_distance(creases->without.best());
    }
  }
}

}  // namespace ibmfair::commands
