#include "ibmfair/energy/crouzeix_raviart_kernels.h"

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

/// How many triangles a kernel takes through one of its stages before the next. Square roots and
/// divisions take so long that they must be under way for many triangles at once, and of long
/// stages only the work on a few has room in the processor's queue.
constexpr std::int64_t run_length = 64;

/// Where a block lists the first places of triangle t and of those after it in its group. The
/// second ones stand `lanes_per_group` further on, and the third ones as far behind these.
IBMFAIR_INLINE const Index* places_of(const Index* listed, std::int64_t t) {
  return listed + 3 * t - 2 * (t % lanes_per_group);
}

/// The rows of a triangle's three corners, or of what else it has three of.
template <class Lanes>
struct ThreeRows {
  Lanes4<Lanes> first, second, third;
};

template <class Lanes>
IBMFAIR_INLINE ThreeRows<Lanes> gather_three(const double* rows, const Index* at) {
  const Index *at_second = at + lanes_per_group, *at_third = at_second + lanes_per_group;
  return {gather<Lanes>(rows, at), gather<Lanes>(rows, at_second), gather<Lanes>(rows, at_third)};
}

/// Adds b and c to the rows of the second and the third corner, and -(b + c) to those of the first:
/// three forces that sum to 0. One triangle after the other, for their corners may coincide; and
/// all three of one before the next, so that sums do not depend on which of them comes first.
template <class Lanes>
IBMFAIR_INLINE void scatter_add_balanced(const Lanes3<Lanes>& b, const Lanes3<Lanes>& c,
                                         double* rows, const Index* at) {
  Four row_b[lane_count<Lanes>], row_c[lane_count<Lanes>];
  rows_of(b, Lanes{}, row_b);
  rows_of(c, Lanes{}, row_c);
  for (int i = 0; i < lane_count<Lanes>; ++i) {
    add_to_row(-(row_b[i] + row_c[i]), rows + at[i]);
    add_to_row(row_b[i], rows + at[lanes_per_group + i]);
    add_to_row(row_c[i], rows + at[2 * lanes_per_group + i]);
  }
}

struct FrameKernel {
  /// The double area vectors N and |N|^2.
  template <class Lanes>
  IBMFAIR_INLINE static Lanes4<Lanes> normals(const Index* corners, const BlockVertex* vertices) {
    const auto [x0, x1, x2] = gather_three<Lanes>(&vertices->x.x, corners);
    const Lanes3<Lanes> N = cross(x0.xyz - x2.xyz, x1.xyz - x0.xyz);
    return {N, dot(N, N)};
  }

  template <class Lanes>
  IBMFAIR_INLINE static void store(const Lanes4<Lanes>& N, BlockRow* frames) {
    const Lanes length = sqrt(N.w);
    store_rows<Lanes>(N.xyz / length, 0.5 * length, &frames->x);
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const Index* corners, std::int64_t triangles,
                                 const BlockVertex* vertices, BlockRow* frames) {
    constexpr int n = lane_count<Lanes>;
    Lanes4<Lanes> N = normals<Lanes>(corners, vertices);
    for (std::int64_t t = n; t < triangles; t += n) {
      const Lanes4<Lanes> next = normals<Lanes>(places_of(corners, t), vertices);
      store(N, &frames[t - n]);  // while the next are under way
      N = next;
    }
    store(N, &frames[triangles - n]);
  }
};

// E_hinge = k |e|^2 s with k = 3 / A (1 without mass) and s = 1 + cos(theta) = |n - n'|^2 / 2: by
// this difference it keeps its digits near flat hinges, where the sum loses them. Its derivatives
// by the normal and the area of one triangle and by the edge are summed over the triangle's hinges
// and then carried to its corners: together [W07] (15), f^B by the normal, f^P by area and edge.
// A bounded hinge has u / (1 + u / bound) in place of u = k |e|^2 s.
template <bool mass, bool gradient, bool bounded>
struct HingeKernel {
  template <class Lanes>
  struct Derivatives {
    Lanes energy = {}, area = {};
    Lanes turn = {};  // the largest |n - n'|^2
    Lanes3<Lanes> normal = {};

