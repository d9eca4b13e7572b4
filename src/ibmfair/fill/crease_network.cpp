#include "ibmfair/fill/crease_network.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "ibmfair/base/angle.h"
#include "ibmfair/fill/crease_joints.h"

namespace ibmfair {
namespace {

constexpr std::size_t most_ends = 8;

using Ends = std::vector<Index>;      // numbers of ends, in the order of the rim
using Partition = std::vector<Ends>;  // groups of ends that are joined

/// Every way to divide the ends into groups that do not cross.
std::vector<Partition> partitions(const Ends& ends) {
  if (ends.empty()) {
    return {{}};
  }
  std::vector<Partition> all;
  const std::size_t others = ends.size() - 1;
  for (std::size_t mask = 0; mask < std::size_t{1} << others; ++mask) {
    Ends group{ends.front()};
    std::vector<Partition> sofar{{}};
    Ends gap;
    for (std::size_t i = 0; i <= others; ++i) {
      const bool is_member = i < others && (mask >> i & 1) != 0;
      if (i < others && !is_member) {
        gap.push_back(ends[i + 1]);
        continue;
      }
      std::vector<Partition> joined;
      for (const Partition& inside : partitions(gap)) {
        for (const Partition& before : sofar) {
          joined.push_back(before);
          joined.back().insert(joined.back().end(), inside.begin(), inside.end());
        }
      }
      sofar = std::move(joined);
      gap.clear();
      if (is_member) {
        group.push_back(ends[i + 1]);
      }
    }
    for (Partition& partition : sofar) {
      partition.push_back(group);
      all.push_back(std::move(partition));
    }
  }
  return all;
}

/// Builds the curves of the chosen joints, and walks around the sheets.
class NetworkBuilder {
 public:
  NetworkBuilder(const CreasedRim& rim, double spacing)
      : rim_(rim), spacing_(spacing), at_end_(rim.ends.size()) {}

  void add(const CreaseJoint& joint) {
    if (joint.corners.empty()) {
      const Index i = joint.ends[0], j = joint.ends[1];
      add_curve(i, j, blend(rim_.ends[i].curve, rim_.ends[j].curve, spacing_));
      return;
    }
    std::vector<Index> nodes;
    for (const Vec3& corner : joint.corners) {
      nodes.push_back(static_cast<Index>(rim_.ends.size() + network_.corners.size()));
      network_.corners.push_back(corner);
      branches_.emplace_back();
    }
    for (std::size_t i = 0; i < joint.ends.size(); ++i) {
      const std::size_t c = i < joint.at_first ? 0 : 1;
      const Index end = joint.ends[i];
      add_curve(end, nodes[c], arc_to(rim_.ends[end].curve, joint.corners[c], spacing_));
    }
    if (nodes.size() == 2) {
      const Vec3 link = joint.corners[1] - joint.corners[0];
      const CurveEnd start{joint.corners[0], link.normalized()};
      add_curve(nodes[0], nodes[1], arc_to(start, joint.corners[1], spacing_));
    }
  }

  CreaseNetwork build() {
    std::vector<std::uint8_t> seen(rim_.ends.size(), 0);
    for (std::size_t first = 0; first < seen.size(); ++first) {
      std::vector<SheetSide> sheet;
      for (auto arc = static_cast<Index>(first); !seen[arc];) {
        seen[arc] = 1;
        sheet.push_back({SheetSide::Kind::arc, arc});
        arc = walk_inside(arc + 1 < std::ssize(seen) ? arc + 1 : 0, sheet);
      }
      if (!sheet.empty()) {
        network_.sheets.push_back(std::move(sheet));
      }
    }
    return std::move(network_);
  }

 private:
  /// A curve as it leaves a node.
  struct Branch {
    Index curve = -1;
    bool forward = true;
  };

  void add_curve(Index from, Index to, CurvePoints points) {
    const auto number = static_cast<Index>(network_.curves.size());
    network_.curves.push_back({from, to, std::move(points)});
    for (const auto& [node, forward] : {std::pair(from, true), std::pair(to, false)}) {
      const Index corner = node - static_cast<Index>(rim_.ends.size());
      if (corner < 0) {
        at_end_[node] = {number, forward};
      } else {
        branches_[corner].push_back({number, forward});
      }
    }
  }

  /// Walks from an end along curves, with the sheet to the left, until the rim is reached. Returns
  /// the end there. The branches of a corner are listed in the order of the rim, so that the next
  /// one to the left is the one before.
  Index walk_inside(Index end, std::vector<SheetSide>& sheet) const {
    Branch branch = at_end_[end];
    while (true) {
      sheet.push_back({branch.forward ? SheetSide::Kind::curve : SheetSide::Kind::reversed_curve,
                       branch.curve});
      const CreaseCurve& curve = network_.curves[branch.curve];
      const Index node = branch.forward ? curve.to : curve.from;
      const Index corner = node - static_cast<Index>(rim_.ends.size());
      if (corner < 0) {
        return node;
      }
      const std::vector<Branch>& all = branches_[corner];
      const auto it = std::ranges::find(all, branch.curve, &Branch::curve);
      branch = it == all.begin() ? all.back() : *(it - 1);
    }
  }

  const CreasedRim& rim_;
  const double spacing_;
  CreaseNetwork network_;
  std::vector<Branch> at_end_;
  std::vector<std::vector<Branch>> branches_;  // per corner
};

/// Removes the ends that are joined to no other, and numbers the others anew.
void leave_out_single(std::vector<CreaseJoint>& joints, CreasedRim& rim) {
  std::vector<Index> single;
  std::erase_if(joints, [&](const CreaseJoint& joint) {
    if (joint.ends.size() == 1) {
      single.push_back(joint.ends.front());
    }
    return joint.ends.size() == 1;
  });
  std::ranges::sort(single, std::greater());
  for (const Index end : single) {
    remove_end(end, rim);
  }
  for (CreaseJoint& joint : joints) {
    for (Index& end : joint.ends) {
      end -= static_cast<Index>(
          std::ranges::count_if(single, [end](Index other) { return other < end; }));
    }
  }
}

}  // namespace

CreaseNetwork continue_creases(CreasedRim& rim, const Vec3& middle, double reach, double spacing) {
  CreaseNetwork network;
  const std::size_t count = rim.ends.size();
  if (count > most_ends) {
    network.flaw = fmt::format("{} creases end at its rim", count);
    return network;
  }
  Ends ends;
  for (std::size_t i = 0; i < count; ++i) {
    ends.push_back(static_cast<Index>(i));
  }
  const JointChoice choice(rim, middle, reach);
  std::vector<CreaseJoint> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Partition& partition : partitions(ends)) {
    std::vector<CreaseJoint> joints;
    double cost = 0;
    for (const Ends& group : partition) {
      joints.push_back(choice.best(group));
      cost += joints.back().cost;
    }
    if (cost < least) {
      least = cost;
      best = std::move(joints);
    }
  }
  leave_out_single(best, rim);
  if (!rim.has_creases()) {
    network.flaw = count == 1 ? "a single crease ends at its rim"
                              : fmt::format("the {} creases at its rim do not fit together", count);
    return network;
  }
  if (rim.ends.empty()) {  // creases run along the rim only
    network.sheets = {{{SheetSide::Kind::arc, 0}}};
    return network;
  }
  NetworkBuilder builder(rim, spacing);
  for (const CreaseJoint& joint : best) {
    builder.add(joint);
  }
  return builder.build();
}

}  // namespace ibmfair
