#include "ibmfair/energy/lagrange_kernels.h"

#include "ibmfair/energy/fan_lanes.h"

namespace ibmfair {
namespace {

// Of the triangle x0, x1, x2 with x0 at the centre of the fan, p = x1 - x0, q = x2 - x0.
template <class Lanes>
struct Frame {
  Lanes3<Lanes> p;  // also q of the triangle before; what follows is not there behind the last one
  Lanes3<Lanes> n;  // half the unit normal
  Lanes inverse;    // 1 / (4 area)
};

template <class Lanes>
struct Fans : FanPlaces {
  Frame<Lanes>* frames;  // triangles + 1
};

/// Calls Kernel::add(fans, vertices) for all fans of the groups.
template <class Kernel, class Lanes>
IBMFAIR_INLINE void add_all(const FanRange& range, bool keep, BlockVertex* vertices,
                            FanFrame* frames) {
  static_assert(lanes_per_group / lane_count<Lanes> * sizeof(Frame<Lanes>) == sizeof(FanFrame));
  const FanGroup* group = range.block.fans.data() + range.first;
  for (const FanGroup* end = group + range.groups; group != end; ++group) {
    const Index* centres = range.block.corners.data() + group->first_place;
    auto* kept = reinterpret_cast<Frame<Lanes>*>(frames + (keep ? group->first_row : 0));
    for (int first = 0; first < lanes_per_group; first += lane_count<Lanes>) {
      Kernel::add(Fans<Lanes>{{centres + first, group->triangles}, kept}, vertices);
      kept += group->triangles + 1;
    }
  }
}

// With spontaneous curvature H0_v, h_v - H0_v a_v takes the place of h_v, where a_v is the gradient
// of the enclosed volume: a sixth of N, the double area vector, from every triangle at v.
template <bool spontaneous>
struct Curvature {
  /// From N and |N|^2. Returns the area.
  template <class Lanes>
  IBMFAIR_INLINE static Lanes finish_frame(const Lanes4<Lanes>& N, Frame<Lanes>& frame) {
    const Lanes length = sqrt(N.w);
    // By |N|^2, not by the length: the division need not wait for the square root.
    frame.inverse = 0.5 / N.w * length;
    const Lanes3<Lanes> n = frame.inverse * N.xyz;
    // Half of the unit's length to the last digit: in a plane z = 0 it is 1/2, and h_v is 0.
    frame.n = n + (0.5 - 2.0 * dot(n, n)) * n;
    return 0.5 * length;
  }

  template <class Lanes>
  IBMFAIR_INLINE static void find_frames(const Fans<Lanes>& fans, const double* X, Lanes* areas) {
    const Lanes3<Lanes> centre = gather<Lanes>(X, fans.centre).xyz;
    Frame<Lanes>* frame = fans.frames;
    frame->p = gather<Lanes>(X, fans.rim(0)).xyz - centre;
    Lanes4<Lanes> N = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      frame[1].p = gather<Lanes>(X, fans.rim(i + 1)).xyz - centre;
      const Lanes3<Lanes> next = cross(frame[0].p, frame[1].p);
      if (i > 0) {
        *areas++ = finish_frame(N, frame[-1]);  // while the next are under way
      }
      N = {next, dot(next, next)};
      ++frame;
    }
    *areas = finish_frame(N, frame[-1]);
  }

  template <class Lanes>
  IBMFAIR_INLINE static void add(const Fans<Lanes>& fans, BlockVertex* vertices) {
    const double* X = &vertices->x.x;
    VertexSums<Lanes> sums(vertices);
    Lanes areas[longest_fan];
    find_frames(fans, X, areas);
    const Lanes H0 = spontaneous ? gather<Lanes>(X, fans.centre).w : Lanes{};
    Lanes3<Lanes> h = {}, h0 = {};
    Lanes area = {}, area0 = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const auto& [p, n, inverse] = fans.frames[i];
      h = h + cross(fans.frames[i + 1].p, n);
      Lanes3<Lanes> next = cross(n, p);
      if (spontaneous) {
        const Lanes3<Lanes> a = 2.0 / 3.0 * areas[i] * n;
        const Lanes H1 = gather<Lanes>(X, fans.rim(i)).w, H2 = gather<Lanes>(X, fans.rim(i + 1)).w;
        h = h - H1 * a;
        next = next - H2 * a;
        h0 = h0 - (H0 + H1 + H2) * a;
      }
      sums.add(h, area + areas[i], fans.rim(i));
      h0 = h0 - h;
      area0 = area0 + areas[i];
      h = next;
      area = areas[i];
    }
    sums.add(h, area, fans.rim(fans.triangles));
    sums.add(h0 - h, area0, fans.centre);
    sums.finish();
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const FanRange* range, bool keep, BlockVertex* vertices,
                                 FanFrame* frames) {
    add_all<Curvature, Lanes>(*range, keep, vertices, frames);
  }
};

