// The terms of S = sum_s w_s c_s c_s^T ([W07] section 2.3) by rows: each row is gathered from the
// stencils at its vertex, so that nothing is stored per term, and threads that gather different
// rows write to different places.
#pragma once

#include <cstdint>
#include <vector>

#include "ibmfair/base/rows.h"
#include "ibmfair/energy/bending_energy.h"

namespace ibmfair {

class StencilTerms {
 public:
  /// Refers to the stencils, which are of `vertex_count` vertices.
  StencilTerms(const Rows& stencils, Index vertex_count)
      : stencils_(stencils),
        places_(positions_by_value(stencils.value, vertex_count)),
        stencil_of_place_(row_of_position(stencils)) {}

  Index vertex_count() const { return places_.size(); }

  /// Of all stencils together: a vertex counts in each.
  std::size_t vertices_in_stencils() const { return stencil_of_place_.size(); }

  /// Calls take(w) for every vertex w of every stencil at vertex v, v among them: S_vw may be other
  /// than zero. A vertex comes as often as it shares a stencil with v.
  template <class Take>
  void for_vertices(Index v, const Take& take) const {
    for (const Index place : places_[v]) {
      for (const Index w : stencils_[stencil_of_place_[place]]) {
        take(w);
      }
    }
  }

  /// The same with the terms whose sums are the entries of the row: take(w, w_s c_sv c_sw).
  template <class Take>
  void for_terms(Index v, const StencilWeights& weights, const Take& take) const {
    for (const Index place : places_[v]) {
      const Index s = stencil_of_place_[place];
      const double factor = weights.w[s] * weights.c[place];
      for (std::int64_t k = stencils_.first[s]; k < stencils_.first[s + 1]; ++k) {
        take(stencils_.value[k], factor * weights.c[k]);
      }
    }
  }

  /// S_vv.
  double diagonal(Index v, const StencilWeights& weights) const {
    double sum = 0;
    for (const Index place : places_[v]) {
      sum += weights.w[stencil_of_place_[place]] * weights.c[place] * weights.c[place];
    }
    return sum;
  }

 private:
  const Rows& stencils_;
  Rows places_;                          // of each vertex, positions in stencils_.value
  std::vector<Index> stencil_of_place_;  // as stencils_.value
};

}  // namespace ibmfair
