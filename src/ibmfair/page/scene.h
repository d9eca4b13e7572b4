// What a page shows of a mesh: one or two states of it with their fields, and lines and places on
// it. Pure data; commands/page/ writes it down.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ibmfair/base/types.h"
#include "ibmfair/measure/surface_fields.h"
#include "ibmfair/mesh/mesh.h"
#include "ibmfair/mesh/topology.h"
#include "ibmfair/page/array_bytes.h"

namespace ibmfair {

/// A line strip on the mesh.
struct SceneLine {
  std::string_view kind;  ///< `seam`, `hole`, `boundary`, `held` or `defect`
  std::string title;
  Points at;  ///< as the mesh has them
  bool closed = false;
  Index hole = -1;  ///< the number of the hole that it runs around; -1: of none
};

/// A place worth flying to.
struct ScenePlace {
  std::string title;
  Vec3 at = Vec3::Zero();
  double radius = 0;  ///< about the size of what is there, length
};

/// A state of the mesh.
struct SceneState {
  std::string_view name;  ///< `mesh`, or `before` and `after`
  const Points* X;
  const Topology* topology;
};

/// What is to be seen. The vertices and the triangles of the first of two states are the first of
/// those of the second one; the others are patches.
struct SceneSource {
  std::string name;
  std::vector<SceneState> states;      ///< one or two
  std::string laplacian = {};          ///< of the bending energy
  std::vector<Index> patch = {};       ///< for each triangle behind the first state's its hole
  const Polygons* polygons = nullptr;  ///< faces of the first state; null: its triangles
  std::vector<SceneLine> lines = {};
  std::vector<ScenePlace> places = {};
};

struct SceneField {
  const SurfaceField* field;
  std::vector<std::optional<ArrayPlace>> values;  ///< for each state; none where it has no such
  ValueRange range;
};

struct Scene {
  std::string name;
  Vec3 centre = Vec3::Zero();  ///< of the bounding box: positions are relative to it
  struct State {
    std::string_view name;
    Index vertices = 0;   ///< its are the first of the last state's
    Index triangles = 0;  ///< likewise
    ArrayPlace positions;
  };
  std::vector<State> states;
  Index triangles_of = 0;  ///< triangles that the mesh has, where fewer are shown; 0: all are shown
  ArrayPlace triangles;
  std::optional<ArrayPlace> patch;  ///< for each triangle 0, or 1 + the number of its hole
  std::optional<ArrayPlace> edges;  ///< of the polygons; none: every edge of a triangle is one
  std::vector<SceneField> fields;
  std::vector<SceneLine> lines;    ///< relative to the centre, thinned out where they are very long
  std::vector<ScenePlace> places;  ///< relative to the centre
  double mean_edge_length = 0;
  ArrayBytes arrays;
};

/// Meshes of more triangles are decimated to about as many, patches last.
inline constexpr Index most_shown_triangles = 200'000;

/// Vertices that no triangle has are left out. Nothing where the mesh is too small or too large to
/// be drawn in single precision (below 1e-15 or above 1e15 units across), or has no triangles.
std::optional<Scene> build_scene(const SceneSource& source, Index most = most_shown_triangles);

}  // namespace ibmfair
