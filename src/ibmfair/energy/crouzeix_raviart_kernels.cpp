#include "ibmfair/energy/crouzeix_raviart_kernels.h"

#include "ibmfair/energy/fan_lanes.h"

namespace ibmfair {
namespace {

/// Stores the frame of a triangle, from its double area vector N.xyz and N.w = |N|^2.
IBMFAIR_INLINE void store_frame(const Lanes4& N, Row4* row) {
  const Lanes length = sqrt(N.w);
  const Lanes3 n = half_unit(N.xyz, length, half_inverse(N.w, length));
  store_rows(n, 1.0 / 12.0 * length, &row->x);
}

struct FrameKernel {
  IBMFAIR_INLINE static void find(const FanPlaces& fans, const double* X, Row4* row) {
    const Lanes3 centre = gather(X, fans.centre).xyz;
    Lanes3 p = gather(X, fans.rim(0)).xyz - centre;
    Lanes4 N = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const Lanes3 q = gather(X, fans.rim(i + 1)).xyz - centre;
      const Lanes3 next = cross(p, q);
      if (i > 0) {
        store_frame(N, row);  // overlaps with the computation of the next N
        row += fans_per_group;
      }
      N = {next, dot(next, next)};
      p = q;
    }
    store_frame(N, row);
  }

  IBMFAIR_INLINE static void run(const BlockPass* pass, const BlockVertex* vertices, Row4* frames) {
    const FanGroup* group = pass->block.fans.data();
    BlockPrefetch fetch = pass->fetch;
    for (const FanGroup* end = group + pass->groups; group != end; ++group) {
      const FanPlaces fans{pass->block.corners.data() + group->first_place, group->triangles};
      find(fans, &vertices->x.x, frames + fans_per_group * group->first_row);
      fetch.step();
    }
  }
};

// E_hinge = k |e|^2 s with k = 3 / A (1 without mass) and s = 1 + cos(theta) = |n - n'|^2 / 2. This
// difference keeps its digits near flat hinges, where the sum 1 + cos(theta) loses them. The
// derivatives with respect to the normals and areas of the triangles and to the edges are summed
// over a triangle's hinges and then converted to forces on its corners. Together they are [W07]
// (15): f^B from the normals, f^P from areas and edges. For a bounded hinge, u = k |e|^2 s is
// replaced by u / (1 + u / bound).
//
// The hinges at the spokes between two triangles of a fan are evaluated once. The hinges at the rim
// and the two ends of the fan also belong to another fan, and each fan adds half of them.
template <bool mass, bool gradient, bool bounded>
struct HingeKernel {
  struct Hinge {
    Lanes energy, turn;  // |n - n'|^2 / 4
    Lanes edge;          // the derivative with respect to the edge e, divided by 2 e
    Lanes3 normal;       // with respect to n, up to a multiple of n; the opposite sign for n'
    Lanes area;          // with respect to the area of either triangle, times -6
  };

  IBMFAIR_INLINE static Hinge hinge(const Lanes3& e, const Lanes4& t, const Lanes4& other,
                                    double inverse_bound) {
    const Lanes double_k = mass ? 1.0 / (t.w + other.w) : Lanes{} + 2.0;
    const Lanes3 d = t.xyz - other.xyz;  // (n - n') / 2
    const Lanes turn = dot(d, d), squared = dot(e, e);
    Lanes slope = double_k;  // multiplied by d(bounded energy) / d(energy) if bounded
    Lanes energy = squared * (double_k * turn);
    if (bounded) {
      const Lanes share = 1.0 / (1.0 + inverse_bound * energy);
      energy *= share;
      slope *= share * share;
    }
    const Lanes edge = slope * turn;
    return {energy, turn, edge, slope * squared * d, squared * edge * double_k};
  }

  /// For the fans of a group: `p`, the vertices of the rim relative to the centre; `spoke` and
  /// `rim`, the derivatives of the energy with respect to the vectors p and to the edges of the
  /// rim, each divided by the vector itself; `N`, the derivatives with respect to the double area
  /// vectors N = 2 area n.
  struct Slopes {
    Lanes3 p[longest_fan + 1];
    Lanes spoke[longest_fan + 1], rim[longest_fan];
    Lanes3 N[longest_fan];
  };

  struct Sums {
    Lanes energy = {}, turn = {};
  };

