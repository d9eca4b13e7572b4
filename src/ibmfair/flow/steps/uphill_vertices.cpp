#include "ibmfair/flow/steps/uphill_vertices.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/flow/tuning.h"

namespace ibmfair {
UphillVertices find_uphill_vertices(const FlowProblem& problem, const Points& gradient,
                                    const Points& move) {
  const Eigen::VectorXd slope = gradient.cwiseProduct(move).rowwise().sum();
  double steepest = 0;
  for (const double s : slope) {
    steepest = std::isfinite(s) ? std::max(steepest, s) : steepest;
  }
  steepest = problem.parts.max(steepest);
  UphillVertices uphill;
  for (Index u = 0; u < problem.unknowns.size(); ++u) {
    if (!(slope[u] <= tuning.damping.uphill_share * steepest)) {
      uphill.vertices.push_back(problem.unknowns.vertex[u]);
    }
  }
  const double found = problem.parts.sum(static_cast<double>(uphill.vertices.size()));
  const double most = tuning.damping.local_share * static_cast<double>(problem.report.unknowns);
  uphill.are_local = found > 0 && found <= most;
  return uphill;
}

}  // namespace ibmfair
