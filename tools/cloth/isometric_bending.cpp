#include "cloth/isometric_bending.h"

#include <vector>

#include "ibmfair/energy/bending_energy.h"
#include "ibmfair/energy/hessian.h"

namespace ibmfair::cloth {
namespace {

SymmetricMatrix hessian_at_rest(const Plate& plate) {
  const auto energy = bending_model("crouzeix-raviart").create(plate.topology, {});
  StencilWeights weights;
  energy->linearise(plate.rest, weights);
  const Unknowns all(std::vector<std::uint8_t>(static_cast<std::size_t>(plate.rest.rows()), 0));
  const StencilTerms terms(energy->stencils(), plate.topology.vertex_count);
  const HessianAssembler assembler(terms, all);
  SymmetricMatrix S = assembler.pattern();
  assembler.assemble(weights, S);
  return S;
}

/// A symmetric matrix with both its triangles, row by row, so that a product reads it once and
/// writes each row once.
struct WholeRows {
  std::vector<Index> first{0};
  std::vector<Index> column;
  std::vector<double> value;

  WholeRows(const SymmetricMatrix& S, double scale) {
    std::vector<std::vector<std::int64_t>> entries(static_cast<std::size_t>(S.size()));
    std::vector<Index> column_of(S.row.size());
    for (std::int64_t j = 0; j < S.size(); ++j) {
      for (std::int64_t k = S.column_first[j]; k < S.column_first[j + 1]; ++k) {
        column_of[k] = static_cast<Index>(j);
        entries[S.row[k]].push_back(k);
        if (S.row[k] != j) {
          entries[j].push_back(k);
        }
      }
    }
    for (std::size_t i = 0; i < entries.size(); ++i) {
      for (const std::int64_t k : entries[i]) {
        const bool lower = column_of[k] != static_cast<Index>(i);
        column.push_back(lower ? column_of[k] : static_cast<Index>(S.row[k]));
        value.push_back(scale * S.value[k]);
      }
      first.push_back(static_cast<Index>(column.size()));
    }
  }

  void multiply(const Points& X, Points& Y) const {
    for (std::size_t i = 0; i + 1 < first.size(); ++i) {
      double x = 0, y = 0, z = 0;
      for (Index k = first[i]; k < first[i + 1]; ++k) {
        const double* other = X.data() + 3 * std::ptrdiff_t{column[k]};
        x += value[k] * other[0];
        y += value[k] * other[1];
        z += value[k] * other[2];
      }
      Y.row(static_cast<Index>(i)) << x, y, z;
    }
  }
};

class IsometricBending final : public EnergyTerm {
 public:
  IsometricBending(const Plate& plate, const BlockHessian& H)
      : IsometricBending(plate, H, hessian_at_rest(plate)) {}

  double energy(const Points& X) override {
    S_.multiply(X, SX_);
    double sum = X.cwiseProduct(SX_).sum();
    if (beta_ > 0) {
      sum += beta_ * (X - X_before_).cwiseProduct(SX_ - SX_before_).sum();
    }
    return sum / 2;
  }

  void add_gradient(const Points& X, Points& G) override {
    S_.multiply(X, SX_);
    if (beta_ > 0) {
      G += (1 + beta_) * SX_ - beta_ * SX_before_;
    } else {
      G += SX_;
    }
  }

  void add_hessian(const Points&, HessianPart, BlockHessian& H) override {
    for (std::size_t k = 0; k < lower_.size(); ++k) {
      H.add_to_diagonal(places_[k], (1 + beta_) * lower_[k]);
    }
  }

  void start_step(const Points& X, double beta) override {
    X_before_ = X;
    SX_.swap(SX_before_);
    beta_ = beta;
  }

 private:
  IsometricBending(const Plate& plate, const BlockHessian& H, const SymmetricMatrix& S)
      : S_(S, plate.material.bending),
        SX_(Points::Zero(plate.rest.rows(), 3)),
        SX_before_(SX_),
        X_before_(plate.rest) {
    for (std::int64_t j = 0; j < S.size(); ++j) {
      for (std::int64_t k = S.column_first[j]; k < S.column_first[j + 1]; ++k) {
        lower_.push_back(plate.material.bending * S.value[k]);
        places_.push_back(H.place(static_cast<Index>(S.row[k]), static_cast<Index>(j)));
      }
    }
  }

  WholeRows S_;                // k S
  std::vector<double> lower_;  // the lower triangle of S_
  std::vector<Index> places_;  // the places of those values in the Hessian
  Points SX_, SX_before_, X_before_;
  double beta_ = 0;
};

}  // namespace

std::unique_ptr<EnergyTerm> bind_isometric_bending(const Plate& plate, const BlockHessian& H) {
  return std::make_unique<IsometricBending>(plate, H);
}

}  // namespace ibmfair::cloth
