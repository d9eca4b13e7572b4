#include "ibmfair/energy/lagrange_kernels.h"

#include "ibmfair/energy/fan_lanes.h"

namespace ibmfair {
namespace {

struct Fans : FanPlaces {
  FanFrame* frames;  // triangles + 1
};

/// Calls Kernel::add(fans, vertices) for all groups of fans.
template <class Kernel>
IBMFAIR_INLINE void add_all(const BlockPass& pass, bool keep, BlockVertex* vertices,
                            FanFrame* frames) {
  const FanGroup* group = pass.block.fans.data();
  BlockPrefetch fetch = pass.fetch;
  for (const FanGroup* end = group + pass.groups; group != end; ++group) {
    const Index* centres = pass.block.corners.data() + group->first_place;
    FanFrame* kept = frames + (keep ? group->first_row : 0);
    Kernel::add(Fans{{centres, group->triangles}, kept}, vertices);
    fetch.step();
  }
}

// With spontaneous curvature H0_v, h_v is replaced by h_v - H0_v a_v, where a_v is the gradient of
// the enclosed volume: a sixth of the double area vector N of every triangle at v.
template <bool spontaneous>
struct Curvature {
  /// Computes the frames except for the normals, for which the double area vectors N are stored,
  /// and the lengths |N|. Operations that depend on a square root or a division are left to the
  /// next loop. The root and the division themselves are started once the next N is being computed,
  /// so that they overlap with it.
  IBMFAIR_INLINE static void start_frames(const Fans& fans, const double* X, Lanes* lengths) {
    const Lanes3 centre = gather(X, fans.centre).xyz;
    Lanes3 p = gather(X, fans.rim(0)).xyz - centre;
    store(fans.frames[0].p, p);
    Lanes squared = {};
    const auto find_length = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      lengths[i] = sqrt(squared);
      store(fans.frames[i].inverse, half_inverse(squared, lengths[i]));
    };
    for (Index i = 0; i < fans.triangles; ++i) {
      const Lanes3 q = gather(X, fans.rim(i + 1)).xyz - centre;
      const Lanes3 N = cross(p, q);
      if (i > 0) {
        find_length(i - 1);
      }
      squared = dot(N, N);
      store(fans.frames[i].n, N);
      store(fans.frames[i + 1].p, q);
      p = q;
    }
    find_length(fans.triangles - 1);
  }

  IBMFAIR_INLINE static void add(const Fans& fans, BlockVertex* vertices) {
    const double* X = &vertices->x.x;
    Lanes lengths[longest_fan];
    start_frames(fans, X, lengths);
    const Lanes H0 = spontaneous ? gather(X, fans.centre).w : Lanes{};
    Lanes3 n = {}, h = {}, next = {}, h0 = {};
    Lanes own = {}, area = {}, area0 = {};
    const auto find_normal = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      n = half_unit(load(fans.frames[i].n), lengths[i], load<Lanes>(fans.frames[i].inverse));
      store(fans.frames[i].n, n);
    };
    const auto find_curvature = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      own = 0.5 * lengths[i];
      area = area + own;
      area0 = area0 + own;
      h = h + cross(load(fans.frames[i + 1].p), n);
      next = cross(n, load(fans.frames[i].p));
      if (spontaneous) {
        const Lanes3 a = 2.0 / 3.0 * own * n;
        const Lanes H1 = gather(X, fans.rim(i)).w, H2 = gather(X, fans.rim(i + 1)).w;
        h = h - H1 * a;
        next = next - H2 * a;
        h0 = h0 - (H0 + H1 + H2) * a;
      }
    };
    const auto put = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      add_to_vertices(h, area, fans.rim(i), vertices);
      h0 = h0 - h;
      h = next;
      area = own;
    };
    overlapping(fans.triangles, find_normal, find_curvature, put);
    add_to_vertices(h, area, fans.rim(fans.triangles), vertices);
    add_to_vertices(h0 - h, area0, fans.centre, vertices);
  }

  IBMFAIR_INLINE static void run(const BlockPass* pass, bool keep, BlockVertex* vertices,
                                 FanFrame* frames) {
    add_all<Curvature>(*pass, keep, vertices, frames);
  }
};

template <bool mass, bool with_y, bool spontaneous>
struct Energy {
  IBMFAIR_INLINE static double run(const VertexRoles* roles, Index count, BlockVertex* vertices) {
    const std::int8_t *counts = roles->counts.data(), *carries = roles->carries.data();
    Lanes E = {};
    for (Index i = 0; i < count; i += lane_count, vertices += lane_count) {
      const Lanes4 h = load_rows(&vertices->sum.x, vertex_size);
      const Lanes inverse_mass = mass ? 3.0 / h.w : Lanes{} + 1.0;
      const Lanes energy = 0.5 * inverse_mass * dot(h.xyz, h.xyz);
      E += where(counts + i, energy);
      if (with_y) {
        const Lanes share = where(carries + i, inverse_mass);
        const Lanes H0 = spontaneous ? load_rows(&vertices->x.x, vertex_size).w : Lanes{};
        const Lanes q = mass ? 1.0 / 3.0 * share * energy : Lanes{};
        store_rows(share * h.xyz, q, &vertices->x.x, vertex_size);
        store_rows(Lanes3{}, H0, &vertices->sum.x, vertex_size);
      }
    }
    return sum(E);
  }
};

