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

/// The pattern of the matrix, in the order of elimination and without its diagonal, as CHOLMOD
/// wants it. Its own permutations, on one thread, were half of its analysis.
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
      // From both ends, without a branch that nothing foretells.
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

  /// Column j has the rows tied to it that come before.
  cholmod_sparse upper() { return triangle(upper_first_, upper_count_, 1); }

  /// Column j has the rows tied to it that come after.
  cholmod_sparse lower() { return triangle(lower_first_, lower_count_, -1); }

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

/// The columns of L in order of elimination.
struct Columns {
  std::vector<Index> node;
  Numbers parent;   ///< in the elimination tree, or -1
  Numbers entries;  ///< on and below the diagonal
};

Numbers elimination_tree(Pattern& pattern, std::size_t n, CholmodContext& context) {
  cholmod_sparse A = pattern.upper();
  Numbers parent(n);
  cholmod_l_etree(&A, parent.data(), context.get());
  context.check("analysis");
  return parent;
}

/// The columns so that every subtree is a range; of the children, that of least `weight` first.
Numbers postorder(const Numbers& parent, const std::int64_t* weight, CholmodContext& context) {
  Numbers column(parent.size());
  cholmod_l_postorder(const_cast<std::int64_t*>(parent.data()), parent.size(),
                      const_cast<std::int64_t*>(weight), column.data(), context.get());
  context.check("analysis");
  return column;
}

/// The entries of each column. `context` then knows how many there are in all, and what it takes to
/// compute them.
Numbers count_entries(Pattern& pattern, Numbers& parent, CholmodContext& context) {
  cholmod_sparse A = pattern.lower();
  const std::size_t n = parent.size();
  Numbers turn = postorder(parent, nullptr, context);
  Numbers in_row(n), in_column(n), first(n), level(n);
  cholmod_l_rowcolcounts(&A, nullptr, 0, parent.data(), turn.data(), in_row.data(),
                         in_column.data(), first.data(), level.data(), context.get());
  context.check("analysis");
  return in_column;
}

/// The large children come last, next to their parents, with which they may share a supernode.
Columns put_in_postorder(const std::vector<Index>& order, const Numbers& parent,
                         const Numbers& entries, CholmodContext& context) {
  const Numbers column = postorder(parent, entries.data(), context);
  const std::size_t n = order.size();
  Numbers place(n);
  for (std::size_t i = 0; i < n; ++i) {
    place[column[i]] = static_cast<std::int64_t>(i);
  }
  Columns columns{std::vector<Index>(n), Numbers(n), Numbers(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const std::int64_t above = parent[column[i]];
    columns.node[i] = order[column[i]];
    columns.parent[i] = above < 0 ? -1 : place[above];
    columns.entries[i] = entries[column[i]];
  }
  return columns;
}

Columns columns_of(const Rows& graph, const std::vector<Index>& order, CholmodContext& context) {
  Pattern pattern(graph, order);
  Numbers parent = elimination_tree(pattern, order.size(), context);
  const Numbers entries = count_entries(pattern, parent, context);
  return put_in_postorder(order, parent, entries, context);
}

/// CHOLMOD's factor without numbers.
class CholmodFactor {
 public:
  CholmodFactor(std::size_t n, CholmodContext& context)
      : context_(context), factor_(cholmod_l_allocate_factor(n, context.get())) {
    context.check("analysis");
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
  Columns columns = columns_of(graph, order, context);
  SymbolicFactor symbolic{{}, context.get()->fl, context.get()->lnz};
  CholmodFactor factor(order.size(), context);
  cholmod_factor& L = *factor.get();
  std::copy(columns.entries.begin(), columns.entries.end(), static_cast<std::int64_t*>(L.ColCount));
  Pattern pattern(graph, columns.node);
  cholmod_sparse A = pattern.upper();
  cholmod_l_super_symbolic(&A, nullptr, columns.parent.data(), &L, context.get());
  context.check("analysis");
  Supernodes& nodes = symbolic.nodes;
  nodes.unknown = std::move(columns.node);
  nodes.first_column = copy<Index>(L.super, L.nsuper + 1);
  nodes.first_row = copy<std::int64_t>(L.pi, L.nsuper + 1);
  nodes.row = copy<Index>(L.s, L.ssize);
  complete(nodes);
  return symbolic;
}

}  // namespace ibmfair
