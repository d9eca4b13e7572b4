#include "ibmfair/energy/lagrange_kernels.h"

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

/// What both loops need of four triangles.
struct Frames {
  Lanes3 e0, e1, e2;  // the edges opposite x0, x1, x2
  Lanes3 n;           // half the unit normal
  Lanes area;
};

IBMFAIR_INLINE void find_frames(const Index* x, std::int64_t groups, const double* X,
                                Frames* frames) {
  for (std::int64_t g = 0; g < groups; ++g, x += 12) {
    const Lanes3 x0 = gather(X, x).xyz, x1 = gather(X, x + 4).xyz, x2 = gather(X, x + 8).xyz;
    const Lanes3 e0 = x2 - x1, e1 = x0 - x2, e2 = x1 - x0;
    const Lanes3 N = cross(e1, e2);
    const Lanes length = sqrt(dot(N, N));
    // Divided, not multiplied by an inverse: in a plane z = 0 it is 1/2 to the last digit.
    frames[g] = {e0, e1, e2, N / (2.0 * length), 0.5 * length};
  }
}

// With spontaneous curvature H0_v, h_v - H0_v a_v takes the place of h_v, where a_v is the gradient
// of the enclosed volume: a sixth of N, the double area vector, from every triangle at v.
template <bool spontaneous>
struct Curvature {
  IBMFAIR_INLINE static void run(const Index* x, std::int64_t groups, BlockVertex* vertices) {
    const double* X = &vertices->x.x;
    double* h = &vertices->sum.x;
    Frames frames[run_length];
    for (; groups > 0; groups -= run_length) {
      const std::int64_t length = groups < run_length ? groups : run_length;
      find_frames(x, length, X, frames);
      for (std::int64_t g = 0; g < length; ++g, x += 12) {
        const auto& [e0, e1, e2, n, area] = frames[g];
        Lanes3 h0 = cross(n, e0), h1 = cross(n, e1), h2 = cross(n, e2);
        if (spontaneous) {
          const Lanes3 a = 2.0 / 3.0 * area * n;
          h0 = h0 - gather(X, x).w * a;
          h1 = h1 - gather(X, x + 4).w * a;
          h2 = h2 - gather(X, x + 8).w * a;
        }
        scatter_add(h0, h1, h2, area, h, x);
      }
    }
  }
};

// dE = sum_v <y_v, d h_v> - 1/2 |y_v|^2 d m_v: the Hessian of the area applied to y, and the
// derivative of the mass; with spontaneous curvature less H0_v <y_v, d a_v>.
template <bool spontaneous>
struct Forces {
  /// At each corner the force is p x e + n x f, e the opposite edge and f its change along y.
  struct Factors {
    Lanes3 f1, f2, p;
  };

  IBMFAIR_INLINE static void run(const Index* x, std::int64_t groups, BlockVertex* vertices) {
    const double *X = &vertices->x.x, *y = &vertices->y.x;
    double* G = &vertices->sum.x;
    Frames frames[run_length];
    Factors factors[run_length];
    for (; groups > 0; groups -= run_length, x += 12 * run_length) {
      const std::int64_t length = groups < run_length ? groups : run_length;
      find_frames(x, length, X, frames);
      for (std::int64_t g = 0; g < length; ++g) {
        const auto& [e0, e1, e2, n, area] = frames[g];
        const auto [y0, q0] = gather(y, x + 12 * g);
        const auto [y1, q1] = gather(y, x + 12 * g + 4);
        const auto [y2, q2] = gather(y, x + 12 * g + 8);
        const Lanes3 f1 = y0 - y2, f2 = y1 - y0;
        const Lanes3 dN = cross(f1, e2) + cross(e1, f2);
        const Lanes3 dn = 0.25 / area * (dN - 4.0 * dot(n, dN) * n);
        Lanes3 p = dn - (q0 + q1 + q2) * n;
        if (spontaneous) {
          const Index* v = x + 12 * g;
          const Lanes3 H0_y =
              gather(X, v).w * y0 + gather(X, v + 4).w * y1 + gather(X, v + 8).w * y2;
          p = p - H0_y / Lanes{6, 6, 6, 6};
        }
        factors[g] = {f1, f2, p};
      }
      for (std::int64_t g = 0; g < length; ++g) {
        const auto& [e0, e1, e2, n, area] = frames[g];
        const auto& [f1, f2, p] = factors[g];
        const Lanes3 g1 = cross(p, e1) + cross(n, f1), g2 = cross(p, e2) + cross(n, f2);
        scatter_add_balanced(g1, g2, G, x + 12 * g);
      }
    }
  }
};

}  // namespace

void lagrange_curvature(const Index* corners, std::int64_t groups, bool spontaneous,
                        BlockVertex* vertices) {
  if (spontaneous) {
    run<Curvature<true>>(corners, groups, vertices);
  } else {
    run<Curvature<false>>(corners, groups, vertices);
  }
}

void lagrange_forces(const Index* corners, std::int64_t groups, bool spontaneous,
                     BlockVertex* vertices) {
  if (spontaneous) {
    run<Forces<true>>(corners, groups, vertices);
  } else {
    run<Forces<false>>(corners, groups, vertices);
  }
}

}  // namespace ibmfair
