#include "ibmfair/solve/frontal_factor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/solve/flush_subnormals.h"
#include "ibmfair/solve/front_kernels.h"
#include "ibmfair/solve/update_stack.h"

namespace ibmfair {
namespace {

/// Calls work(b, scratch) for every branch, in parallel if the factor has at least `least_entries`
/// entries.
template <class Scratch, class Work>
void for_branches(const Supernodes& nodes, std::int64_t least_entries,
                  std::vector<Scratch>& scratch, Work&& work) {
  run_tasks(static_cast<std::int64_t>(nodes.branches.size()), nodes.entries >= least_entries,
            [&](std::int64_t b) { work(b, scratch[worker_index()]); });
}

constexpr std::int64_t worth_sharing_factor = 1'000'000, worth_sharing_solve = 500'000;

template <class Real>
FrontLayout<Real> layout(const Supernodes& nodes, Index s) {
  return {nodes.rows(s), nodes.columns(s)};
}

/// The workspace of a thread.
template <class Real>
struct FactorScratch {
  /// Allocates enough memory for each of the lists of supernodes.
  template <class Lists>
  FactorScratch(const Supernodes& nodes, const Lists& lists) {
    std::int64_t block_size = 0, updates_size = 0;
    for (const auto& list : lists) {
      for (const Index s : list) {
        block_size = std::max(block_size, layout<Real>(nodes, s).block_size());
      }
      updates_size = std::max(updates_size, stack_size(nodes, list, [&](Index s) {
                                return layout<Real>(nodes, s).update_size();
                              }));
    }
    block = LargeArray<Real>(static_cast<std::size_t>(block_size));
    updates = LargeArray<Real>(static_cast<std::size_t>(updates_size));
  }

  LargeArray<Real> block, updates;
};

}  // namespace

/// One factorization: its input, and the updates that wait for their parents.
template <class Real>
class FrontalFactor<Real>::Pass {
 public:
  Pass(FrontalFactor& factor, const SymmetricMatrix& J, const EliminatedColumns& columns)
      : factor_(factor),
        nodes_(factor.nodes_),
        J_(J),
        columns_(columns),
        of_branch_(nodes_.branches.size()),
        update_(static_cast<std::size_t>(nodes_.size())) {}

  /// Factors the supernodes of branch b and keeps the updates for the trunk. Returns -1, or the
  /// column at which the matrix is not positive definite.
  Index run_branch(std::size_t b, FactorScratch<Real>& scratch) {
    UpdateStack<Real> stack(nodes_, update_, scratch.updates.data());
    if (const Index bad = run(nodes_.branches[b], stack, scratch); bad >= 0) {
      return bad;
    }
    const Real* const first = scratch.updates.data();
    of_branch_[b] = LargeArray<Real>(static_cast<std::size_t>(stack.top() - first));
    std::copy(first, static_cast<const Real*>(stack.top()), of_branch_[b].data());
    for (const Index s : nodes_.branches[b]) {
      update_[s] = of_branch_[b].data() + (update_[s] - first);
    }
    return -1;
  }

  Index run_trunk() {
    FactorScratch<Real> scratch(nodes_, std::array{nodes_.trunk});
    UpdateStack<Real> stack(nodes_, update_, scratch.updates.data());
    return run(nodes_.trunk, stack, scratch);
  }

 private:
  static constexpr Index pack = pack_rows<Real>;

  template <class List>
  Index run(const List& list, UpdateStack<Real>& stack, FactorScratch<Real>& scratch) {
    Real* const block = scratch.block.data();
    for (const Index s : list) {
      const auto front = layout<Real>(nodes_, s);
      Real* const update = stack.push(s, front.update_size());
      gather_matrix(s, front, block);
      add_children(s, front, FrontPart::block, block);
      if (const Index bad = factor_front(front, block, update); bad >= 0) {
        return nodes_.first_column[s] + bad;
      }
      add_children(s, front, FrontPart::update, update);
      pack_front(front, block, factor_.values_.data() + factor_.first_value_[s]);
      stack.take_room_of_children(s, front.update_size());
    }
    return -1;
  }