// dE = sum_v <y_v, d h_v> - 1/2 |y_v|^2 d m_v: the Hessian of the area applied to y, and the
// derivative of the mass; with spontaneous curvature less H0_v <y_v, d a_v>.
template <bool spontaneous>
struct Forces {
  template <class Lanes>
  IBMFAIR_INLINE static void add(const Fans<Lanes>& fans, BlockVertex* vertices) {
    const double *X = &vertices->x.x, *Y = &vertices->y.x;
    VertexSums<Lanes> sums(vertices);
    const Lanes H0 = spontaneous ? gather<Lanes>(X, fans.centre).w : Lanes{};
    const Lanes4<Lanes> y0 = gather<Lanes>(Y, fans.centre);
    Lanes4<Lanes> y1 = gather<Lanes>(Y, fans.rim(0));
    Lanes3<Lanes> f = y1.xyz - y0.xyz;  // the change of p along y
    Lanes3<Lanes> force = {}, force0 = {};
    for (Index i = 0; i < fans.triangles; ++i) {
      const auto& [p, n, s] = fans.frames[i];
      const Lanes3<Lanes>& q = fans.frames[i + 1].p;
      const Lanes4<Lanes> y2 = gather<Lanes>(Y, fans.rim(i + 1));
      const Lanes3<Lanes> g = y2.xyz - y0.xyz;  // of q
      // The change of the normal is that of a plane over which the triangle's corners rise by
      // 2 <n, y>, and the gradient of the area changes along the normal by its slope.
      const Lanes3<Lanes> slope = 4.0 * s * (dot(n, g) * p - dot(n, f) * q);
      const Lanes by_mass = y0.w + y1.w + y2.w;
      force = force + (cross(g - by_mass * q, n) - dot(slope, q) * n);
      Lanes3<Lanes> next = cross(n, f - by_mass * p) + dot(slope, p) * n;
      if (spontaneous) {
        const Lanes H1 = gather<Lanes>(X, fans.rim(i)).w, H2 = gather<Lanes>(X, fans.rim(i + 1)).w;
        const Lanes3<Lanes> H0_y = (H0 * y0.xyz + H1 * y1.xyz + H2 * y2.xyz) / (Lanes{} + 6.0);
        force = force - cross(q, H0_y);
        next = next - cross(H0_y, p);
      }
      sums.add(force, Lanes{}, fans.rim(i));
      force0 = force0 - force;
      force = next;
      f = g;
      y1 = y2;
    }
    sums.add(force, Lanes{}, fans.rim(fans.triangles));
    sums.add(force0 - force, Lanes{}, fans.centre);
    sums.finish();
  }

  template <class Lanes>
  IBMFAIR_INLINE static void run(const FanRange* range, BlockVertex* vertices, FanFrame* frames) {
    add_all<Forces, Lanes>(*range, true, vertices, frames);
  }
};

}  // namespace

void lagrange_curvature(const FanRange& fans, bool spontaneous, bool keep, BlockVertex* vertices,
                        FanFrame* frames) {
  if (spontaneous) {
    run_in_lanes<Curvature<true>>(&fans, keep, vertices, frames);
  } else {
    run_in_lanes<Curvature<false>>(&fans, keep, vertices, frames);
  }
}

void lagrange_forces(const FanRange& fans, bool spontaneous, BlockVertex* vertices,
                     FanFrame* frames) {
  if (spontaneous) {
    run_in_lanes<Forces<true>>(&fans, vertices, frames);
  } else {
    run_in_lanes<Forces<false>>(&fans, vertices, frames);
  }
}

}  // namespace ibmfair
