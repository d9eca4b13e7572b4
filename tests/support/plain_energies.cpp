#include "support/plain_energies.h"

#include <array>
#include <cmath>

#include <Eigen/Geometry>

namespace ibmfair::test {
namespace {

struct Triangle {
  std::array<Index, 3> corner;
  std::array<Vec3, 3> x;
  double double_area;
  Vec3 n;

  Triangle(const Points& X, Index a, Index b, Index c)
      : corner{a, b, c}, x{X.row(a), X.row(b), X.row(c)} {
    const Vec3 N = (x[1] - x[0]).cross(x[2] - x[0]);
    double_area = N.norm();
    n = N / double_area;
  }

  /// Adds the gradient of a function of N = double_area * n, given its derivative by N.
  void add_gradient(const Vec3& by_N, Points& G) const {
    for (int i = 0; i < 3; ++i) {
      G.row(corner[i]) += (x[(i + 1) % 3] - x[(i + 2) % 3]).cross(by_N);
    }
  }
};

}  // namespace

PlainEnergy plain_lagrange(const CompressedRows& stars, const Points& X, bool mass,
                           const PerVertex& H0) {
  PlainEnergy sum{0, Points::Zero(X.rows(), 3)};
  for (Index s = 0; s < stars.size(); ++s) {
    const auto star = stars[s];
    std::vector<Triangle> triangles;
    Vec3 h = Vec3::Zero(), a = Vec3::Zero();
    double m = 0;
    for (std::size_t k = 1; k < star.size(); ++k) {
      const Triangle& t =
          triangles.emplace_back(X, star[0], star[k], star[k + 1 < star.size() ? k + 1 : 1]);
      h += (t.x[1] - t.x[2]).cross(t.n) / 2;  // the gradient of the area
      a += t.double_area / 6 * t.n;           // the gradient of the volume
      m += t.double_area / 6;
    }
    const double curvature = H0.size() > 0 ? H0[star[0]] : 0;
    h -= curvature * a;
    const Vec3 y = mass ? Vec3(h / m) : h;
    sum.E += h.dot(y) / 2;
    for (const Triangle& t : triangles) {  // dE = <y, dh> - 1/2 <y, dm y>
      const Vec3 w = y.cross(t.x[1] - t.x[2]);
      const double by_area = mass ? y.squaredNorm() / 12 : 0;
      t.add_gradient(
          (w - t.n.dot(w) * t.n) / (2 * t.double_area) - by_area * t.n - curvature / 6 * y, sum.G);
      const Vec3 turned = t.n.cross(y) / 2;
      sum.G.row(t.corner[1]) += turned;
      sum.G.row(t.corner[2]) -= turned;
    }
  }
  return sum;
}

PlainEnergy plain_crouzeix_raviart(const CompressedRows& hinges, const Points& X, bool mass,
                                   double inverse_bound) {
  PlainEnergy sum{0, Points::Zero(X.rows(), 3)};
  for (Index h = 0; h < hinges.size(); ++h) {
    const auto x = hinges[h];
    const Triangle t0(X, x[0], x[1], x[2]), t1(X, x[1], x[0], x[3]);
    const Vec3 e = t0.x[1] - t0.x[0];
    const double turn = (t0.n - t1.n).squaredNorm() / 2;  // 1 + cos(theta)
    const double area = t0.double_area + t1.double_area;  // twice that of the hinge
    const double factor = mass ? 6 / area : 1;
    const double u = factor * e.squaredNorm() * turn;
    const double bounded = 1 / (1 + u * inverse_bound);
    sum.E += u * bounded;
    const double slope = bounded * bounded;
    const double by_area = mass ? -u / area : 0;
    const auto by_normal = [&](const Triangle& t, const Triangle& other) {
      const Vec3 by_n = (t.n - other.n) - turn * t.n;  // of 1 + cos(theta), times the double area
      return Vec3(slope * (factor * e.squaredNorm() / t.double_area * by_n + by_area * t.n));
    };
    t0.add_gradient(by_normal(t0, t1), sum.G);
    t1.add_gradient(by_normal(t1, t0), sum.G);
    sum.G.row(x[1]) += 2 * slope * factor * turn * e;
    sum.G.row(x[0]) -= 2 * slope * factor * turn * e;
  }
  return sum;
}

}  // namespace ibmfair::test
