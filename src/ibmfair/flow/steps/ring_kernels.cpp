#include "ibmfair/flow/steps/ring_kernels.h"

#include "ibmfair/base/lanes.h"

namespace ibmfair {
namespace {

static_assert(rings_per_group == lane_count);

/// The vertices of a group, whose rings have the same length, and their rows of a table.
template <Index row_length>
class Rings {
 public:
  IBMFAIR_INLINE Rings(const RingGroups& rings, std::int64_t g, const double* table)
      : length(rings.group[g].length), table_(table) {
    for (int i = 0; i < lane_count; ++i) {
      vertex_[i] = rings.vertex[rings_per_group * g + i];
      ring_[i] = rings.rings[vertex_[i]].data();
    }
  }

  IBMFAIR_INLINE Lanes4 at_vertex() const { return rows(vertex_); }

  IBMFAIR_INLINE Lanes4 at_neighbour(Index j) const {
    Index neighbour[lane_count];
    for (int i = 0; i < lane_count; ++i) {
      neighbour[i] = ring_[i][j];
    }
    return rows(neighbour);
  }

  const Index length;

 private:
  IBMFAIR_INLINE Lanes4 rows(const Index* number) const {
    const double* row[lane_count];
    for (int i = 0; i < lane_count; ++i) {
      row[i] = table_ + row_length * std::ptrdiff_t{number[i]};
    }
    return gather_rows(row);
  }

  const double* table_;
  Index vertex_[lane_count];
  const Index* ring_[lane_count];
};

/// The distance, in doubles, between equal members of two consecutive results.
template <class Result>
constexpr std::ptrdiff_t stride = sizeof(Result) / sizeof(double);

struct SurroundingsKernel {
  IBMFAIR_INLINE static void find(const Rings<3>& rings, Surroundings* results) {
    const Lanes3 x = rings.at_vertex().xyz;
    Lanes3 last = rings.at_neighbour(rings.length - 1).xyz - x;
    Lanes3 normal = {}, toward = {};
    Lanes lengths = {};
    for (Index i = 0; i < rings.length; ++i) {
      const Lanes3 edge = rings.at_neighbour(i).xyz - x;
      const Lanes3 N = cross(last, edge);
      normal = normal + N;
      lengths += sqrt(dot(N, N));
      toward = toward + edge;
      last = edge;
    }
    const Lanes squared = dot(normal, normal);
    const Lanes left = sqrt(squared) / lengths;
    const Lanes3 half_way = (Lanes{} + 0.5 / rings.length) * toward;
    const Lanes share = squared > 0.0 ? Lanes{} + 1.0 : Lanes{};
    const Lanes off = squared > 0.0 ? dot(normal, half_way) / squared : Lanes{};
    store_rows(normal, lengths > 0.0 ? left : Lanes{}, &results->normal.x, stride<Surroundings>);
    store_rows(half_way, Lanes{}, &results->half_way.x, stride<Surroundings>);
    store_rows(share * half_way - off * normal, Lanes{}, &results->along.x, stride<Surroundings>);
  }
};

struct UnsharedKernel {
  IBMFAIR_INLINE static void find(const Rings<row_size>& rings, Unshared* results) {
    const Lanes4 move = rings.at_vertex();
    const Lanes squared_length = larger(move.w, -move.w);
    Lanes3 shared = {};
    Lanes strain = {};
    for (Index i = 0; i < rings.length; ++i) {
      const Lanes4 other = rings.at_neighbour(i);
      const Lanes3 difference = move.xyz - other.xyz;
      const Lanes twice_the_share = other.w < 0.0 ? Lanes{} + 2.0 : Lanes{} + 1.0;
      strain += twice_the_share * dot(difference, difference) /
                (squared_length + larger(other.w, -other.w));
      shared = shared + other.xyz;
    }
    const Lanes3 own = move.xyz - (Lanes{} + 1.0 / rings.length) * shared;
    store_rows(own, dot(own, own) / squared_length, &results->own.x, stride<Unshared>);
    store_rows(Lanes3{strain, Lanes{}, Lanes{}}, Lanes{}, &results->strain.x, stride<Unshared>);
  }
};

/// Runs Kernel::find() for all groups of a range, on a table with rows of length `row_length`.
template <class Kernel, Index row_length>
struct AllRings {
  template <class Result>
  IBMFAIR_INLINE static void run(const RingRange* range, const double* table, Result* results) {
    for (std::int64_t g = range->first; g < range->first + range->groups; ++g) {
      Kernel::find(Rings<row_length>(range->rings, g, table), results);
      results += rings_per_group;
    }
  }
};

}  // namespace

void find_surroundings(const RingRange& range, const Points& X, ForPart<Surroundings>& results) {
  run_kernel<AllRings<SurroundingsKernel, 3>>(&range, X.data(), results.data());
}

void find_unshared(const RingRange& range, const Row4* moves, ForPart<Unshared>& results) {
  run_kernel<AllRings<UnsharedKernel, row_size>>(&range, &moves->x, results.data());
}

}  // namespace ibmfair
