#include "ibmfair/flow/ring_kernels.h"

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

/// A few vertices with rings of the same length, and the rows of a table that belong to them.
template <class Lanes, Index row_length>
class Rings {
 public:
  IBMFAIR_INLINE Rings(const RingGroups& rings, std::int64_t g, int first, const double* table)
      : length(rings.group[g].length), table_(table) {
    for (int i = 0; i < lane_count<Lanes>; ++i) {
      vertex_[i] = rings.vertex[rings_per_group * g + first + i];
      ring_[i] = rings.rings[vertex_[i]].data();
    }
  }

  IBMFAIR_INLINE Lanes4<Lanes> at_vertex() const { return rows(vertex_); }

  IBMFAIR_INLINE Lanes4<Lanes> at_neighbour(Index j) const {
    Index neighbour[lane_count<Lanes>];
    for (int i = 0; i < lane_count<Lanes>; ++i) {
      neighbour[i] = ring_[i][j];
    }
    return rows(neighbour);
  }

  const Index length;

 private:
  IBMFAIR_INLINE Lanes4<Lanes> rows(const Index* number) const {
    const double* row[lane_count<Lanes>];
    for (int i = 0; i < lane_count<Lanes>; ++i) {
      row[i] = table_ + row_length * std::ptrdiff_t{number[i]};
    }
    return gather_rows<Lanes>(row);
  }

  const double* table_;
  Index vertex_[lane_count<Lanes>];
  const Index* ring_[lane_count<Lanes>];
};

/// Writes lane i to the row `first` of the i-th of the results from there on.
template <class Result, class Lanes>
IBMFAIR_INLINE void store_results(const Lanes3<Lanes>& a, const Lanes& w, double* first) {
  constexpr std::size_t distance = sizeof(Result) / sizeof(double);
  Four row[lane_count<Lanes>];
  rows_of(a, w, row);
#pragma GCC unroll 8
  for (int i = 0; i < lane_count<Lanes>; ++i) {
    store(first + distance * i, row[i]);
  }
}

struct SurroundingsKernel {
  template <class Lanes>
  IBMFAIR_INLINE static void find(const Rings<Lanes, 3>& rings, Surroundings* results) {
    const Lanes3<Lanes> x = rings.at_vertex().xyz;
    Lanes3<Lanes> last = rings.at_neighbour(rings.length - 1).xyz - x;
    Lanes3<Lanes> normal = {}, toward = {};
    Lanes lengths = {};
    for (Index i = 0; i < rings.length; ++i) {
      const Lanes3<Lanes> edge = rings.at_neighbour(i).xyz - x;
      const Lanes3<Lanes> N = cross(last, edge);
      normal = normal + N;
      lengths += sqrt(dot(N, N));
      toward = toward + edge;
      last = edge;
    }
    const Lanes squared = dot(normal, normal);
    const Lanes left = sqrt(squared) / lengths;
    const Lanes3<Lanes> half_way = (Lanes{} + 0.5 / rings.length) * toward;
    const Lanes share = squared > 0.0 ? Lanes{} + 1.0 : Lanes{};
    const Lanes off = squared > 0.0 ? dot(normal, half_way) / squared : Lanes{};
    store_results<Surroundings>(normal, lengths > 0.0 ? left : Lanes{}, &results->normal.x);
    store_results<Surroundings>(half_way, Lanes{}, &results->half_way.x);
    store_results<Surroundings>(share * half_way - off * normal, Lanes{}, &results->along.x);
  }
};

struct UnsharedKernel {
  template <class Lanes>
  IBMFAIR_INLINE static void find(const Rings<Lanes, row_size>& rings, Unshared* results) {
    const Lanes4<Lanes> move = rings.at_vertex();
    const Lanes squared_length = larger(move.w, -move.w);
    Lanes3<Lanes> shared = {};
    Lanes strain = {};
    for (Index i = 0; i < rings.length; ++i) {
      const Lanes4<Lanes> other = rings.at_neighbour(i);
      const Lanes3<Lanes> difference = move.xyz - other.xyz;
      const Lanes twice_the_share = other.w < 0.0 ? Lanes{} + 2.0 : Lanes{} + 1.0;
      strain += twice_the_share * dot(difference, difference) /
                (squared_length + larger(other.w, -other.w));
      shared = shared + other.xyz;
    }
    const Lanes3<Lanes> own = move.xyz - (Lanes{} + 1.0 / rings.length) * shared;
    store_results<Unshared>(own, dot(own, own) / squared_length, &results->own.x);
    store_results<Unshared>(Lanes3<Lanes>{strain, Lanes{}, Lanes{}}, Lanes{}, &results->strain.x);
  }
};

/// Kernel::find() for all vertices of the groups, over a table of rows of this length.
template <class Kernel, Index row_length>
struct AllRings {
  template <class Lanes, class Result>
  IBMFAIR_INLINE static void run(const RingRange* range, const double* table, Result* results) {
    for (std::int64_t g = range->first; g < range->first + range->groups; ++g) {
      for (int first = 0; first < rings_per_group; first += lane_count<Lanes>) {
        Kernel::find(Rings<Lanes, row_length>(range->rings, g, first, table), results);
        results += lane_count<Lanes>;
      }
    }
  }
};

}  // namespace

void find_surroundings(const RingRange& range, const Points& X, ForPart<Surroundings>& results) {
  run_in_lanes<AllRings<SurroundingsKernel, 3>>(&range, X.data(), results.data());
}

void find_unshared(const RingRange& range, const Row4* moves, ForPart<Unshared>& results) {
  run_in_lanes<AllRings<UnsharedKernel, row_size>>(&range, &moves->x, results.data());
}

}  // namespace ibmfair
