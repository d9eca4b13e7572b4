#include "cloth/hinge_bending.h"

#include <vector>

#include "cloth/dihedral_angle.h"

namespace ibmfair::cloth {
namespace {

class HingeBending final : public EnergyTerm {
 public:
  HingeBending(const Plate& plate, const BlockHessian& H)
      : H_(plate.topology.H), places_(H.places(hinge_rows(plate.topology))) {
    for (Index h = 0; h < H_.rows(); ++h) {
      const BentHinge hinge = at(plate.rest, h);
      const double double_area = hinge.N[0].norm() + hinge.N[1].norm();
      stiffness_.push_back(plate.material.bending * 6 * hinge.length * hinge.length / double_area);
      rest_.push_back(hinge.angle);
    }
    angle_ = angle_before_ = rest_;
  }

  double energy(const Points& X) override {
    double sum = 0;
    for (Index h = 0; h < H_.rows(); ++h) {
      angle_[h] = at(X, h).angle;
      const double bent = angle_[h] - rest_[h], change = angle_[h] - angle_before_[h];
      sum += stiffness_[h] * (bent * bent + beta_ * change * change) / 2;
    }
    return sum;
  }

  void add_gradient(const Points& X, Points& G) override {
    for (Index h = 0; h < H_.rows(); ++h) {
      const BentHinge hinge = at(X, h);
      angle_[h] = hinge.angle;
      const double moment = damped_moment(h);
      const auto g = hinge.gradient();
      for (int i = 0; i < 4; ++i) {
        G.row(H_(h, i)) += moment * g[i];
      }
    }
  }

  void add_hessian(const Points& X, HessianPart part, BlockHessian& H) override {
    for (Index h = 0; h < H_.rows(); ++h) {
      const BentHinge hinge = at(X, h);
      angle_[h] = hinge.angle;
      const auto g = hinge.gradient();
      const Index* place = &places_[std::size_t{10} * h];
      if (part == HessianPart::positive) {
        add_pairs(
            place, h, g, [](int) { return Block::Zero(); }, H);
      } else {
        const auto second = hessian(hinge);
        const double moment = damped_moment(h);
        add_pairs(
            place, h, g, [&](int k) { return moment * second[k]; }, H);
      }
    }
  }

  void start_step(const Points&, double beta) override {
    angle_.swap(angle_before_);
    beta_ = beta;
  }

 private:
  BentHinge at(const Points& X, Index h) const {
    return {X.row(H_(h, 0)), X.row(H_(h, 1)), X.row(H_(h, 2)), X.row(H_(h, 3))};
  }

  /// d(E + D) / d phi.
  double damped_moment(Index h) const {
    return stiffness_[h] * (angle_[h] - rest_[h] + beta_ * (angle_[h] - angle_before_[h]));
  }

  /// Adds the product of first derivatives, and of pair k also `second_order(k)`.
  template <class SecondOrder>
  void add_pairs(const Index* place, Index h, const std::array<Vec3, 4>& g,
                 const SecondOrder& second_order, BlockHessian& H) const {
    for (int i = 0, k = 0; i < 4; ++i) {
      const Vec3 row = stiffness_[h] * (1 + beta_) * g[i];
      for (int j = 0; j <= i; ++j, ++k) {
        H.add(place[k], row * g[j].transpose() + second_order(k));
      }
    }
  }

  Hinges H_;
  std::vector<Index> places_;      // ten a hinge
  std::vector<double> stiffness_;  // N m
  std::vector<double> rest_, angle_, angle_before_;
  double beta_ = 0;
};

}  // namespace

std::unique_ptr<EnergyTerm> bind_hinge_bending(const Plate& plate, const BlockHessian& H) {
  return std::make_unique<HingeBending>(plate, H);
}

}  // namespace ibmfair::cloth
