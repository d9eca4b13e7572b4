#include "ibmfair/energy/crouzeix_raviart_kernels.h"

#include "ibmfair/energy/fan_lanes.h"

namespace ibmfair {
namespace {

/// From the double area vector N and |N|^2.
template <class Lanes>
IBMFAIR_INLINE void store_frame(const Lanes4<Lanes>& N, Row4* row) {
  const Lanes length = sqrt(N.w);
  const Lanes3<Lanes> n = half_unit(N.xyz, length, half_inverse(N.w, length));
  store_rows<Lanes>(n, 1.0 / 12.0 * length, &row->x);
}

struct FrameKernel {
  template <class Lanes>
  IBMFAIR_INLINE static void find(const FanPlaces& fans, const double* X, Row4* row) {
    const Lanes3<Lanes> centre = gather<Lanes>(X, fans.centre).xyz;
    Lanes3<Lanes> p = gather<Lanes>(X, fans.rim(0)).xyz - centre;
    Lanes4<Lanes> N = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const Lanes3<Lanes> q = gather<Lanes>(X, fans.rim(i + 1)).xyz - centre;
      const Lanes3<Lanes> next = cross(p, q);
      if (i > 0) {
        store_frame(N, row);  // while the next are under way
        row += lanes_per_group;
      }
      N = {next, dot(next, next)};
      p = q;
    }
    store_frame(N, row);
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const BlockPass* pass, const BlockVertex* vertices, Row4* frames) {
    const FanGroup* group = pass->block.fans.data();
    BlockPrefetch fetch = pass->fetch;
    for (const FanGroup* end = group + pass->groups; group != end; ++group) {
      for (int first = 0; first < lanes_per_group; first += lane_count<Lanes>) {
        const FanPlaces fans{pass->block.corners.data() + group->first_place + first,
                             group->triangles};
        find<Lanes>(fans, &vertices->x.x, frames + lanes_per_group * group->first_row + first);
      }
      fetch.step();
    }
  }
};

// E_hinge = k |e|^2 s with k = 3 / A (1 without mass) and s = 1 + cos(theta) = |n - n'|^2 / 2: by
// this difference it keeps its digits near flat hinges, where the sum loses them. Its derivatives
// by the normals and the areas of the triangles and by the edge are summed over a triangle's hinges
// and then carried to its corners: together [W07] (15), f^B by the normal, f^P by area and edge.
// A bounded hinge has u / (1 + u / bound) in place of u = k |e|^2 s.
//
// Of a fan's hinges the spokes between two of its triangles are taken once. Those at its rim and
// its two ends are another fan's, too, and each takes half of them.
template <bool mass, bool gradient, bool bounded>
struct HingeKernel {
  template <class Lanes>
  struct Hinge {
    Lanes energy, turn;    // |n - n'|^2 / 4
    Lanes edge;            // the derivative by the edge e, over 2 e
    Lanes3<Lanes> normal;  // by n, but for what is along it, and by n' with the other sign
    Lanes area;            // by the area of either triangle, times -6
  };

  template <class Lanes>
  IBMFAIR_INLINE static Hinge<Lanes> hinge(const Lanes3<Lanes>& e, const Lanes4<Lanes>& t,
                                           const Lanes4<Lanes>& other, double inverse_bound) {
    const Lanes double_k = mass ? 1.0 / (t.w + other.w) : Lanes{} + 2.0;
    const Lanes3<Lanes> d = t.xyz - other.xyz;  // (n - n') / 2
    const Lanes turn = dot(d, d), squared = dot(e, e);
    Lanes slope = double_k;  // as the energy is bounded
    Lanes energy = squared * (double_k * turn);
    if (bounded) {
      const Lanes share = 1.0 / (1.0 + inverse_bound * energy);
      energy *= share;
      slope *= share * share;
    }
    const Lanes edge = slope * turn;
    return {energy, turn, edge, slope * squared * d, squared * edge * double_k};
  }

  /// Of a few fans side by side: the vertices of the rim, from the centre, and the derivatives of
  /// the energy by these and by the edges of the rim, over these themselves, and by the double area
  /// vectors N = 2 area n.
  template <class Lanes>
  struct Slopes {
    Lanes3<Lanes> p[longest_fan + 1];
    Lanes spoke[longest_fan + 1], rim[longest_fan];
    Lanes3<Lanes> N[longest_fan];
  };

  template <class Lanes>
  struct Sums {
    Lanes energy = {}, turn = {};
  };