  void gather_matrix(Index s, const FrontLayout<Real>& front, Real* block) const {
    const double* const scale = factor_.scale_.data();
    const Index* const row = nodes_.row.data() + nodes_.first_row[s];
    std::fill_n(block, front.block_size(), Real(0));
    for (Index j = nodes_.first_column[s]; j < nodes_.first_column[s + 1]; ++j, block += pack) {
      for (std::int64_t k = columns_.first[j]; k < columns_.first[j + 1]; ++k) {
        const Index i = columns_.place[k];
        block[front.in_block(i)] =
            static_cast<Real>(J_.value[columns_.source[k]] * scale[row[i]] * scale[j]);
      }
    }
  }

  void add_children(Index s, const FrontLayout<Real>& front, FrontPart part, Real* numbers) const {
    for (const Index child : nodes_.children[s]) {
      add_update(layout<Real>(nodes_, child), update_[child], front,
                 nodes_.place_in_parent.data() + nodes_.first_row[child], part, numbers);
    }
  }

  FrontalFactor& factor_;
  const Supernodes& nodes_;
  const SymmetricMatrix& J_;
  const EliminatedColumns& columns_;
  std::vector<LargeArray<Real>> of_branch_;  // the branches' updates for the trunk
  std::vector<Real*> update_;                // #S
};

template <class Real>
FrontalFactor<Real>::FrontalFactor(const Supernodes& nodes)
    : nodes_(nodes), first_value_(1, 0), scale_(nodes.unknown.size()) {
  for (Index s = 0; s < nodes.size(); ++s) {
    first_value_.push_back(first_value_.back() +
                           packed_size<Real>(nodes.rows(s), nodes.columns(s)));
  }
  values_ = LargeArray<Real>(static_cast<std::size_t>(first_value_.back()));
}

template <class Real>
Index FrontalFactor<Real>::factor(const SymmetricMatrix& J, const EliminatedColumns& columns) {
  const Index n = nodes_.unknowns();
  largest_scale_ = 0;
  for (Index i = 0; i < n; ++i) {
    const double diagonal = J.value[J.column_first[nodes_.unknown[i]]];
    if (!(diagonal > 0) || !std::isfinite(diagonal)) {
      return nodes_.unknown[i];
    }
    scale_[i] = 1 / std::sqrt(diagonal);
    largest_scale_ = std::max(largest_scale_, scale_[i]);
  }
  Pass pass(*this, J, columns);
  std::vector<Index> bad_column(nodes_.branches.size(), -1);
  {
    std::vector<FactorScratch<Real>> scratch;
    scratch.reserve(static_cast<std::size_t>(worker_count()));
    for (int i = 0; i < worker_count(); ++i) {
      scratch.emplace_back(nodes_, nodes_.branches);
    }
    for_branches(nodes_, worth_sharing_factor, scratch, [&](std::int64_t b, auto& own) {
      const FlushSubnormals flush;
      bad_column[b] = pass.run_branch(b, own);
    });
  }
  Index bad = n;  // the first in elimination order
  for (const Index column : bad_column) {
    bad = column < 0 ? bad : std::min(bad, column);
  }
  if (bad == n) {
    const FlushSubnormals flush;
    const Index column = pass.run_trunk();
    bad = column < 0 ? n : column;
  }
  return bad < n ? nodes_.unknown[bad] : -1;
}

template <class Real>
FrontalSolver<Real>::FrontalSolver(const FrontalFactor<Real>& factor)
    : factor_(factor),
      x_(4 * factor.nodes().unknown.size()),
      update_(static_cast<std::size_t>(factor.nodes().size())) {
  const Supernodes& nodes = factor.nodes();
  const auto vectors = [&](Index s) { return std::int64_t{4} * nodes.rows_below(s); };
  for (const Branch& branch : nodes.branches) {
    branch_stack_.emplace_back(stack_size(nodes, branch, vectors));
  }
  trunk_stack_ = LargeArray<Real>(stack_size(nodes, nodes.trunk, vectors));
  for (Index s = 0; s < nodes.size(); ++s) {
    largest_front_ = std::max(largest_front_, nodes.rows(s));
  }
}

template <class Real>
template <class List>
void FrontalSolver<Real>::forward(const List& list, Real* memory, Scratch& scratch) {
  using Vec4 = Eigen::Array<Real, 4, 1>;
  const Supernodes& nodes = factor_.nodes();
  UpdateStack<Real> stack(nodes, update_, memory);
  Real* const front = scratch.front.data();
  for (const Index s : list) {
    const Index rows = nodes.rows(s), own = 4 * nodes.columns(s), below = 4 * nodes.rows_below(s);
    Real* const x = x_.data() + 4 * std::size_t(nodes.first_column[s]);
    std::copy_n(x, own, front);
    std::fill_n(front + own, below, Real(0));
    for (const Index child : nodes.children[s]) {
      const Index* const place =
          nodes.place_in_parent.data() + nodes.first_row[child] + nodes.columns(child);
      const Real* const update = update_[child];
      for (Index i = 0; i < nodes.rows_below(child); ++i) {
        Eigen::Map<Vec4>(front + 4 * place[i]) += Eigen::Map<const Vec4>(update + 4 * i);
      }
    }
    substitute_forward(factor_.front(s), rows, nodes.columns(s), front, x,
                       stack.push_over_children(s, below), scratch.workspace.data());
  }
}

/// Prefetches for the supernodes that come after s in backward order: the list of rows of s - 2,
/// and the rows of x that s - 1 gathers from its ancestors.
template <class Real>
void FrontalSolver<Real>::fetch_rows_before(Index s) const {
  if (s < 2) {
    return;
  }
  const Supernodes& nodes = factor_.nodes();
  const Index* const row = nodes.row.data();
  constexpr std::int64_t in_line = 64 / sizeof(Index);
  for (std::int64_t i = nodes.first_row[s - 2]; i < nodes.first_row[s - 1]; i += in_line) {
    __builtin_prefetch(row + i);
  }
  for (std::int64_t i = nodes.first_row[s - 1] + nodes.columns(s - 1); i < nodes.first_row[s];
       ++i) {
    __builtin_prefetch(x_.data() + 4 * std::ptrdiff_t{row[i]});
  }
}

template <class Real>
void FrontalSolver<Real>::backward(Index s, Scratch& scratch) {
  fetch_rows_before(s);
  const Supernodes& nodes = factor_.nodes();
  substitute_backward(factor_.front(s), nodes.rows(s), nodes.columns(s),
                      nodes.row.data() + nodes.first_row[s], x_.data(), scratch.workspace.data());
}

template <class Real>
void FrontalSolver<Real>::solve(const Points& B, Points& Y) {
  const Supernodes& nodes = factor_.nodes();
  const std::vector<double>& scale = factor_.scale();
  // An upper bound of the scaled entries. Dividing by it makes float32 round alike for any unit of
  // length.
  const double largest = B.size() > 0 ? B.cwiseAbs().maxCoeff() * factor_.largest_scale() : 0;
  const double unit = largest > 0 ? largest : 1;
  parallel_for(nodes.unknowns(), [&](std::int64_t i) {
    const double* const b = B.data() + 3 * std::ptrdiff_t{nodes.unknown[i]};
    const double factor = scale[i] / unit;
    Real* const x = x_.data() + 4 * i;
    for (int c = 0; c < 3; ++c) {
      x[c] = static_cast<Real>(b[c] * factor);
    }
    x[3] = 0;
  });
  std::vector<Scratch> scratch(worker_count());
  for (Scratch& of_thread : scratch) {
    of_thread = {LargeArray<Real>(4 * std::size_t(largest_front_)),
                 LargeArray<Real>(workspace_size<Real>(largest_front_))};
  }
  for_branches(nodes, worth_sharing_solve, scratch, [&](std::int64_t b, Scratch& own) {
    const FlushSubnormals flush;
    forward(nodes.branches[b], branch_stack_[b].data(), own);
  });
  {
    const FlushSubnormals flush;
    forward(nodes.trunk, trunk_stack_.data(), scratch[0]);
    for (std::size_t i = nodes.trunk.size(); i-- > 0;) {
      backward(nodes.trunk[i], scratch[0]);
    }
  }
  for_branches(nodes, worth_sharing_solve, scratch, [&](std::int64_t b, Scratch& own) {
    const FlushSubnormals flush;
    for (Index s = nodes.branches[b].last - 1; s >= nodes.branches[b].first; --s) {
      backward(s, own);
    }
  });
  Y.resize(B.rows(), 3);
  parallel_for(nodes.unknowns(), [&](std::int64_t i) {
    double* const y = Y.data() + 3 * std::ptrdiff_t{nodes.unknown[i]};
    const double factor = scale[i] * unit;
    for (int c = 0; c < 3; ++c) {
      y[c] = factor * x_[4 * i + c];
    }
  });
}

template class FrontalFactor<float>;
template class FrontalFactor<double>;
template class FrontalSolver<float>;
template class FrontalSolver<double>;

}  // namespace ibmfair
