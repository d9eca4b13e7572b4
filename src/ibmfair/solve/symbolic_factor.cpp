#include "ibmfair/solve/symbolic_factor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "ibmfair/base/parallel.h"
#include "ibmfair/solve/cholmod_context.h"

namespace ibmfair {
namespace {

using Numbers = std::vector<std::int64_t>;

template <class Value>
std::vector<Value> taken(const std::vector<Value>& from, const Numbers& places) {
  std::vector<Value> values(places.size());
  std::transform(places.begin(), places.end(), values.begin(),
                 [&](std::int64_t i) { return from[i]; });
  return values;
}

/// The pattern of the matrix without its diagonal, permuted to the elimination order and in the
/// format of CHOLMOD. CHOLMOD's own permutations run on one thread and took half the time of its
/// analysis.
class Pattern {
 public:
  Pattern(const Rows& graph, const std::vector<Index>& order)
      : upper_first_(order.size() + 1, 0),
        lower_first_(order.size() + 1),
        upper_count_(order.size()),
        lower_count_(order.size()),
        row_(graph.value.size()) {
    const std::int64_t n = std::ssize(order);
    std::vector<Index> turn(order.size());
    for (std::int64_t j = 0; j < n; ++j) {
      turn[order[j]] = static_cast<Index>(j);
      upper_first_[j + 1] = upper_first_[j] + std::ssize(graph[order[j]]);
    }
    parallel_for(n, [&](std::int64_t j) {
      // Fills the range from both ends, without an unpredictable branch.
      std::int64_t upper_end = upper_first_[j], lower = upper_first_[j + 1];
      for (const Index w : graph[order[j]]) {
        const bool is_upper = turn[w] < j;
        row_[is_upper ? upper_end : lower - 1] = turn[w];
        upper_end += is_upper ? 1 : 0;
        lower -= is_upper ? 0 : 1;
      }
      upper_count_[j] = upper_end - upper_first_[j];
      lower_first_[j] = upper_end;
      lower_count_[j] = upper_first_[j + 1] - upper_end;
    });
    lower_first_[n] = upper_first_[n];
  }

  /// Column j has its neighbours that are eliminated before it.
  cholmod_sparse upper() { return triangle(upper_first_, upper_count_, 1); }

  /// Column j has its neighbours that are eliminated after it.
  cholmod_sparse lower() { return triangle(lower_first_, lower_count_, -1); }

  /// Permutes upper(): column column[i] becomes column i, and row i becomes row place[i].
  /// Precondition: the result is upper triangular again.
  void permute_upper(const Numbers& column, const Numbers& place) {
    upper_first_ = taken(upper_first_, column);
    upper_count_ = taken(upper_count_, column);
    parallel_for(std::ssize(row_), [&](std::int64_t k) { row_[k] = place[row_[k]]; });
  }

 private:
  cholmod_sparse triangle(Numbers& first, Numbers& count, int stype) {
    cholmod_sparse A{};
    A.nrow = A.ncol = count.size();
    A.nzmax = row_.size();
    A.p = first.data();
    A.nz = count.data();
    A.i = row_.data();
    A.stype = stype;
    A.itype = CHOLMOD_LONG;
    A.xtype = CHOLMOD_PATTERN;
    A.packed = 0;
    return A;
  }

  Numbers upper_first_, lower_first_, upper_count_, lower_count_, row_;
};

/// The parent of each column, or -1.
Numbers elimination_tree(Pattern& pattern, CholmodContext& context) {
  cholmod_sparse A = pattern.upper();
  Numbers parent(A.ncol);
  cholmod_l_etree(&A, parent.data(), context.get());
  context.check();
  return parent;
}

/// A postorder of the columns: every subtree of the elimination tree is a range. If weights are
/// given, the children of a column are in order of increasing weight.
Numbers postorder(const Numbers& parent, const std::int64_t* weight, CholmodContext& context) {
  Numbers column(parent.size());
  cholmod_l_postorder(const_cast<std::int64_t*>(parent.data()), parent.size(),
                      const_cast<std::int64_t*>(weight), column.data(), context.get());
  context.check();
  return column;
}

/// The number of entries of each column of L. Leaves the total number of entries and of
/// floating-point operations in `context`.
Numbers count_entries(Pattern& pattern, Numbers& parent, CholmodContext& context) {
  cholmod_sparse A = pattern.lower();
  const std::size_t n = parent.size();
  Numbers turn = postorder(parent, nullptr, context);
  Numbers in_row(n), in_column(n), first(n), level(n);
  cholmod_l_rowcolcounts(&A, nullptr, 0, parent.data(), turn.data(), in_row.data(),
                         in_column.data(), first.data(), level.data(), context.get());
  context.check();
  return in_column;
}

/// Owns a cholmod_factor without numerical values.
class CholmodFactor {
 public:
  CholmodFactor(std::size_t n, CholmodContext& context)
      : context_(context), factor_(cholmod_l_allocate_factor(n, context.get())) {
    context.check();
  }
  ~CholmodFactor() { cholmod_l_free_factor(&factor_, context_.get()); }
  CholmodFactor(const CholmodFactor&) = delete;
  CholmodFactor& operator=(const CholmodFactor&) = delete;

  cholmod_factor* get() { return factor_; }

 private:
  CholmodContext& context_;
  cholmod_factor* factor_;
};

template <class Value>
std::vector<Value> copy(const void* from, std::size_t count) {
  const auto* first = static_cast<const std::int64_t*>(from);
  return {first, first + count};
}

}  // namespace

SymbolicFactor symbolic_factor(const Rows& graph, const std::vector<Index>& order) {
  CholmodContext context;
  Pattern pattern(graph, order);
  Numbers parent = elimination_tree(pattern, context);
  const Numbers entries = count_entries(pattern, parent, context);
  SymbolicFactor symbolic{{}, context.get()->fl, context.get()->lnz};

  // Children with many entries come last, next to their parents, with which they may share a
  // supernode.
  const Numbers column = postorder(parent, entries.data(), context);
  Numbers place(column.size());
  for (std::size_t i = 0; i < column.size(); ++i) {
    place[column[i]] = static_cast<std::int64_t>(i);
  }
  for (std::int64_t& above : parent) {
    above = above < 0 ? above : place[above];
  }
  parent = taken(parent, column);
  pattern.permute_upper(column, place);

  CholmodFactor factor(order.size(), context);
  cholmod_factor& L = *factor.get();
  std::ranges::copy(taken(entries, column), static_cast<std::int64_t*>(L.ColCount));
  cholmod_sparse A = pattern.upper();
  cholmod_l_super_symbolic(&A, nullptr, parent.data(), &L, context.get());
  context.check();
  Supernodes& nodes = symbolic.nodes;
  nodes.unknown = taken(order, column);
  nodes.first_column = copy<Index>(L.super, L.nsuper + 1);
  nodes.first_row = copy<std::int64_t>(L.pi, L.nsuper + 1);
  nodes.row = copy<Index>(L.s, L.ssize);
  complete(nodes);
  return symbolic;
}

}  // namespace ibmfair
