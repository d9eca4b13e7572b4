#include "ibmfair/io/precision.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {
namespace {

constexpr double most_of_edge = 1e-3;
constexpr double most_of_move = 1e-2;

/// The squared distance to the nearest point with float32 coordinates; infinite beyond their range.
double squared_rounding(const Vec3& x) {
  return (x - x.cast<float>().cast<double>()).squaredNorm();
}

}  // namespace

RoundingSums::RoundingSums(const Mesh& mesh, const Points& X, Index own) {
  for (Index v = 0; v < own; ++v) {
    const Vec3 before = mesh.X.row(v), after = X.row(v);
    if (before == after) continue;
    rounding += squared_rounding(after);
    moves += (after - before).squaredNorm();
    ++moved;
  }
  written = moved;
  for (Index f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (corners[i] >= own) continue;
      lengths += (X.row(corners[(i + 1) % corners.size()]) - X.row(corners[i])).norm();
      ++edges;
    }
  }
}

void RoundingSums::add(const Points& added) {
  for (Eigen::Index v = 0; v < added.rows(); ++v)
    rounding += squared_rounding(added.row(v));
  written += added.rows();
}

double RoundingSums::rms_rounding() const {
  return std::sqrt(rounding / static_cast<double>(written)) /
         (lengths / static_cast<double>(edges));
}

double RoundingSums::rms_move() const {
  return std::sqrt(moves / static_cast<double>(moved)) / (lengths / static_cast<double>(edges));
}

bool float32_suffices(const RoundingSums& sums) {
  if (sums.written == 0) return true;
  return sums.rms_rounding() <= most_of_edge &&
         (sums.moved == 0 || sums.rms_rounding() <= most_of_move * sums.rms_move());
}

std::string why_float32_fails(const RoundingSums& sums) {
  const double rounding = sums.rms_rounding();
  if (!std::isfinite(rounding)) return "float32 cannot hold the coordinates";
  const std::string text =
      fmt::format("float32 rounds the coordinates by {:.2g} mean edge lengths", rounding);
  return rounding <= most_of_edge
             ? fmt::format("{}, and the moves are {:.2g} long", text, sums.rms_move())
             : text;
}

void require_float32_range(const Points& X, std::string_view holder,
                           const std::function<Index(Index)>& number_of) {
  constexpr double largest = std::numeric_limits<float>::max();
  for (Index v = 0; v < X.rows(); ++v) {
    if (!(X.row(v).cwiseAbs().maxCoeff() <= largest)) {
      throw BadMesh(
          fmt::format("vertex {} has a coordinate that is too large for {}, which holds "
                      "float32",
                      number_of(v), holder));
    }
  }
}

}  // namespace ibmfair