// dE = sum_v <y_v, d h_v> - 1/2 |y_v|^2 d m_v: the Hessian of the area applied to y, and the
// derivative of the mass. With spontaneous curvature, H0_v <y_v, d a_v> is subtracted.
template <bool spontaneous>
struct Forces {
  IBMFAIR_INLINE static void add(const Fans& fans, BlockVertex* vertices) {
    const double* Y = &vertices->x.x;
    const double* H = &vertices->sum.x;  // nothing is added to the fourth numbers, H0
    const Lanes H0 = spontaneous ? gather(H, fans.centre).w : Lanes{};
    const Lanes4 y0 = gather(Y, fans.centre);
    Lanes4 y1 = {}, y2 = gather(Y, fans.rim(0));
    Lanes3 f = {}, g = y2.xyz - y0.xyz;  // the changes of p and q when the vertices move by y
    const Lanes3 first = load(fans.frames[0].p);
    Lanes qq = dot(first, first);
    Lanes rise_p = {}, rise_q = {}, by_mass = {};
    Lanes3 force = {}, next = {}, force0 = {};
    const auto find_rises = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      const Lanes3 p = load(fans.frames[i].p), q = load(fans.frames[i + 1].p);
      y1 = y2;
      y2 = gather(Y, fans.rim(i + 1));
      f = g;
      g = y2.xyz - y0.xyz;
      // The normal changes like that of a plane with the heights 2 <n, y> over the triangle's
      // corners. The gradient of the area changes along the normal by the slope of this plane,
      // which is 4 inverse (<n, g> p - <n, f> q).
      const Lanes3 along_n = 4.0 * load<Lanes>(fans.frames[i].inverse) * load(fans.frames[i].n);
      const Lanes by_p = dot(along_n, g), by_q = dot(along_n, f);
      const Lanes pp = qq, pq = dot(p, q);
      qq = dot(q, q);
      rise_p = by_p * pp - by_q * pq;
      rise_q = by_p * pq - by_q * qq;
      by_mass = y0.w + y1.w + y2.w;
    };
    const auto find_forces = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      const Lanes3 p = load(fans.frames[i].p), q = load(fans.frames[i + 1].p);
      const Lanes3 n = load(fans.frames[i].n);
      force = force + cross(g - by_mass * q, n) - rise_q * n;
      next = cross(n, f - by_mass * p) + rise_p * n;
      if (spontaneous) {
        const Lanes H1 = gather(H, fans.rim(i)).w, H2 = gather(H, fans.rim(i + 1)).w;
        const Lanes3 H0_y = (H0 * y0.xyz + H1 * y1.xyz + H2 * y2.xyz) / (Lanes{} + 6.0);
        force = force - cross(q, H0_y);
        next = next - cross(H0_y, p);
      }
    };
    const auto put = [&](Index i) IBMFAIR_INLINE_LAMBDA {
      add_to_vertices(force, Lanes{}, fans.rim(i), vertices);
      force0 = force0 - force;
      force = next;
    };
    overlapping(fans.triangles, find_rises, find_forces, put);
    add_to_vertices(force, Lanes{}, fans.rim(fans.triangles), vertices);
    add_to_vertices(force0 - force, Lanes{}, fans.centre, vertices);
  }

  IBMFAIR_INLINE static void run(const BlockPass* pass, BlockVertex* vertices, FanFrame* frames) {
    add_all<Forces>(*pass, true, vertices, frames);
  }
};

}  // namespace

void lagrange_curvature(const BlockPass& pass, bool spontaneous, bool keep, BlockVertex* vertices,
                        FanFrame* frames) {
  if (spontaneous) {
    run_kernel<Curvature<true>>(&pass, keep, vertices, frames);
  } else {
    run_kernel<Curvature<false>>(&pass, keep, vertices, frames);
  }
}

double lagrange_energy(const VertexRoles& roles, Index count, bool mass, BlockVertex* vertices) {
  return mass ? run_kernel<Energy<true, false, false>>(&roles, count, vertices)
              : run_kernel<Energy<false, false, false>>(&roles, count, vertices);
}

double lagrange_energy_and_y(const VertexRoles& roles, Index count, bool mass, bool spontaneous,
                             BlockVertex* vertices) {
  const auto run_with = [&]<bool has_mass>() {
    return spontaneous ? run_kernel<Energy<has_mass, true, true>>(&roles, count, vertices)
                       : run_kernel<Energy<has_mass, true, false>>(&roles, count, vertices);
  };
  return mass ? run_with.operator()<true>() : run_with.operator()<false>();
}

void lagrange_forces(const BlockPass& pass, bool spontaneous, BlockVertex* vertices,
                     FanFrame* frames) {
  if (spontaneous) {
    run_kernel<Forces<true>>(&pass, vertices, frames);
  } else {
    run_kernel<Forces<false>>(&pass, vertices, frames);
  }
}

}  // namespace ibmfair