    /// Returns that by the edge e, of which the other triangle contributes as much.
    IBMFAIR_INLINE Lanes3<Lanes> add(const Lanes3<Lanes>& e, const Lanes4<Lanes>& own,
                                     const Lanes4<Lanes>& other, double inverse_bound) {
      Lanes k = mass ? 3.0 / (own.w + other.w) : Lanes{} + 1.0;
      const Lanes inverse_area = k;  // three times
      const Lanes3<Lanes> d = own.xyz - other.xyz;
      const Lanes squared = dot(d, d);
      turn = larger(turn, squared);
      Lanes ks = 0.5 * k * squared;
      if (bounded) {
        const Lanes share = 1.0 / (1.0 + inverse_bound * dot(e, e) * ks);
        energy += dot(e, e) * ks * share;
        k *= share * share;
        ks *= share * share;
      } else {
        energy += dot(e, e) * ks;
      }
      if (mass) {
        area -= dot(e, e) * ks * inverse_area;  // dE/dA = -E / A
      }
      normal = normal + k * dot(e, e) * d;
      return ks * e;
    }
  };

  /// Each opposite the corner of its number.
  template <class Lanes>
  struct OppositeEdges {
    Lanes3<Lanes> e0, e1, e2;
  };

  /// The forces at x1 and x2 are p x e + f, e the opposite edge; at x0 what makes their sum 0.
  template <class Lanes>
  struct Forces {
    Lanes3<Lanes> p, f1, f2;
  };

  template <class Lanes>
  IBMFAIR_INLINE static HingeSums run(const Index* corners, const Index* neighbours,
                                      std::int64_t own_triangles, std::int64_t triangles,
                                      double inverse_bound, BlockVertex* vertices,
                                      const BlockRow* frames) {
    constexpr int n = lane_count<Lanes>;
    Four E = {}, turn = {};
    OppositeEdges<Lanes> edges[run_length / n];
    Forces<Lanes> forces[run_length / n];
    for (std::int64_t first = 0; first < triangles; first += run_length) {
      const std::int64_t last = first + run_length < triangles ? first + run_length : triangles;
      for (std::int64_t t = first; t < last; t += n) {
        const auto [x0, x1, x2] = gather_three<Lanes>(&vertices->x.x, places_of(corners, t));
        edges[(t - first) / n] = {x2.xyz - x1.xyz, x0.xyz - x2.xyz, x1.xyz - x0.xyz};
      }
      for (std::int64_t t = first; t < last; t += n) {
        const auto& [e0, e1, e2] = edges[(t - first) / n];
        const auto own = load_rows<Lanes>(&frames[t].x);
        const auto [t0, t1, t2] = gather_three<Lanes>(&frames->x, places_of(neighbours, t));
        Derivatives<Lanes> d;
        const Lanes3<Lanes> f0 = d.add(e0, own, t0, inverse_bound);
        const Lanes3<Lanes> f1 = d.add(e1, own, t1, inverse_bound);
        const Lanes3<Lanes> f2 = d.add(e2, own, t2, inverse_bound);
        raise_to(turn, d.turn);
        if (t < own_triangles) {
          add_to(E, d.energy);
        }
        if (gradient) {
          const Lanes3<Lanes>& normal = own.xyz;
          const Lanes3<Lanes> tangential = d.normal - dot(normal, d.normal) * normal;
          Lanes3<Lanes> p = 0.5 / own.w * tangential;  // the derivative by N = 2 area n
          if (mass) {
            p = p + 1.0 / 6.0 * d.area * normal;
          }
          forces[(t - first) / n] = {p, f2 - f0, f0 - f1};
        }
      }
      for (std::int64_t t = first; gradient && t < last; t += n) {
        const auto& [e0, e1, e2] = edges[(t - first) / n];
        const auto& [p, f1, f2] = forces[(t - first) / n];
        scatter_add_balanced(cross(p, e1) + f1, cross(p, e2) + f2, &vertices->sum.x,
                             places_of(corners, t));
      }
    }
    return {sum(E) / 2, largest(turn) / 2};
  }
};

}  // namespace

void crouzeix_raviart_frames(const Index* corners, std::int64_t groups, const BlockVertex* vertices,
                             BlockRow* triangles) {
  run_in_lanes<FrameKernel>(corners, lanes_per_group * groups, vertices, triangles);
}

HingeSums crouzeix_raviart_hinges(const MeshBlock& block, const Index* corners,
                                  const Index* neighbours, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const BlockRow* triangles) {
  const auto run_as = [&]<bool mass, bool with_gradient, bool bounded>() {
    return run_in_lanes<HingeKernel<mass, with_gradient, bounded>>(
        corners, neighbours, lanes_per_group * block.own_groups, lanes_per_group * block.groups,
        terms.inverse_bound, vertices, triangles);
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
