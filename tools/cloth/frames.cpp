#include "cloth/frames.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/picture/render.h"
#include "ibmfair/shapes/polyhedra.h"

namespace ibmfair::cloth {
namespace {

constexpr Rgb cloth_colour{196, 92, 74}, sphere_colour{150, 156, 166};
constexpr int sphere_levels = 5;

/// The sheet and the sphere as one mesh.
struct Drawn {
  Points X;
  Triangles F;
  Paint paint;
};

Drawn draw(const Scene& scene, const Points& X) {
  Drawn drawn{X, scene.plate.topology.F, {}};
  drawn.paint.triangle.assign(static_cast<std::size_t>(drawn.F.rows()), cloth_colour);
  if (const auto& sphere = scene.surroundings.sphere) {
    const TriangleMesh ball = make_icosphere({sphere_levels});
    drawn.X.conservativeResize(X.rows() + ball.X.rows(), 3);
    drawn.X.bottomRows(ball.X.rows()) =
        (sphere->radius * ball.X).rowwise() + sphere->centre.transpose();
    drawn.F.conservativeResize(drawn.F.rows() + ball.F.rows(), 3);
    drawn.F.bottomRows(ball.F.rows()) = ball.F.array() + static_cast<Index>(X.rows());
    drawn.paint.triangle.resize(static_cast<std::size_t>(drawn.F.rows()), sphere_colour);
  }
  return drawn;
}

}  // namespace

std::vector<Points> run_frames(const Scene& scene, Integrator& integrator, double seconds) {
  Motion motion = at_rest(scene.start);
  std::vector<Points> frames{motion.X};
  const auto count = static_cast<int>(seconds * frames_per_second + 0.5);
  for (int frame = 1; frame <= count; ++frame) {
    advance(integrator, frame / frames_per_second - motion.time, motion);
    frames.push_back(motion.X);
  }
  return frames;
}

std::string frame_path(const std::string& folder, std::size_t frame, const std::string& format) {
  return (std::filesystem::path(folder) / fmt::format("frame_{:04}.{}", frame, format)).string();
}

void write_frames(const Scene& scene, const std::vector<Points>& frames, const std::string& folder,
                  const std::string& format) {
  std::filesystem::create_directories(folder);
  WriteOptions options;
  options.overwrite = true;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    write_mesh(mesh_from_triangles(frames[i], scene.plate.topology.F),
               frame_path(folder, i, format), options);
  }
}

Image picture_of(const Scene& scene, const std::vector<Points>& frames, const View& view,
                 int count) {
  std::vector<Drawn> drawn;
  for (int i = 1; i <= count; ++i) {
    drawn.push_back(draw(scene, frames[(frames.size() - 1) * i * i / (count * count)]));
  }
  std::vector<PaintedMesh> meshes;
  for (const Drawn& one : drawn) {
    meshes.push_back({one.X, one.F, one.paint});
  }
  RenderOptions options;
  options.view = view;
  options.width = options.height = picture_width;
  return render_side_by_side(meshes, options);
}

}  // namespace ibmfair::cloth
