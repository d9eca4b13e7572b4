#include "cloth/sphere_contact.h"

#include <algorithm>

namespace ibmfair::cloth {
namespace {

constexpr double spring = 100;           // times mass / h^2
constexpr double sticking_speed = 1e-3;  // m/s: slower than this, friction is viscous

Eigen::Matrix3d tangential(const Vec3& normal) {
  return Eigen::Matrix3d::Identity() - normal * normal.transpose();
}

class SphereContact final : public EnergyTerm {
 public:
  SphereContact(const Sphere& sphere, const Plate& plate, double h, const BlockHessian& H)
      : sphere_(sphere),
        stiffness_(spring / (h * h) * plate.mass),
        shortest_slip_(sticking_speed * h),
        drag_(PerVertex::Zero(plate.mass.size())) {
    for (Index v = 0; v < drag_.size(); ++v) {
      places_.push_back(H.place(v, v));
    }
  }

  double energy(const Points& X) override {
    double sum = 0;
    for (Index v = 0; v < X.rows(); ++v) {
      if (const double deep = depth(X, v); deep > 0) {
        sum += stiffness_[v] * deep * deep;
      }
      if (drag_[v] > 0) {
        sum += drag_[v] * slip(X, v).squaredNorm();
      }
    }
    return sum / 2;
  }

  void add_gradient(const Points& X, Points& G) override {
    for (Index v = 0; v < X.rows(); ++v) {
      if (const double deep = depth(X, v); deep > 0) {
        G.row(v) -= stiffness_[v] * deep * outward(X, v);
      }
      if (drag_[v] > 0) {
        G.row(v) += drag_[v] * slip(X, v);
      }
    }
  }

  void add_hessian(const Points& X, HessianPart part, BlockHessian& H) override {
    for (Index v = 0; v < X.rows(); ++v) {
      if (const double deep = depth(X, v); deep > 0) {
        const Vec3 n = outward(X, v);
        H.add(places_[v], stiffness_[v] * n * n.transpose());
        if (part == HessianPart::exact) {
          const double distance = sphere_.resting_radius() - deep;
          H.add(places_[v], -stiffness_[v] * deep / distance * tangential(n));
        }
      }
      if (drag_[v] > 0) {
        H.add(places_[v], drag_[v] * tangential(outward(X_before_, v)));
      }
    }
  }

  void start_step(const Points& X, double) override {
    const Points earlier = X_before_.rows() == 0 ? X : X_before_;
    X_before_ = X;
    for (Index v = 0; v < X.rows(); ++v) {
      const double force = stiffness_[v] * std::max(0.0, depth(X, v));
      drag_[v] = sphere_.friction * force / std::max(slip(earlier, v).norm(), shortest_slip_);
    }
  }

 private:
  double depth(const Points& X, Index v) const {
    return sphere_.resting_radius() - (X.row(v).transpose() - sphere_.centre).norm();
  }

  Vec3 outward(const Points& X, Index v) const {
    return (X.row(v).transpose() - sphere_.centre).normalized();
  }

  /// The tangential displacement since the start of the step.
  Vec3 slip(const Points& X, Index v) const {
    return tangential(outward(X_before_, v)) * (X.row(v) - X_before_.row(v)).transpose();
  }

  Sphere sphere_;
  PerVertex stiffness_;  // N/m
  double shortest_slip_;
  PerVertex drag_;  // N/m: friction force per displacement, in this step
  Points X_before_;
  std::vector<Index> places_;
};

}  // namespace

std::unique_ptr<EnergyTerm> bind_contact(const Sphere& sphere, const Plate& plate, double h,
                                         const BlockHessian& H) {
  return std::make_unique<SphereContact>(sphere, plate, h, H);
}

void push_out(const Sphere& sphere, double radius, const Plate& plate, Points& X, Points& V) {
  for (Index v = 0; v < X.rows(); ++v) {
    const Vec3 from_centre = X.row(v).transpose() - sphere.centre;
    const double distance = from_centre.norm();
    if (plate.fixed[v] || distance >= radius) {
      continue;
    }
    const Vec3 n = from_centre / distance, velocity = V.row(v);
    X.row(v) = sphere.centre + radius * n;
    const double inwards = std::max(0.0, -velocity.dot(n));
    const Vec3 along = tangential(n) * velocity;
    const double speed = along.norm();
    const double kept = speed > 0 ? std::max(0.0, 1 - sphere.friction * inwards / speed) : 0;
    V.row(v) = kept * along + std::max(0.0, velocity.dot(n)) * n;
  }
}

}  // namespace ibmfair::cloth