  /// `row` is that of the first triangle.
  template <class Lanes>
  IBMFAIR_INLINE static Sums<Lanes> find(const FanPlaces& fans, const Index* neighbours,
                                         double inverse_bound, const double* X, const Row4* frames,
                                         const Row4* row, Slopes<Lanes>& slopes) {
    const Lanes3<Lanes> centre = gather<Lanes>(X, fans.centre).xyz;
    for (Index i = 0; i <= fans.triangles; ++i) {
      slopes.p[i] = gather<Lanes>(X, fans.rim(i)).xyz - centre;
    }
    Lanes4<Lanes> t = load_rows<Lanes>(&row->x);
    Hinge<Lanes> before =
        hinge(slopes.p[0], gather<Lanes>(&frames->x, neighbours), t, inverse_bound);
    slopes.spoke[0] = before.edge;
    Sums<Lanes> sums{before.energy, before.turn};
    for (Index i = 0; i < fans.triangles; ++i) {
      const bool last = i + 1 == fans.triangles;
      const double halves = last ? 1.0 : 2.0;
      neighbours += lanes_per_group;
      row += lanes_per_group;
      const Lanes4<Lanes> next = last ? gather<Lanes>(&frames->x, neighbours + lanes_per_group)
                                      : load_rows<Lanes>(&row->x);
      const Hinge<Lanes> rim = hinge(slopes.p[i + 1] - slopes.p[i], t,
                                     gather<Lanes>(&frames->x, neighbours), inverse_bound);
      const Hinge<Lanes> after = hinge(slopes.p[i + 1], t, next, inverse_bound);
      sums.energy += rim.energy + halves * after.energy;
      sums.turn = larger(sums.turn, larger(rim.turn, after.turn));
      if (gradient) {
        slopes.rim[i] = rim.edge;
        slopes.spoke[i + 1] = halves * after.edge;
        const Lanes3<Lanes> by_normal = rim.normal + after.normal - before.normal;
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

  template <class Lanes>
  IBMFAIR_INLINE static void add_forces(const FanPlaces& fans, const Slopes<Lanes>& slopes,
                                        BlockVertex* vertices) {
    const auto& [p, spoke, rim, N] = slopes;
    VertexSums<Lanes> sums(vertices);
    Lanes3<Lanes> force = spoke[0] * p[0], at_centre = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const Lanes3<Lanes> f = rim[i] * (p[i + 1] - p[i]);
      force = force + (cross(p[i + 1], N[i]) - f);
      sums.add(force, Lanes{}, fans.rim(i));
      at_centre = at_centre - force;
      force = spoke[i + 1] * p[i + 1] + (cross(N[i], p[i]) + f);
    }
    sums.add(force, Lanes{}, fans.rim(fans.triangles));
    sums.add(at_centre - force, Lanes{}, fans.centre);
    sums.finish();
  }

  template <class Lanes>
  IBMFAIR_INLINE static HingeSums run(const BlockPass* pass, double inverse_bound,
                                      BlockVertex* vertices, const Row4* frames) {
    const MeshBlock& block = pass->block;
    Four energy = {}, turn = {};
    Slopes<Lanes> slopes;
    BlockPrefetch fetch = pass->fetch;
    for (std::int64_t g = 0; g < pass->groups; ++g) {
      const FanGroup& group = block.fans[g];
      for (int first = 0; first < lanes_per_group; first += lane_count<Lanes>) {
        const std::int64_t place = group.first_place + first;
        const FanPlaces fans{block.corners.data() + place, group.triangles};
        const Sums<Lanes> sums =
            find<Lanes>(fans, block.neighbours.data() + place, inverse_bound, &vertices->x.x,
                        frames, frames + lanes_per_group * group.first_row + first, slopes);
        raise_to(turn, sums.turn);
        if (g < block.own_groups) {
          add_to(energy, sums.energy);
        }
        if (gradient) {
          add_forces(fans, slopes, vertices);
        }
      }
      fetch.step();
    }
    return {sum(energy) / 2, 2 * largest(turn)};
  }
};

}  // namespace

void crouzeix_raviart_frames(const BlockPass& pass, const BlockVertex* vertices, Row4* triangles) {
  run_in_lanes<FrameKernel>(&pass, vertices, triangles);
}

HingeSums crouzeix_raviart_hinges(const BlockPass& pass, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const Row4* triangles) {
  const auto run_as = [&]<bool mass, bool with_gradient, bool bounded>() {
    return run_in_lanes<HingeKernel<mass, with_gradient, bounded>>(&pass, terms.inverse_bound,
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
