// Generates a binary STL file, which is little-endian.
#include <algorithm>
#include <bit>
#include <cmath>

#include "ibmfair/io/byte_sink.h"
#include "ibmfair/io/generate.h"
#include "ibmfair/io/precision.h"
#include "ibmfair/io/stl.h"
#include "ibmfair/mesh/mesh.h"

namespace ibmfair::stl {
namespace {

constexpr std::size_t header_size = 80;

void append_word(std::string& record, std::uint32_t word) {
  for (int byte = 0; byte < 4; ++byte) {
    record += static_cast<char>(word >> 8 * byte & 0xFF);
  }
}

void append_vector(std::string& record, const Vec3& x) {
  for (const double value : {x[0], x[1], x[2]}) {
    append_word(record, std::bit_cast<std::uint32_t>(static_cast<float>(value)));
  }
}

/// The unit normal, or 0 for a triangle without one.
Vec3 normal_of(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  const double scale = std::max((x1 - x0).cwiseAbs().maxCoeff(), (x2 - x0).cwiseAbs().maxCoeff());
  const Vec3 N = scale > 0 ? Vec3(((x1 - x0) / scale).cross((x2 - x0) / scale)) : Vec3::Zero();
  const double length = N.norm();
  return length > 0 ? Vec3(N / length) : Vec3::Zero();
}

}  // namespace

std::vector<std::string> generate(const GenerateRequest& request, ByteSink& out) {
  const Points& X = request.mesh.X;
  require_float32_range(X, "STL");
  const Triangles F = triangulate(request.mesh).F;
  std::string record = "binary STL, written by ibmfair";  // must not start with "solid"
  record.resize(header_size, ' ');
  append_word(record, static_cast<std::uint32_t>(F.rows()));
  out.write(record);
  for (Eigen::Index t = 0; t < F.rows(); ++t) {
    const Vec3 x0 = X.row(F(t, 0)), x1 = X.row(F(t, 1)), x2 = X.row(F(t, 2));
    record.clear();
    for (const Vec3& x : {normal_of(x0, x1, x2), x0, x1, x2}) {
      append_vector(record, x);
    }
    record.append(2, '\0');  // no attributes
    out.write(record);
  }

  const MeshAttributes& attributes = request.attributes;
  std::vector<std::string> left_out = attributes.uncarried;
  if (!attributes.colours.empty()) left_out.emplace_back("colours");
  if (!attributes.texture_coordinates.empty()) left_out.emplace_back("texture coordinates");
  if (!attributes.face_statements.empty()) left_out.emplace_back("groups, objects and materials");
  std::vector<std::string> notes = note_left_out("STL", std::move(left_out));
  notes.emplace_back("STL holds float32: coordinates are rounded to seven digits");
  return notes;
}

}  // namespace ibmfair::stl
