#include "ibmfair/solve/stencil_operator.h"

#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/parallel.h"

namespace ibmfair {

StencilOperator::StencilOperator(const Rows& stencils, const Unknowns& unknowns)
    : stencils_(stencils),
      place_unknown_(stencils.value.size(), 0),
      place_c_(stencils.value.size(), 0),
      scale_(unknowns.size()),
      identity_(unknowns.size()),
      z_(4, stencils.size()) {
  const Index n = unknowns.size();
  unknown_places_.first.assign(static_cast<std::size_t>(n) + 1, 0);
  for (const Index v : stencils.value) {
    if (const Index u = unknowns.unknown[v]; u >= 0) ++unknown_places_.first[u + 1];
  }
  for (Index u = 0; u < n; ++u) {
    unknown_places_.first[u + 1] += unknown_places_.first[u];
  }
  unknown_places_.value.resize(static_cast<std::size_t>(unknown_places_.first.back()));
  unknown_stencil_.resize(unknown_places_.value.size());
  unknown_c_.resize(unknown_places_.value.size());
  std::vector<std::int64_t> next(unknown_places_.first.begin(), unknown_places_.first.end() - 1);
  for (Index s = 0; s < stencils.size(); ++s) {
    for (std::int64_t place = stencils.first[s]; place < stencils.first[s + 1]; ++place) {
      if (const Index u = unknowns.unknown[stencils.value[place]]; u >= 0) {
        place_unknown_[place] = u;
        unknown_places_.value[next[u]] = static_cast<Index>(place);
        unknown_stencil_[next[u]++] = s;
      }
    }
  }
}

void StencilOperator::update(const StencilWeights& weights, const Eigen::VectorXd& D, double h) {
  std::atomic<Index> bad = -1;
  parallel_for(size(), [&](std::int64_t u) {
    double diagonal = 0;
    for (std::int64_t k = unknown_places_.first[u]; k < unknown_places_.first[u + 1]; ++k) {
      const double c = weights.c[unknown_places_.value[k]];
      diagonal += weights.w[unknown_stencil_[k]] * c * c;
    }
    diagonal = D[u] + h * diagonal;
    if (!(diagonal > 0) || !std::isfinite(diagonal)) {
      bad = static_cast<Index>(u);
    }
    scale_[u] = 1 / std::sqrt(diagonal);
    identity_[u] = static_cast<float>(D[u] / diagonal);
  });
  if (bad >= 0) {
    throw FactorizationFailed(fmt::format(
        "the Jacobian is not positive definite at unknown {}: a triangle there has (almost) no "
        "area, or a coordinate is not finite",
        bad.load()));
  }
  const auto coefficient = [&](std::int64_t s, std::int64_t place, Index u) {
    return static_cast<float>(std::sqrt(h * weights.w[s]) * weights.c[place] * scale_[u]);
  };
  parallel_for(size(), [&](std::int64_t u) {
    for (std::int64_t k = unknown_places_.first[u]; k < unknown_places_.first[u + 1]; ++k) {
      const Index place = unknown_places_.value[k];
      place_c_[place] = unknown_c_[k] =
          coefficient(unknown_stencil_[k], place, static_cast<Index>(u));
    }
  });
}

void StencilOperator::apply(const Quads& p, Quads& q) {
  using Quad = Eigen::Array4f;
  parallel_for(stencils_.size(), [&](std::int64_t s) {
    Quad sum = Quad::Zero();
    for (std::int64_t k = stencils_.first[s]; k < stencils_.first[s + 1]; ++k) {
      sum += place_c_[k] * p.col(place_unknown_[k]);
    }
    z_.col(s) = sum;
  });
  parallel_for(size(), [&](std::int64_t u) {
    Quad sum = identity_[u] * p.col(u);
    for (std::int64_t k = unknown_places_.first[u]; k < unknown_places_.first[u + 1]; ++k) {
      sum += unknown_c_[k] * z_.col(unknown_stencil_[k]);
    }
    q.col(u) = sum;
  });
}

}  // namespace ibmfair
