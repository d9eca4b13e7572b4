#include "cloth/block_solver.h"

namespace ibmfair::cloth {

BlockSolver::BlockSolver(const BlockHessian& H, const std::vector<std::uint8_t>& fixed,
                         const Points& rest)
    : unknowns_(fixed) {
  const SymmetricMatrix& pattern = H.pattern();
  for (const Index v : unknowns_.vertex) {
    for (int c = 0; c < 3; ++c) {
      for (std::int64_t k = pattern.column_first[v]; k < pattern.column_first[v + 1]; ++k) {
        const Index i = unknowns_.unknown[pattern.row[k]];
        const bool diagonal = pattern.row[k] == v;
        for (int r = diagonal ? c : 0; i >= 0 && r < 3; ++r) {
          J_.row.push_back(std::int64_t{3} * i + r);
          source_.push_back(9 * k + std::int64_t{3} * c + r);  // blocks are stored by columns
        }
      }
      J_.column_first.push_back(static_cast<std::int64_t>(J_.row.size()));
    }
  }
  J_.value.resize(J_.row.size());
  right_hand_side_ = Points::Zero(J_.size(), 3);
  Points X(J_.size(), 3);
  for (Eigen::Index i = 0; i < X.rows(); ++i) {
    X.row(i) = rest.row(unknowns_.vertex[i / 3]);
  }
  cholesky_.emplace(MultifrontalAnalysis(J_, X));
}

void BlockSolver::factor(const BlockHessian& H, const PerVertex& d) {
  const double* values = H.blocks().front().data();
  for (std::size_t k = 0; k < source_.size(); ++k) {
    J_.value[k] = values[source_[k]];
  }
  for (std::int64_t j = 0; j < J_.size(); ++j) {
    J_.value[J_.column_first[j]] += d[unknowns_.vertex[j / 3]];
  }
  cholesky_->factor(J_);
}

void BlockSolver::solve(const Points& G, Points& D) {
  // The library's solver takes three right-hand sides at a time; two of them stay zero.
  for (Index u = 0; u < unknowns_.size(); ++u) {
    for (int c = 0; c < 3; ++c) {
      right_hand_side_.row(Eigen::Index{3} * u + c) << G(unknowns_.vertex[u], c), 0, 0;
    }
  }
  cholesky_->solve(right_hand_side_, right_hand_side_);
  D.setZero(G.rows(), 3);
  for (Index u = 0; u < unknowns_.size(); ++u) {
    for (int c = 0; c < 3; ++c) {
      D(unknowns_.vertex[u], c) = right_hand_side_(Eigen::Index{3} * u + c, 0);
    }
  }
}

}  // namespace ibmfair::cloth
