#include "commands/hole_json.h"

#include <nlohmann/json.hpp>

namespace ibmfair::commands {

nlohmann::ordered_json hole_json(const Hole& hole) {
  return {{"id", hole.id},
          {"edges", hole.edges()},
          {"perimeter", hole.perimeter},
          {"diameter", hole.diameter},
          {"closed_loop", hole.closed},
          {"simple", hole.simple},
          {"touches_itself", hole.touches_itself},
          {"kind", name_of(hole.crack.kind)},
          {"crack", hole.crack.kind == LoopKind::crack},
          {"crack_edges", hole.crack.edges},
          {"t_junctions", hole.crack.t_junctions},
          {"slit_width", hole.crack.width},
          {"component", hole.component},
          {"outer_border", hole.outer_border},
          {"border_share", hole.border_share}};
}

}  // namespace ibmfair::commands
