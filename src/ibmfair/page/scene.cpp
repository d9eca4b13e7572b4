#include "ibmfair/page/scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "ibmfair/mesh/geometry.h"
#include "ibmfair/page/shown_triangles.h"

namespace ibmfair {
namespace {

/// The most points of a line that are drawn; longer lines are thinned out.
constexpr Eigen::Index most_line_points = 4000;

struct SceneBox {
  Eigen::RowVector3d low, high;
  Vec3 centre() const { return (low + high).transpose() / 2; }
  double size() const { return (high - low).norm(); }
};

SceneBox scene_box(const SceneSource& source, const ShownTriangles& shown) {
  SceneBox box{source.states.front().X->row(shown.vertex.front()), box.low};
  for (const SceneState& state : source.states) {
    for (const Index v : shown.vertex) {
      if (v < state.X->rows()) {
        box.low = box.low.cwiseMin(state.X->row(v));
        box.high = box.high.cwiseMax(state.X->row(v));
      }
    }
  }
  return box;
}

void add_states(const SceneSource& source, const ShownTriangles& shown, Scene& scene) {
  for (const SceneState& state : source.states) {
    Scene::State added;
    added.name = state.name;
    added.triangles =
        &state == &source.states.back() ? static_cast<Index>(shown.F.rows()) : shown.of_mesh;
    std::vector<float> positions;
    for (const Index v : shown.vertex) {
      if (v < state.X->rows()) {
        for (int axis = 0; axis < 3; ++axis) {
          positions.push_back(static_cast<float>((*state.X)(v, axis) - scene.centre[axis]));
        }
      }
    }
    added.vertices = static_cast<Index>(positions.size() / 3);
    added.positions = scene.arrays.add(positions);
    scene.states.push_back(added);
  }
}

void add_triangles(const ShownTriangles& shown, Scene& scene) {
  scene.triangles =
      scene.arrays.add(std::vector<std::uint32_t>(shown.F.data(), shown.F.data() + shown.F.size()));
  if (!shown.patch.empty()) {
    std::vector<std::uint8_t> patch(static_cast<std::size_t>(shown.F.rows()), 0);
    std::transform(shown.patch.begin(), shown.patch.end(), patch.begin() + shown.of_mesh,
                   [](Index hole) { return static_cast<std::uint8_t>(std::min(hole + 1, 255)); });
    scene.patch = scene.arrays.add(patch);
  }
}

/// Adds the edges of polygons and of patches, unless every triangle edge is one of these.
void add_edges(const SceneSource& source, const ShownTriangles& shown, Scene& scene) {
  const auto all_triangles = [](const Polygons& faces) {
    return static_cast<std::size_t>(faces.size()) * 3 == faces.corner.size();
  };
  if (source.polygons == nullptr || shown.decimated || all_triangles(*source.polygons)) {
    return;
  }
  std::vector<std::array<std::uint32_t, 2>> edges;
  const auto add_loop = [&](const auto& corners, auto number) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t a = number(corners[i]), b = number(corners[(i + 1) % corners.size()]);
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  };
  for (Index f = 0; f < source.polygons->size(); ++f) {
    add_loop((*source.polygons)[f], [&](Index v) {
      return static_cast<std::uint32_t>(
          std::lower_bound(shown.vertex.begin(), shown.vertex.end(), v) - shown.vertex.begin());
    });
  }
  for (Eigen::Index t = shown.of_mesh; t < shown.F.rows(); ++t) {
    add_loop(std::array<Index, 3>{shown.F(t, 0), shown.F(t, 1), shown.F(t, 2)},
             [](Index v) { return static_cast<std::uint32_t>(v); });
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  scene.edges = scene.arrays.add(std::span<const std::uint32_t>(
      edges.empty() ? nullptr : edges.front().data(), 2 * edges.size()));
}

/// The values at the shown vertices or triangles, from those of the mesh. A triangle made by
/// decimation gets the mean over the mesh's triangles around its corners.
Eigen::VectorXd shown_values(const Eigen::VectorXd& values, SurfaceField::Place place,
                             const Topology& topology, const ShownTriangles& shown,
                             const Scene::State& state) {
  if (place == SurfaceField::Place::vertex) {
    return values(Eigen::Map<const Eigen::VectorX<Index>>(shown.vertex.data(), state.vertices));
  }
  if (!shown.decimated) {
    return values;
  }
  Eigen::VectorXd of_triangles = Eigen::VectorXd::Zero(state.triangles);
  for (Index t = 0; t < state.triangles; ++t) {
    double count = 0;
    for (const Index corner : shown.F.row(t)) {
      for (const Index around : topology.stars[shown.vertex[corner]]) {
        of_triangles[t] += values[around];
        ++count;
      }
    }
    of_triangles[t] /= count;
  }
  return of_triangles;
}

/// The last state determines the colour scale, as in pictures (picture/field_picture.h).
void add_field(const SurfaceField& field, const SceneSource& source, const ShownTriangles& shown,
               Scene& scene) {
  SceneField added{&field, {}, {}};
  for (std::size_t s = 0; s < source.states.size(); ++s) {
    const SceneState& state = source.states[s];
    added.values.emplace_back();
    if (field.needs_before && s == 0) {
      continue;
    }
    const FieldState at{*state.X, *state.topology, s > 0 ? source.states[0].X : nullptr,
                        source.laplacian};
    const Eigen::VectorXd values = field.values(at);
    added.values[s] = scene.arrays.add_rounded(
        shown_values(values, field.place, *state.topology, shown, scene.states[s]));
    if (s + 1 == source.states.size()) {
      added.range = robust_range(field, values, at);
      scene.fields.push_back(added);
    }
  }
}

SceneLine drawn_line(const SceneLine& line, const Vec3& centre) {
  SceneLine drawn = line;
  const Eigen::Index step = (line.at.rows() + most_line_points - 1) / most_line_points;
  if (step > 1) {
    drawn.at = line.at(Eigen::seq(0, line.at.rows() - 1, step), Eigen::all);
    if (!line.closed) {
      drawn.at.row(drawn.at.rows() - 1) = line.at.row(line.at.rows() - 1);
    }
  }
  drawn.at.rowwise() -= centre.transpose();
  return drawn;
}

}  // namespace

std::optional<Scene> build_scene(const SceneSource& source, Index most) {
  const SceneState& last = source.states.back();
  if (last.topology->F.rows() == 0) {
    return std::nullopt;
  }
  const ShownTriangles shown = choose_triangles(*last.X, last.topology->F, source.patch, most);
  const SceneBox box = scene_box(source, shown);
  if (!(box.size() > 1e-15 && box.size() < 1e15)) {
    return std::nullopt;
  }
  Scene scene;
  scene.name = source.name;
  scene.centre = box.centre();
  scene.triangles_of = shown.decimated ? static_cast<Index>(last.topology->F.rows()) : 0;
  scene.mean_edge_length = mean_edge_length(*last.X, last.topology->E);
  add_states(source, shown, scene);
  add_triangles(shown, scene);
  add_edges(source, shown, scene);
  for (const SurfaceField& field : surface_fields()) {
    add_field(field, source, shown, scene);
  }
  for (const SceneLine& line : source.lines) {
    scene.lines.push_back(drawn_line(line, scene.centre));
  }
  for (ScenePlace place : source.places) {
    place.at -= scene.centre;
    scene.places.push_back(std::move(place));
  }
  return scene;
}

}  // namespace ibmfair
