// The contents of a web page that shows a mesh: one or two states of the mesh with their fields,
// and lines and places on it. Pure data; commands/page/ writes the page.
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
  std::string_view kind;  ///< `seam`, `hole`, `boundary`, `held` (fixed region) or `defect`
  std::string title;
  Points at;  ///< positions, in the coordinates of the mesh
  bool closed = false;
  Index hole = -1;  ///< the number of the hole that the line bounds; -1: none
};

/// A place of interest, to which the page can move the view.
struct ScenePlace {
  std::string title;
  Vec3 at = Vec3::Zero();
  double radius = 0;  ///< approximate size of the feature, length
};

/// A state of the mesh.
struct SceneState {
  std::string_view name;  ///< `mesh`, or `before` and `after`
  const Points* X;
  const Topology* topology;
};

/// The input of build_scene(). If there are two states, the vertices and triangles of the first
/// state are the first ones of the second state; all further triangles are patches.
struct SceneSource {
  std::string name;
  std::vector<SceneState> states;  ///< one or two
  std::string laplacian = {};      ///< Laplacian of the bending energy
  std::vector<Index> patch = {};   ///< the hole of each triangle beyond those of the first state
  const Polygons* polygons = nullptr;  ///< faces of the first state; null: its triangles
  std::vector<SceneLine> lines = {};
  std::vector<ScenePlace> places = {};
};

struct SceneField {
  const SurfaceField* field;
  std::vector<std::optional<ArrayPlace>> values;  ///< for each state; none if it lacks the field
  ValueRange range;
};

struct Scene {
  std::string name;
  Vec3 centre = Vec3::Zero();  ///< centre of the bounding box; positions are relative to it
  struct State {
    std::string_view name;
    Index vertices = 0;   ///< the state's vertices are the first ones of the last state
    Index triangles = 0;  ///< likewise
    ArrayPlace positions;
  };
  std::vector<State> states;
  Index triangles_of = 0;  ///< number of triangles of the mesh before decimation; 0: not decimated
  ArrayPlace triangles;
  std::optional<ArrayPlace> patch;  ///< for each triangle, 0 or 1 + the number of its hole
  std::optional<ArrayPlace> edges;  ///< edges of the polygons; none: every triangle edge is one
  std::vector<SceneField> fields;
  std::vector<SceneLine> lines;    ///< relative to the centre; very long lines are thinned out
  std::vector<ScenePlace> places;  ///< relative to the centre
  double mean_edge_length = 0;
  ArrayBytes arrays;
};

/// Meshes with more triangles are decimated to about this number; patches are decimated last.
inline constexpr Index most_shown_triangles = 200'000;

/// Builds the scene. Vertices that belong to no triangle are left out. Returns nothing if the mesh
/// has no triangles, or is too small or too large to be drawn in single precision (below 1e-15 or
/// above 1e15 units across).
std::optional<Scene> build_scene(const SceneSource& source, Index most = most_shown_triangles);

}  // namespace ibmfair
