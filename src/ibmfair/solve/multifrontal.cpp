#include "ibmfair/solve/multifrontal.h"

#include <algorithm>
#include <cmath>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/solve/flush_subnormals.h"
#include "ibmfair/solve/front_kernels.h"
#include "ibmfair/solve/update_stack.h"

namespace ibmfair {
namespace {

/// Calls work(b, scratch) for every branch, in parallel when the factor has so many entries.
template <class Scratch, class Work>
void for_branches(const Supernodes& nodes, std::int64_t least_entries,
                  std::vector<Scratch>& scratch, Work&& work) {
  run_tasks(static_cast<std::int64_t>(nodes.branches.size()), nodes.entries >= least_entries,
            [&](std::int64_t b) { work(b, scratch[worker_index()]); });
}

constexpr std::int64_t worth_sharing_factor = 1'000'000, worth_sharing_solve = 500'000;

/// The numbers in the largest front, all of its rows in all of its own columns.
template <class List>
std::int64_t largest_front(const Supernodes& nodes, const List& list) {
  std::int64_t largest = 0;
  for (const Index s : list) {
    largest = std::max(largest, std::int64_t{nodes.rows(s)} * nodes.columns(s));
  }
  return largest;
}

/// Where a thread works on one front.
template <class Real>
struct FrontScratch {
  std::vector<Index> place;  // #unknowns: of each row of the front
  LargeArray<Real> block;    // column by column
};

}  // namespace

/// One factorization: what it reads, and where updates wait.
template <class Real>
class FrontalFactor<Real>::Pass {
 public:
  Pass(FrontalFactor& factor, const SymmetricMatrix& J, const EliminatedColumns& columns)
      : factor_(factor), nodes_(factor.nodes_), J_(J), columns_(columns) {
    update_.resize(static_cast<std::size_t>(nodes_.size()));
    const auto square = [&](Index s) {
      return std::int64_t{nodes_.rows_below(s)} * nodes_.rows_below(s);
    };
    for (const Branch& branch : nodes_.branches) {
      stacks_.emplace_back(stack_size(nodes_, branch, square));
    }
    stacks_.emplace_back(stack_size(nodes_, nodes_.trunk, square));
  }

  /// Factors the supernodes in `list`, those of branch b or (b = #branches) of the trunk; returns
  /// -1 or the column at which the matrix is not positive definite.
  template <class List>
  Index run(const List& list, std::size_t b, FrontScratch<Real>& scratch) {
    UpdateStack<Real> stack(nodes_, update_, stacks_[b].data());
    for (const Index s : list) {
      const std::int64_t below = nodes_.rows_below(s);
      const Index rows = nodes_.rows(s), columns = nodes_.columns(s);
      Real* const block = scratch.block.data();
      Real* const update = stack.push(s, below * below);
      gather_matrix(s, block, scratch.place);
      for (Index j = 0; j < below; ++j) {
        std::fill(update + j * below + j, update + (j + 1) * below, Real(0));
      }
      for (const Index child : nodes_.children[s]) {
        add_update(child, s, block, update);
      }
      if (const Index bad = factor_front(rows, columns, block, update); bad >= 0) {
        return nodes_.first_column[s] + bad;
      }
      pack_front(block, rows, columns, factor_.values_.data() + factor_.first_value_[s]);
      stack.take_room_of_children(s, below * below);
    }
    return -1;
  }

 private:
  void gather_matrix(Index s, Real* block, std::vector<Index>& place) const {
    const Index rows = nodes_.rows(s);
    const std::vector<double>& scale = factor_.scale_;
    const Index* const row = nodes_.row.data() + nodes_.first_row[s];
    for (Index i = 0; i < rows; ++i) {
      place[row[i]] = i;
    }
    std::fill(block, block + std::int64_t{rows} * nodes_.columns(s), Real(0));
    for (Index j = nodes_.first_column[s]; j < nodes_.first_column[s + 1]; ++j, block += rows) {
      for (std::int64_t k = columns_.first[j]; k < columns_.first[j + 1]; ++k) {
        const Index i = columns_.row[k];
        block[place[i]] = static_cast<Real>(J_.value[columns_.source[k]] * scale[i] * scale[j]);
      }
    }
  }

  /// Adds the lower triangle of the child's update where its rows are among those of s.
  void add_update(Index child, Index s, Real* block, Real* update) const {
    const Index columns = nodes_.columns(s), rows = nodes_.rows(s), below = rows - columns;
    const Index side = nodes_.rows_below(child);
    const Index* const place =
        nodes_.place_in_parent.data() + nodes_.first_row[child] + nodes_.columns(child);
    const Real* from = update_[child];
    for (Index j = 0; j < side; ++j, from += side) {
      Real* const to = place[j] < columns
                           ? block + std::int64_t{place[j]} * rows
                           : update + std::int64_t{place[j] - columns} * below - columns;
      for (Index i = j; i < side; ++i) {
        to[place[i]] += from[i];
      }
    }
  }

  FrontalFactor& factor_;
  const Supernodes& nodes_;
  const SymmetricMatrix& J_;
  const EliminatedColumns& columns_;
  std::vector<LargeArray<Real>> stacks_;  // one per branch, and the trunk's
  std::vector<Real*> update_;             // #S
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
  const std::size_t branches = nodes_.branches.size();
  std::int64_t largest = 0;
  for (const Branch& branch : nodes_.branches) {
    largest = std::max(largest, largest_front(nodes_, branch));
  }
  std::vector<FrontScratch<Real>> scratch(worker_count());
  for (FrontScratch<Real>& of_thread : scratch) {
    of_thread = {std::vector<Index>(nodes_.unknown.size()), LargeArray<Real>(largest)};
  }
  std::vector<Index> bad_column(branches, -1);
  for_branches(nodes_, worth_sharing_factor, scratch, [&](std::int64_t b, auto& own) {
    const FlushSubnormals flush;
    bad_column[b] = pass.run(nodes_.branches[b], b, own);
  });
  Index bad = n;  // the first in order of elimination
  for (const Index column : bad_column) {
    bad = column < 0 ? bad : std::min(bad, column);
  }
  if (bad == n) {
    const FlushSubnormals flush;
    scratch[0].block = LargeArray<Real>(largest_front(nodes_, nodes_.trunk));
    const Index column = pass.run(nodes_.trunk, branches, scratch[0]);
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
  using Four = Eigen::Array<Real, 4, 1>;
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
        Eigen::Map<Four>(front + 4 * place[i]) += Eigen::Map<const Four>(update + 4 * i);
      }
    }
    substitute_forward(factor_.front(s), rows, nodes.columns(s), front, x,
                       stack.push_over_children(s, below), scratch.workspace.data());
  }
}

template <class Real>
void FrontalSolver<Real>::backward(Index s, Scratch& scratch) {
  const Supernodes& nodes = factor_.nodes();
  substitute_backward(factor_.front(s), nodes.rows(s), nodes.columns(s),
                      nodes.row.data() + nodes.first_row[s], x_.data(), scratch.workspace.data());
}

template <class Real>
void FrontalSolver<Real>::solve(const Points& B, Points& Y) {
  const Supernodes& nodes = factor_.nodes();
  const std::vector<double>& scale = factor_.scale();
  // No number is larger than this one, so that float32 rounds alike whatever the unit of length is.
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
