#include "ibmfair/fill/bridges.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair {
namespace {

/// The largest product of the cosines between the way from one loop to the other and their normals.
constexpr double most_alike = 0.25;

using Pair = std::array<Index, 2>;

[[noreturn]] void refuse(const Pair& bridge, const std::string& reason) {
  throw BadOption(fmt::format("bridge {},{}: {}", bridge[0], bridge[1], reason));
}

/// Throws BadOption unless a tube may end at the hole.
void require_end(const Pair& bridge, const Hole& hole, HoleChoice choice) {
  choice.all = true;
  if (const std::string reason = reason_to_skip(hole, choice); !reason.empty()) {
    refuse(bridge, fmt::format("hole {} is left out: {}", hole.id, reason));
  }
  if (!hole.closed) {
    refuse(bridge, fmt::format("an edge of three or more triangles interrupts the loop of hole {}",
                               hole.id));
  }
  if (!hole.simple) {
    refuse(bridge, fmt::format("the loop of hole {} passes a vertex twice", hole.id));
  }
  if (hole.crack.kind == LoopKind::crack) {
    refuse(bridge, fmt::format("hole {} is {}", hole.id, describe_crack(hole)));
  }
}

void require_apart(const Pair& bridge, const Hole& a, const Hole& b) {
  const auto shared = std::ranges::find_first_of(a.loop, b.loop);
  if (shared != a.loop.end()) {
    refuse(bridge, fmt::format("the loops touch at vertex {}", *shared));
  }
}

/// The middle of a loop, and the unit normal of a surface that fills it.
struct Outlook {
  Vec3 middle, normal = Vec3::Zero();

  Outlook(const Points& mesh, const Hole& hole) {
    const Points X = mesh(hole.loop, Eigen::all);
    middle = X.colwise().mean();
    for (Eigen::Index i = 0; i < X.rows(); ++i) {
      const Vec3 a = X.row(i).transpose() - middle;
      const Vec3 b = X.row((i + 1) % X.rows()).transpose() - middle;
      normal -= a.cross(b);  // the mesh, not the surface that fills it, is to the left
    }
    normal.stableNormalize();
  }
};

/// Whether one loop faces the other, which faces away: a tube between them that goes straight would
/// join the front of the surface with its back.
bool face_alike(const Points& X, const Hole& a, const Hole& b) {
  const Outlook one(X, a), other(X, b);
  const Vec3 way = (other.middle - one.middle).stableNormalized();
  return one.normal.dot(way) * other.normal.dot(way) > most_alike;
}

/// Components that bridges join, with the orientation of each relative to its group.
class Orientations {
 public:
  explicit Orientations(Index components)
      : group_(static_cast<std::size_t>(components)), reversed_(group_.size(), 0) {
    for (std::size_t c = 0; c < group_.size(); ++c) {
      group_[c] = static_cast<Index>(c);
    }
  }

  bool joined(Index a, Index b) const { return group_[a] == group_[b]; }
  bool opposed(Index a, Index b) const { return reversed_[a] != reversed_[b]; }

  /// Joins the group of b to that of a, so that a and b are opposed or not.
  void join(Index a, Index b, bool opposed) {
    const Index from = group_[b];
    const std::uint8_t turn = this->opposed(a, b) != opposed ? 1 : 0;
    for (std::size_t c = 0; c < group_.size(); ++c) {
      if (group_[c] == from) {
        group_[c] = group_[a];
        reversed_[c] ^= turn;
      }
    }
  }

  const std::vector<std::uint8_t>& reversed() const { return reversed_; }

 private:
  std::vector<Index> group_;  // per component
  std::vector<std::uint8_t> reversed_;
};

}  // namespace

bool BridgePlan::reverses_any() const {
  return std::ranges::find(reversed, 1) != reversed.end();
}

BridgePlan plan_bridges(const Points& X, const Topology& topology, const std::vector<Hole>& holes,
                        const HoleChoice& choice) {
  BridgePlan plan;
  plan.other_end.assign(holes.size(), -1);
  Orientations orientations(topology.component_count);
  for (const Pair& bridge : choice.bridges) {
    if (bridge[0] == bridge[1]) {
      refuse(bridge, "its ends must be two different holes");
    }
    for (const Index id : bridge) {
      require_end(bridge, holes[id], choice);
      if (plan.other_end[id] >= 0) {
        refuse(bridge, fmt::format("hole {} is an end of another bridge already", id));
      }
    }
    const Hole &a = holes[bridge[0]], &b = holes[bridge[1]];
    require_apart(bridge, a, b);
    const bool alike = face_alike(X, a, b);
    if (!orientations.joined(a.component, b.component)) {
      orientations.join(a.component, b.component, alike);
    } else if (topology.orientable && orientations.opposed(a.component, b.component) != alike) {
      refuse(bridge,
             "a tube between these holes would make the surface one-sided: one of them faces the "
             "other, which faces away");
    }
    plan.other_end[a.id] = b.id;
    plan.other_end[b.id] = a.id;
  }
  plan.reversed = orientations.reversed();
  return plan;
}

Topology with_reversed_components(const Topology& topology,
                                  const std::vector<std::uint8_t>& reversed) {
  Triangles F = topology.F;
  for (auto x : F.rowwise()) {
    if (const Index component = topology.component[x[0]]; component >= 0 && reversed[component]) {
      std::swap(x[1], x[2]);
    }
  }
  return build_topology(topology.vertex_count, std::move(F), topology.defects.zero_area);
}

}  // namespace ibmfair
