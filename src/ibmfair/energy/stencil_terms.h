// The terms of S = sum_s w_s c_s c_s^T ([W07] section 2.3), row by row. Each row is gathered from
// the stencils at its vertex, so no memory is needed per term, and threads that gather different
// rows write to different places.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "ibmfair/base/compressed_rows.h"
#include "ibmfair/energy/bending_energy.h"

namespace ibmfair {

class StencilTerms {
 public:
  /// Keeps a reference to `stencils`, whose vertices are below `vertex_count`.
  StencilTerms(const CompressedRows& stencils, Index vertex_count);

  /// The total number of vertices in all stencils; a vertex counts once for each of its stencils.
  std::size_t vertices_in_stencils() const { return stencils_.value.size(); }

  /// The number of calls that for_vertices(v) makes.
  std::size_t terms_at(Index v) const {
    std::int64_t count = 0;
    for_stencils(v, [&](Index /*place*/, Index /*s*/, std::int64_t /*first*/, auto width) {
      count += width;
    });
    return static_cast<std::size_t>(count);
  }

  /// Calls take(w) for every vertex w, including v itself, of every stencil at vertex v; S_vw can
  /// be nonzero for these w only. A vertex is visited as often as it shares a stencil with v.
  template <class Take>
  void for_vertices(Index v, const Take& take) const {
    for_stencils(v, [&](Index /*place*/, Index /*s*/, std::int64_t first, auto width) {
      for (std::int64_t k = first; k < first + width; ++k) {
        take(stencils_.value[k]);
      }
    });
  }

  /// Visits the same vertices in the same order as for_vertices(v), with the terms that add up to
  /// the row's entries: take(w, w_s c_sv c_sw).
  template <class Take>
  void for_terms(Index v, const StencilWeights& weights, const Take& take) const {
    for_stencils(v, [&](Index place, Index s, std::int64_t first, auto width) {
      const double factor = weights.w[s] * weights.c[place];
      for (std::int64_t k = first; k < first + width; ++k) {
        take(stencils_.value[k], factor * weights.c[k]);
      }
    });
  }

  /// S_vv.
  double diagonal(Index v, const StencilWeights& weights) const {
    double sum = 0;
    for_stencils(v, [&](Index place, Index s, std::int64_t /*first*/, auto /*width*/) {
      sum += weights.w[s] * weights.c[place] * weights.c[place];
    });
    return sum;
  }

 private:
  static constexpr Index hinge_width = 4;

  /// Calls visit(place, s, first, width) for each stencil s at v. Its `width` vertices begin at
  /// position `first` of stencils_.value, and v is at position `place`.
  template <class Visit>
  void for_stencils(Index v, const Visit& visit) const {
    if (all_are_hinges_) {
      for (const Index place : places_[v]) {
        const Index s = place / hinge_width;
        visit(place, s, std::int64_t{hinge_width} * s,
              std::integral_constant<std::int64_t, hinge_width>{});
      }
      return;
    }
    for (const Index place : places_[v]) {
      const Index s = stencil_of_place_[place];
      visit(place, s, stencils_.first[s], stencils_.first[s + 1] - stencils_.first[s]);
    }
  }

  const CompressedRows& stencils_;
  CompressedRows places_;                // for each vertex, its positions in stencils_.value
  bool all_are_hinges_;                  // four vertices in every stencil: no table is needed
  std::vector<Index> stencil_of_place_;  // one per entry of stencils_.value; empty for hinges
};

}  // namespace ibmfair
