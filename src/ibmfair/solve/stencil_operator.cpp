#include "ibmfair/solve/stencil_operator.h"

#include <algorithm>
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
  std::vector<Index> unknown(stencils.value.size()), stencil(stencils.value.size());
  for (Index s = 0; s < stencils.size(); ++s) {
    for (std::int64_t place = stencils.first[s]; place < stencils.first[s + 1]; ++place) {
      unknown[place] = unknowns.unknown[stencils.value[place]];
      place_unknown_[place] = std::max(unknown[place], Index{0});
      stencil[place] = s;
    }
  }
  unknown_places_ = positions_by_value(unknown, unknowns.size());
  unknown_c_.resize(unknown_places_.value.size());
  unknown_stencil_.reserve(unknown_places_.value.size());
  for (const Index place : unknown_places_.value) {
    unknown_stencil_.push_back(stencil[place]);
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
