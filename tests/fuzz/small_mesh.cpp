#include "fuzz/small_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ibmfair::fuzz {

namespace {

constexpr Index most_vertices = 40;
constexpr Index most_faces = 100;

using Faces = std::vector<std::vector<Index>>;

/// A mesh while bytes change it.
struct Draft {
  std::vector<Vec3> X;
  Faces faces;

  Index vertices() const { return static_cast<Index>(X.size()); }
};

enum class Surface { nothing, sheet, tube, torus, moebius_strip, klein_bottle, sphere };
constexpr int surface_count = 7;

/// A point of the surface; u and v go once around the surface, or from side to side.
Vec3 place(Surface surface, double u, double v) {
  const double a = 2 * std::numbers::pi * u;
  const double b = 2 * std::numbers::pi * v;
  const Vec3 out(std::cos(a), std::sin(a), 0);
  const Vec3 up(0, 0, 1);
  switch (surface) {
    case Surface::tube:
      return out + 2 * v * up;
    case Surface::torus:
      return (2 + std::cos(b)) * out + std::sin(b) * up;
    case Surface::moebius_strip:
      return 2 * out + (v - 0.5) * (std::cos(a / 2) * out + std::sin(a / 2) * up);
    case Surface::klein_bottle: {  // the figure of eight
      const double s = std::cos(a / 2) * std::sin(b) - std::sin(a / 2) * std::sin(2 * b);
      const double t = std::sin(a / 2) * std::sin(b) + std::cos(a / 2) * std::sin(2 * b);
      return (3 + s) * out + t * up;
    }
    case Surface::sphere: {
      const double polar = std::numbers::pi * (0.1 + 0.8 * v);
      return std::sin(polar) * out + std::cos(polar) * up;
    }
    default:
      return {u, v, 0.1 * std::sin(9 * u) * std::cos(7 * v)};
  }
}

/// A grid of columns x rows quadrilaterals, each with one diagonal or with none. The sides are
/// joined as the surface requires; the ends of a sphere are closed by two polygons.
Draft grid(Surface surface, Index columns, Index rows, bool triangles) {
  const bool around = surface != Surface::sheet;
  const bool across = surface == Surface::torus || surface == Surface::klein_bottle;
  const bool twisted = surface == Surface::moebius_strip || surface == Surface::klein_bottle;
  const Index width = around ? columns : columns + 1;
  const Index height = across ? rows : rows + 1;
  Draft draft;
  for (Index j = 0; j < height; ++j) {
    for (Index i = 0; i < width; ++i) {
      draft.X.push_back(
          place(surface, static_cast<double>(i) / columns, static_cast<double>(j) / rows));
    }
  }
  const auto at = [&](Index i, Index j) {
    const bool seam = i >= width;
    if (across) j = (seam && twisted ? 2 * height - j : j) % height;
    if (!across && seam && twisted) j = height - 1 - j;
    return j * width + i % width;
  };
  for (Index j = 0; j < rows; ++j) {
    for (Index i = 0; i < columns; ++i) {
      const std::array quad{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
      if (triangles) {
        draft.faces.push_back({quad[0], quad[1], quad[2]});
        draft.faces.push_back({quad[0], quad[2], quad[3]});
      } else {
        draft.faces.emplace_back(quad.begin(), quad.end());
      }
    }
  }
  if (surface == Surface::sphere) {
    std::vector<Index> first, last;
    for (Index i = 0; i < width; ++i) {
      first.push_back(width - 1 - i);
      last.push_back(rows * width + i);
    }
    draft.faces.insert(draft.faces.end(), {first, last});
  }
  return draft;
}

Draft start(Bytes& bytes) {
  const auto surface = static_cast<Surface>(bytes.below(surface_count));
  const std::uint8_t size = bytes.next();
  const Index columns = 3 + size % 3;
  const Index rows = 2 + size / 3 % 3;
  const bool triangles = bytes.flag();
  return surface == Surface::nothing ? Draft{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {}}
                                     : grid(surface, columns, rows, triangles);
}

double odd_number(Bytes& bytes) {
  constexpr std::array numbers{0.0,    -0.0,    1.0, -1.0, 0.5,    1e-300, 5e-324, 1e-30,
                               1e-16,  1e-8,    1e9, 1e16, 1e30,   1e100,  1e154,  1e300,
                               -1e300, 1.7e308, 3.0, 0.1,  1e-154, 1e-200, -1e30,  0.3};
  return numbers[bytes.below(numbers.size())];
}

/// A number in -1 .. 1, in 256 steps.
double small_number(Bytes& bytes) {
  return (bytes.next() - 128) / 128.0;
}

void scale_all(Draft& draft, double factor) {
  for (Vec3& x : draft.X)
    x *= factor;
}

void add_face(Draft& draft, Bytes& bytes, std::size_t corners) {
  std::vector<Index> face;
  while (face.size() < corners)
    face.push_back(bytes.below(draft.vertices()));
  draft.faces.push_back(face);
}

/// Makes one change of one vertex or of all vertices.
void change_places(Draft& draft, int kind, Bytes& bytes) {
  Vec3& x = draft.X[bytes.below(draft.X.size())];
  const Eigen::Index c = bytes.below(3);
  switch (kind) {
    case 0:
      x[c] += small_number(bytes);
      break;
    case 1:
      x[c] = odd_number(bytes);
      break;
    case 2:
      x = draft.X[bytes.below(draft.X.size())];
      break;
    case 3:
      scale_all(draft, odd_number(bytes));
      break;
    case 4: {
      const double shift = odd_number(bytes);
      for (Vec3& y : draft.X)
        y[c] += shift;
      break;
    }
    case 5: {
      const double factor = odd_number(bytes);
      for (Vec3& y : draft.X)
        y[c] *= factor;
      break;
    }
    default: {
      const double size = small_number(bytes);
      for (std::size_t v = 0; v < draft.X.size(); ++v)
        draft.X[v][c] += size * std::sin(static_cast<double>(v * v + 1));
    }
  }
}

/// Makes one change of the connectivity.
void change_faces(Draft& draft, int kind, Bytes& bytes) {
  if (kind == 0 && draft.vertices() < most_vertices) {
    draft.X.emplace_back(small_number(bytes), small_number(bytes), small_number(bytes));
    return;
  }
  if (kind <= 2 || draft.faces.empty()) {
    const std::size_t corners = kind == 1 ? 3 + bytes.below(5U) : 3;
    if (draft.faces.size() < most_faces) add_face(draft, bytes, corners);
    return;
  }
  const std::size_t f = bytes.below(draft.faces.size());
  switch (kind) {
    case 3:
      draft.faces.erase(draft.faces.begin() + static_cast<std::ptrdiff_t>(f));
      break;
    case 4:
      std::reverse(draft.faces[f].begin(), draft.faces[f].end());
      break;
    case 5:
      draft.faces.push_back(std::vector<Index>(draft.faces[f]));
      break;
    case 6: {
      const Index from = bytes.below(draft.vertices());
      const Index to = bytes.below(draft.vertices());
      for (std::vector<Index>& face : draft.faces)
        std::replace(face.begin(), face.end(), from, to);
      break;
    }
    default:
      draft.faces[f][bytes.below(draft.faces[f].size())] = bytes.below(draft.vertices());
  }
}

}  // namespace

Mesh small_mesh(Bytes& bytes) {
  Draft draft = start(bytes);
  while (!bytes.empty()) {
    const int kind = bytes.next() % 16;
    if (kind < 8) {
      change_places(draft, kind, bytes);
    } else {
      change_faces(draft, kind - 8, bytes);
    }
  }
  Mesh mesh;
  mesh.X.resize(draft.vertices(), 3);
  for (Index v = 0; v < draft.vertices(); ++v)
    mesh.X.row(v) = draft.X[static_cast<std::size_t>(v)].transpose();
  // A reader accepts finite coordinates only.
  mesh.X = mesh.X.unaryExpr([](double x) { return std::isfinite(x) ? x : 0.0; }).eval();
  for (const std::vector<Index>& face : draft.faces)
    mesh.faces.add(face);
  return mesh;
}

}  // namespace ibmfair::fuzz
