#include "cloth/model_timer.h"

#include <numbers>

namespace ibmfair::cloth {
namespace {

constexpr double amplitude = 0.01, waves_per_metre = 3;

Scene in_waves(const SceneRow& row, const TriangleMesh& sheet) {
  Scene scene = row.build(sheet);
  const Vec3 across = scene.surroundings.sphere ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Eigen::ArrayXd phase =
      2 * std::numbers::pi * waves_per_metre * scene.plate.rest.rowwise().sum().array();
  scene.start += amplitude * phase.sin().matrix() * across.transpose();
  return scene;
}

}  // namespace

ModelTimer::ModelTimer(const SceneRow& row, const TriangleMesh& sheet, const BendingForce& bending)
    : scene_(in_waves(row, sheet)),
      elastic_(scene_.plate, bending),
      system_(scene_.plate, bending),
      inertia_(scene_.plate.mass / (row.time_step * row.time_step)),
      solver_(system_.hessian, scene_.plate.fixed, scene_.plate.rest),
      G_(Points::Zero(scene_.start.rows(), 3)),
      explicit_(create("explicit", 0, bending)),
      implicit_(create("implicit", row.time_step, bending)),
      explicit_motion_(at_rest(scene_.start)),
      implicit_motion_(at_rest(scene_.start)) {
  system_.membrane->add_hessian(scene_.start, HessianPart::positive, system_.hessian);
  system_.bending->add_hessian(scene_.start, HessianPart::positive, system_.hessian);
  factor_and_solve();  // allocates the memory before the timing
  implicit_step();
}

void ModelTimer::factor_and_solve() {
  solver_.factor(system_.hessian, inertia_);
  solver_.solve(scene_.start, D_);
}

std::unique_ptr<Integrator> ModelTimer::create(std::string_view name, double time_step,
                                               const BendingForce& bending) const {
  StepOptions options;
  options.time_step = time_step;
  options.newton_iterations = 1;
  return integrator(name).create(scene_.plate, scene_.surroundings, bending, options);
}

}  // namespace ibmfair::cloth
