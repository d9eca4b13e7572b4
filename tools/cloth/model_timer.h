// The operations that are timed for one bending model in one scene.
#pragma once

#include <memory>

#include "cloth/block_solver.h"
#include "cloth/scenes.h"

namespace ibmfair::cloth {

/// The scene, bent into waves so that no angle is zero. Everything that the steps need is prepared,
/// so that each call does only the work that is timed.
class ModelTimer {
 public:
  ModelTimer(const SceneRow& row, const TriangleMesh& sheet, const BendingForce& bending);

  void gradient() { elastic_.bending->add_gradient(scene_.start, G_); }
  void hessian() {
    elastic_.bending->add_hessian(scene_.start, HessianPart::exact, elastic_.hessian);
  }
  void explicit_step() { explicit_->step(explicit_motion_); }
  void implicit_step() { implicit_->step(implicit_motion_); }
  void factor_and_solve();

 private:
  std::unique_ptr<Integrator> create(std::string_view name, double time_step,
                                     const BendingForce& bending) const;

  Scene scene_;
  ElasticSheet elastic_, system_;  // the second one's Hessian is that of the whole sheet
  PerVertex inertia_;
  BlockSolver solver_;
  Points G_, D_;
  std::unique_ptr<Integrator> explicit_, implicit_;
  Motion explicit_motion_, implicit_motion_;
};

}  // namespace ibmfair::cloth
