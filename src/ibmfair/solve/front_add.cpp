#include <algorithm>

#include "ibmfair/solve/front_packs.h"

namespace ibmfair {
namespace {

/// Adds the columns first .. last - 1 of a child's update.
template <class Real>
struct AddUpdate {
  static constexpr Index pack = pack_rows<Real>;

  FrontLayout<Real> child;
  const Real* update;
  FrontLayout<Real> parent;
  const Index* place;
  FrontPart part;
  Real* numbers;
  Index first, last;

  IBMFAIR_INLINE static void run(const AddUpdate& columns) {
    for (Index begin = columns.first / pack * pack; begin < columns.child.rows; begin += pack) {
      columns.add_pack(begin);
    }
  }

 private:
  IBMFAIR_INLINE Real* column(Index j) const { return numbers + std::ptrdiff_t{pack} * place[j]; }

  /// Adds the child's pack of rows begin, begin + 1, and so on.
  IBMFAIR_INLINE void add_pack(Index begin) const {
    const Real* from = update + child.in_update(begin) + std::ptrdiff_t{pack} * first;
    const Index end = std::min(begin + pack, child.rows);
    std::ptrdiff_t row[pack];
    for (Index i = std::max(begin, child.columns); i < end; ++i) {
      row[i - begin] = parent.in(part, place[i]);
    }
    Index j = first;
    if (begin >= child.columns && end == begin + pack) {
      const Index below = std::min(last, begin);  // below the diagonal in all rows
      const bool stay_together = row[pack - 1] - row[0] == pack - 1;
      for (; j < below && stay_together; ++j, from += pack) {
        Real* const to = column(j) + row[0];
        store(to, load<Pack<Real>>(to) + load<Pack<Real>>(from));
      }
      for (; j < below; ++j, from += pack) {
        Real* const to = column(j);
        for (Index i = 0; i < pack; ++i) {
          to[row[i]] += from[i];
        }
      }
    }
    for (; j < std::min(last, end); ++j, from += pack) {
      for (Index i = std::max(begin, j); i < end; ++i) {
        column(j)[row[i - begin]] += from[i - begin];
      }
    }
  }
};

}  // namespace

template <class Real>
void add_update(const FrontLayout<Real>& child, const Real* update, const FrontLayout<Real>& parent,
                const Index* place, FrontPart part, Real* numbers) {
  const Index* const begin = place + child.columns;
  const Index* const end = place + child.rows;
  const auto split = static_cast<Index>(std::lower_bound(begin, end, parent.columns) - place);
  const bool of_block = part == FrontPart::block;
  run_kernel<AddUpdate<Real>>(AddUpdate<Real>{child, update, parent, place, part, numbers,
                                              of_block ? child.columns : split,
                                              of_block ? split : child.rows});
}

template void add_update(const FrontLayout<float>&, const float*, const FrontLayout<float>&,
                         const Index*, FrontPart, float*);
template void add_update(const FrontLayout<double>&, const double*, const FrontLayout<double>&,
                         const Index*, FrontPart, double*);

}  // namespace ibmfair
