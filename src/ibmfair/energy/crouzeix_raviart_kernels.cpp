#include "ibmfair/energy/crouzeix_raviart_kernels.h"

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

struct FrameKernel {
  IBMFAIR_INLINE static void run(const Index* x, std::int64_t groups, const BlockVertex* vertices,
                                 BlockRow* triangles) {
    const double* X = &vertices->x.x;
    for (std::int64_t g = 0; g < groups; ++g, x += 12, triangles += lane_count) {
      const Lanes3 x0 = gather(X, x).xyz, x1 = gather(X, x + 4).xyz, x2 = gather(X, x + 8).xyz;
      const Lanes3 N = cross(x0 - x2, x1 - x0);
      const Lanes length = sqrt(dot(N, N));
      store_rows(N / length, 0.5 * length, &triangles->x);
    }
  }
};

// E_hinge = k |e|^2 s with k = 3 / A (1 without mass) and s = 1 + cos(theta) = |n - n'|^2 / 2: by
// this difference it keeps its digits near flat hinges, where the sum loses them. Its derivatives
// by the normal and the area of one triangle and by the edge are summed over the triangle's hinges
// and then carried to its corners: together [W07] (15), f^B by the normal, f^P by area and edge.
// A bounded hinge has u / (1 + u / bound) in place of u = k |e|^2 s.
template <bool mass, bool gradient, bool bounded>
struct HingeKernel {
  struct Derivatives {
    Lanes energy = {}, area = {};
    Lanes turn = {};  // the largest |n - n'|^2
    Lanes3 normal = {};

    /// Returns that by the edge e, of which the other triangle contributes as much.
    IBMFAIR_INLINE Lanes3 add(const Lanes3& e, const Lanes4& own, const Lanes4& other,
                              double inverse_bound) {
      Lanes k = mass ? 3.0 / (own.w + other.w) : Lanes{1, 1, 1, 1};
      const Lanes inverse_area = k;  // three times
      const Lanes3 d = own.xyz - other.xyz;
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

  /// The forces at x1 and x2 are p x e + f, e the opposite edge; at x0 what makes their sum 0.
  struct Forces {
    Lanes3 e1, e2, p, f1, f2;
  };

  IBMFAIR_INLINE static HingeSums run(const Index* x, const Index* neighbours,
                                      std::int64_t own_groups, std::int64_t groups,
                                      double inverse_bound, BlockVertex* vertices,
                                      const BlockRow* triangles) {
    constexpr std::int64_t group_size = std::int64_t{lane_count} * row_size;
    constexpr Index consecutive[lane_count] = {0, row_size, 2 * row_size, 3 * row_size};
    const double *X = &vertices->x.x, *T = &triangles->x;
    Lanes E = {}, turn = {};
    Forces forces[run_length];
    for (std::int64_t first = 0; first < groups; first += run_length) {
      const std::int64_t last = first + run_length < groups ? first + run_length : groups;
      for (std::int64_t g = first; g < last; ++g) {
        const Index *corner = x + 12 * g, *neighbour = neighbours + 12 * g;
        const Lanes3 x0 = gather(X, corner).xyz, x1 = gather(X, corner + 4).xyz;
        const Lanes3 x2 = gather(X, corner + 8).xyz;
        const Lanes3 e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
        const Lanes4 own = gather(T + group_size * g, consecutive);
        Derivatives d;
        const Lanes3 f0 = d.add(e0, own, gather(T, neighbour), inverse_bound);
        const Lanes3 f1 = d.add(e1, own, gather(T, neighbour + 4), inverse_bound);
        const Lanes3 f2 = d.add(e2, own, gather(T, neighbour + 8), inverse_bound);
        turn = larger(turn, d.turn);
        if (g < own_groups) {
          E += d.energy;
        }
        if (gradient) {
          const Lanes3& n = own.xyz;
          const Lanes3 tangential = d.normal - dot(n, d.normal) * n;
          Lanes3 p = 0.5 / own.w * tangential;  // the derivative by N = 2 area n
          if (mass) {
            p = p + 1.0 / 6.0 * d.area * n;
          }
          forces[g - first] = {e1, e2, p, f2 - f0, f0 - f1};
        }
      }
      for (std::int64_t g = first; gradient && g < last; ++g) {
        const auto& [e1, e2, p, f1, f2] = forces[g - first];
        scatter_add_balanced(cross(p, e1) + f1, cross(p, e2) + f2, &vertices->sum.x, x + 12 * g);
      }
    }
    return {sum(E) / 2, largest(turn) / 2};
  }
};

}  // namespace

void crouzeix_raviart_frames(const Index* corners, std::int64_t groups, const BlockVertex* vertices,
                             BlockRow* triangles) {
  run<FrameKernel>(corners, groups, vertices, triangles);
}

HingeSums crouzeix_raviart_hinges(const MeshBlock& block, const Index* corners,
                                  const Index* neighbours, const HingeTerms& terms, bool gradient,
                                  BlockVertex* vertices, const BlockRow* triangles) {
  const auto run_as = [&]<bool mass, bool with_gradient, bool bounded>() {
    return run<HingeKernel<mass, with_gradient, bounded>>(corners, neighbours, block.own_groups,
                                                          block.groups, terms.inverse_bound,
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
