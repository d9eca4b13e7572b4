#include "commands/page/scene_json.h"

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr int scene_version = 1;

ordered_json array_json(const ArrayPlace& place) {
  return {{"type", place.type}, {"offset", place.offset}, {"length", place.length}};
}

ordered_json array_json(const std::optional<ArrayPlace>& place) {
  return place ? array_json(*place) : ordered_json();
}

ordered_json point_json(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

/// Points in single precision, which is shorter and sufficient relative to the centre of the scene.
ordered_json points_json(const Points& points) {
  ordered_json list = ordered_json::array();
  for (const double x : points.reshaped<Eigen::RowMajor>()) {
    list.push_back(static_cast<float>(x));
  }
  return list;
}

ordered_json arrays_json(const Scene& scene) {
  ordered_json positions = ordered_json::array();
  for (const Scene::State& state : scene.states) {
    positions.push_back(array_json(state.positions));
  }
  return {{"positions", positions},
          {"triangles", array_json(scene.triangles)},
          {"patch", array_json(scene.patch)},
          {"edges", array_json(scene.edges)}};
}

ordered_json field_json(const SceneField& field) {
  ordered_json values = ordered_json::array();
  for (const std::optional<ArrayPlace>& place : field.values) {
    values.push_back(array_json(place));
  }
  const SurfaceField& row = *field.field;
  return {{"name", row.name},
          {"title", row.title},
          {"unit", row.unit},
          {"diverging", row.diverging},
          {"on", row.place == SurfaceField::Place::vertex ? "vertex" : "triangle"},
          {"values", values},
          {"range", {field.range.low, field.range.high}}};
}

ordered_json line_json(const SceneLine& line) {
  ordered_json json = {{"kind", line.kind},
                       {"title", line.title},
                       {"points", points_json(line.at)},
                       {"closed", line.closed}};
  if (line.hole >= 0) {
    json["hole"] = line.hole;
  }
  return json;
}

void add_states(const Scene& scene, ordered_json& json) {
  json["states"] = ordered_json::array();
  json["vertices"] = scene.states.back().vertices;
  json["state_vertices"] = ordered_json::array();
  json["triangles"] = ordered_json::array();
  for (const Scene::State& state : scene.states) {
    json["states"].push_back(state.name);
    json["state_vertices"].push_back(state.vertices);
    json["triangles"].push_back(state.triangles);
  }
  json["shown"] = nullptr;
  if (scene.triangles_of > 0) {
    json["shown"] = {{"triangles", scene.states.back().triangles}, {"of", scene.triangles_of}};
  }
}

}  // namespace

ordered_json scene_json(const Scene& scene) {
  ordered_json json = {{"version", scene_version},
                       {"name", scene.name},
                       {"bytes_length", scene.arrays.bytes().size()},
                       {"centre", point_json(scene.centre)}};
  add_states(scene, json);
  json["arrays"] = arrays_json(scene);
  json["fields"] = ordered_json::array();
  for (const SceneField& field : scene.fields) {
    json["fields"].push_back(field_json(field));
  }
  json["lines"] = ordered_json::array();
  for (const SceneLine& line : scene.lines) {
    json["lines"].push_back(line_json(line));
  }
  json["places"] = ordered_json::array();
  for (const ScenePlace& place : scene.places) {
    json["places"].push_back(
        {{"title", place.title}, {"at", point_json(place.at)}, {"radius", place.radius}});
  }
  json["length_unit"] = "mesh units";
  json["mean_edge_length"] = scene.mean_edge_length;
  return json;
}

}  // namespace ibmfair::commands