  /// `row` is the row of the first triangle.
  IBMFAIR_INLINE static Sums find(const FanPlaces& fans, const Index* neighbours,
                                  double inverse_bound, const double* X, const Row4* frames,
                                  const Row4* row, Slopes& slopes) {
    const Lanes3 centre = gather(X, fans.centre).xyz;
    for (Index i = 0; i <= fans.triangles; ++i) {
      slopes.p[i] = gather(X, fans.rim(i)).xyz - centre;
    }
    Lanes4 t = load_rows(&row->x);
    Hinge before = hinge(slopes.p[0], gather(&frames->x, neighbours), t, inverse_bound);
    slopes.spoke[0] = before.edge;
    Sums sums{before.energy, before.turn};
    for (Index i = 0; i < fans.triangles; ++i) {
      const bool last = i + 1 == fans.triangles;
      const double halves = last ? 1.0 : 2.0;
      neighbours += fans_per_group;
      row += fans_per_group;
      const Lanes4 next =
          last ? gather(&frames->x, neighbours + fans_per_group) : load_rows(&row->x);
      const Hinge rim =
          hinge(slopes.p[i + 1] - slopes.p[i], t, gather(&frames->x, neighbours), inverse_bound);
      const Hinge after = hinge(slopes.p[i + 1], t, next, inverse_bound);
      sums.energy += rim.energy + halves * after.energy;
      sums.turn = larger(sums.turn, larger(rim.turn, after.turn));
      if (gradient) {
        slopes.rim[i] = rim.edge;
        slopes.spoke[i + 1] = halves * after.edge;
        const Lanes3 by_normal = rim.normal + after.normal - before.normal;
        const Lanes inverse_area = 1.0 / 12.0 / t.w;  // 1 / (2 area)
        Lanes along = 4.0 * inverse_area * dot(t.xyz, by_normal);
        if (mass) {
          along += 1.0 / 6.0 * (before.area + rim.area + after.area);
        }
        slopes.N[i] = inverse_area * by_normal - along * t.xyz;
      }
      t = next;
      before = after;
    }
    return sums;
  }

  IBMFAIR_INLINE static void add_forces(const FanPlaces& fans, const Slopes& slopes,
                                        BlockVertex* vertices) {
    const auto& [p, spoke, rim, N] = slopes;
    Lanes3 force = spoke[0] * p[0], at_centre = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const Lanes3 f = rim[i] * (p[i + 1] - p[i]);
      force = force + (cross(p[i + 1], N[i]) - f);
      add_to_vertices(force, Lanes{}, fans.rim(i), vertices);
      at_centre = at_centre - force;
      force = spoke[i + 1] * p[i + 1] + (cross(N[i], p[i]) + f);
    }
    add_to_vertices(force, Lanes{}, fans.rim(fans.triangles), vertices);
    add_to_vertices(at_centre - force, Lanes{}, fans.centre, vertices);
  }

  IBMFAIR_INLINE static HingeSums run(const BlockPass* pass, double inverse_bound,
                                      BlockVertex* vertices, const Row4* frames) {
    const MeshBlock& block = pass->block;
    Lanes energy = {}, turn = {};
    Slopes slopes;
    BlockPrefetch fetch = pass->fetch;
    for (std::int64_t g = 0; g < pass->groups; ++g) {
      const FanGroup& group = block.fans[g];
      const FanPlaces fans{block.corners.data() + group.first_place, group.triangles};
      const Sums sums =
          find(fans, block.neighbours.data() + group.first_place, inverse_bound, &vertices->x.x,
               frames, frames + fans_per_group * group.first_row, slopes);
      turn = larger(turn, sums.turn);
      if (g < block.own_groups) {
        energy += sums.energy;
      }
      if (gradient) {
        add_forces(fans, slopes, vertices);
      }
      fetch.step();
    }
    return {sum(energy) / 2, 2 * largest(turn)};
  }
};

}  // namespace

void crouzeix_raviart_frames(const BlockPass& pass, const BlockVertex* vertices, Row4* triangles) {
  run_kernel<FrameKernel>(&pass, vertices, triangles);
}

HingeSums crouzeix_raviart_hinges(const BlockPass& pass, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const Row4* triangles) {
  const auto run_as = [&]<bool mass, bool with_gradient, bool bounded>() {
    return run_kernel<HingeKernel<mass, with_gradient, bounded>>(&pass, terms.inverse_bound,
                                                                 vertices, triangles);
  };
  const auto run_with = [&]<bool mass, bool with_gradient>() {
    return terms.inverse_bound > 0 ? run_as.template operator()<mass, with_gradient, true>()
                                   : run_as.template operator()<mass, with_gradient, false>();
  };
  return terms.mass
             ? (gradient ? run_with.operator()<true, true>() : run_with.operator()<true, false>())
             : (gradient ? run_with.operator()<false, true>()
                         : run_with.operator()<false, false>());
}

}  // namespace ibmfair
