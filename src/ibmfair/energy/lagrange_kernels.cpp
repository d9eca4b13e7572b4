#include "ibmfair/energy/lagrange_kernels.h"

#include "ibmfair/energy/triangle_lanes.h"

namespace ibmfair {
namespace {

/// What both loops need of a few triangles.
template <class Lanes>
struct Frame {
  Lanes3<Lanes> e1, e2;  // the edges opposite x1 and x2
  Lanes3<Lanes> n;       // half the unit normal
  Lanes size;            // the area; for the forces 1 / (4 area)
};

template <class Lanes>
using Frames = Frame<Lanes>[run_length / lane_count<Lanes>];

/// The edges of a frame. Returns the double area vector N and |N|^2.
template <class Lanes>
IBMFAIR_INLINE Lanes4<Lanes> begin_frame(const Index* corners, const double* X,
                                         Frame<Lanes>& frame) {
  const auto [x0, x1, x2] = gather_three<Lanes>(X, corners);
  frame.e1 = x0.xyz - x2.xyz;
  frame.e2 = x1.xyz - x0.xyz;
  const Lanes3<Lanes> N = cross(frame.e1, frame.e2);
  return {N, dot(N, N)};
}

template <class Kernel, class Lanes>
IBMFAIR_INLINE void find_frames(const Index* corners, std::int64_t first, std::int64_t last,
                                const double* X, Frames<Lanes>& frames) {
  constexpr int n = lane_count<Lanes>;
  Frame<Lanes>* frame = frames;
  Lanes4<Lanes> N = begin_frame(places_of(corners, first), X, *frame);
  for (std::int64_t t = first + n; t < last; t += n) {
    const Lanes4<Lanes> next = begin_frame(places_of(corners, t), X, frame[1]);
    Kernel::finish_frame(N, *frame);  // while the next are under way
    ++frame;
    N = next;
  }
  Kernel::finish_frame(N, *frame);
}

// With spontaneous curvature H0_v, h_v - H0_v a_v takes the place of h_v, where a_v is the gradient
// of the enclosed volume: a sixth of N, the double area vector, from every triangle at v.
template <bool spontaneous>
struct Curvature {
  template <class Lanes>
  IBMFAIR_INLINE static void finish_frame(const Lanes4<Lanes>& N, Frame<Lanes>& frame) {
    const Lanes length = sqrt(N.w);
    // Divided, not multiplied by an inverse: in a plane z = 0 it is 1/2 to the last digit.
    frame.n = N.xyz / (2.0 * length);
    frame.size = 0.5 * length;
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const Index* corners, std::int64_t triangles,
                                 BlockVertex* vertices) {
    const double* X = &vertices->x.x;
    Frames<Lanes> frames;
    for (std::int64_t first = 0; first < triangles; first += run_length) {
      const std::int64_t last = first + run_length < triangles ? first + run_length : triangles;
      find_frames<Curvature, Lanes>(corners, first, last, X, frames);
      for (std::int64_t t = first; t < last; t += lane_count<Lanes>) {
        const auto& [e1, e2, n, area] = frames[(t - first) / lane_count<Lanes>];
        Lanes3<Lanes> h1 = cross(n, e1), h2 = cross(n, e2), h0 = -(h1 + h2);
        const Index* x = places_of(corners, t);
        if (spontaneous) {
          const auto [x0, x1, x2] = gather_three<Lanes>(X, x);
          const Lanes3<Lanes> a = 2.0 / 3.0 * area * n;
          h0 = h0 - x0.w * a;
          h1 = h1 - x1.w * a;
          h2 = h2 - x2.w * a;
        }
        scatter_add(h0, h1, h2, area, &vertices->sum.x, x);
      }
    }
  }
};

// dE = sum_v <y_v, d h_v> - 1/2 |y_v|^2 d m_v: the Hessian of the area applied to y, and the
// derivative of the mass; with spontaneous curvature less H0_v <y_v, d a_v>.
template <bool spontaneous>
struct Forces {
  template <class Lanes>
  IBMFAIR_INLINE static void finish_frame(const Lanes4<Lanes>& N, Frame<Lanes>& frame) {
    frame.size = 0.5 / sqrt(N.w);
    frame.n = frame.size * N.xyz;
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const Index* corners, std::int64_t triangles,
                                 BlockVertex* vertices) {
    const double *X = &vertices->x.x, *y = &vertices->y.x;
    Frames<Lanes> frames;
    for (std::int64_t first = 0; first < triangles; first += run_length) {
      const std::int64_t last = first + run_length < triangles ? first + run_length : triangles;
      find_frames<Forces, Lanes>(corners, first, last, X, frames);
      for (std::int64_t t = first; t < last; t += lane_count<Lanes>) {
        const auto& [e1, e2, n, s] = frames[(t - first) / lane_count<Lanes>];
        const Index* x = places_of(corners, t);
        const auto [y0, y1, y2] = gather_three<Lanes>(y, x);
        const Lanes3<Lanes> f1 = y0.xyz - y2.xyz, f2 = y1.xyz - y0.xyz;
        const Lanes3<Lanes> dN = cross(f1, e2) + cross(e1, f2);
        const Lanes along_n = 4.0 * s * dot(n, dN) + y0.w + y1.w + y2.w;
        Lanes3<Lanes> p = s * dN - along_n * n;
        if (spontaneous) {
          const auto [x0, x1, x2] = gather_three<Lanes>(X, x);
          const Lanes3<Lanes> H0_y = x0.w * y0.xyz + x1.w * y1.xyz + x2.w * y2.xyz;
          p = p - H0_y / (Lanes{} + 6.0);
        }
        // At each corner p x e + n x f, e the opposite edge and f its change along y.
        scatter_add_balanced(cross(p, e1) + cross(n, f1), cross(p, e2) + cross(n, f2),
                             &vertices->sum.x, places_of(corners, t));
      }
    }
  }
};

}  // namespace

void lagrange_curvature(const Index* corners, std::int64_t groups, bool spontaneous,
                        BlockVertex* vertices) {
  if (spontaneous) {
    run_in_lanes<Curvature<true>>(corners, lanes_per_group * groups, vertices);
  } else {
    run_in_lanes<Curvature<false>>(corners, lanes_per_group * groups, vertices);
  }
}

void lagrange_forces(const Index* corners, std::int64_t groups, bool spontaneous,
                     BlockVertex* vertices) {
  if (spontaneous) {
    run_in_lanes<Forces<true>>(corners, lanes_per_group * groups, vertices);
  } else {
    run_in_lanes<Forces<false>>(corners, lanes_per_group * groups, vertices);
  }
}

}  // namespace ibmfair
