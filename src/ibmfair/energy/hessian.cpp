#include "ibmfair/energy/hessian.h"

#include <algorithm>
#include <numeric>

#include "ibmfair/base/parallel.h"

namespace ibmfair {
namespace {

constexpr std::int64_t columns_per_task = 4096;

}  // namespace

Points multiply(const SymmetricMatrix& J, const Points& X) {
  Points Y = Points::Zero(X.rows(), 3);
  for (std::int64_t j = 0; j < J.size(); ++j) {
    const std::int64_t diagonal = J.column_first[j];
    Y.row(j) += J.value[diagonal] * X.row(j);
    for (std::int64_t k = diagonal + 1; k < J.column_first[j + 1]; ++k) {
      Y.row(J.row[k]) += J.value[k] * X.row(j);
      Y.row(j) += J.value[k] * X.row(J.row[k]);
    }
  }
  return Y;
}

Unknowns::Unknowns(const std::vector<std::uint8_t>& fixed, const std::vector<std::uint8_t>& own)
    : unknown(fixed.size(), -1) {
  Index next = 0;
  for (std::size_t v = 0; v < fixed.size(); ++v) {
    if (!fixed[v]) {
      unknown[v] = next++;
      if (own.empty() || own[v]) {
        vertex.push_back(static_cast<Index>(v));
      }
    }
  }
}

HessianAssembler::HessianAssembler(const StencilTerms& terms, const Unknowns& unknowns)
    : terms_(terms), vertex_(unknowns.vertex) {
  find_pattern(unknowns.unknown);
}

void HessianAssembler::find_pattern(const std::vector<Index>& unknown) {
  const auto size = static_cast<std::int64_t>(vertex_.size());
  std::vector<std::vector<Index>> parts((size + columns_per_task - 1) / columns_per_task);
  std::vector<std::int64_t>& column_first = pattern_.column_first;
  column_first.resize(vertex_.size() + 1);
  const auto find = [&](std::int64_t first, std::int64_t last, std::vector<Index>& column_of) {
    std::vector<Index>& part = parts[first / columns_per_task];
    for (auto j = static_cast<Index>(first); j < last; ++j) {
      const std::size_t begin = part.size();
      part.push_back(j);
      terms_.for_vertices(vertex_[j], [&](Index v) {
        const Index i = unknown[v];
        if (i > j && column_of[i] != j + 1) {
          column_of[i] = j + 1;
          part.push_back(i);
        }
      });
      std::sort(part.begin() + static_cast<std::ptrdiff_t>(begin), part.end());
      column_first[j + 1] = static_cast<std::int64_t>(part.size() - begin);
    }
  };
  parallel_parts<Index>(size, columns_per_task, vertex_.size(), find);
  std::partial_sum(column_first.begin(), column_first.end(), column_first.begin());
  pattern_.row.resize(static_cast<std::size_t>(column_first.back()));
  pattern_.value.resize(pattern_.row.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::copy(parts[p].begin(), parts[p].end(),
              pattern_.row.begin() + column_first[p * columns_per_task]);
  }
}

void HessianAssembler::assemble(const StencilWeights& weights, SymmetricMatrix& S) const {
  // Terms are added up by vertex, also those of rows that are not in the column: what is left there
  // is never read, and the loop has no branches.
  const auto fill = [&](std::int64_t first, std::int64_t last, std::vector<double>& sum) {
    for (std::int64_t j = first; j < last; ++j) {
      const std::int64_t begin = S.column_first[j], end = S.column_first[j + 1];
      for (std::int64_t k = begin; k < end; ++k) {
        sum[vertex_[S.row[k]]] = 0;
      }
      terms_.for_terms(vertex_[j], weights, [&](Index v, double term) { sum[v] += term; });
      for (std::int64_t k = begin; k < end; ++k) {
        S.value[k] = sum[vertex_[S.row[k]]];
      }
    }
  };
  parallel_parts<double>(S.size(), columns_per_task, terms_.vertex_count(), fill);
}

}  // namespace ibmfair
