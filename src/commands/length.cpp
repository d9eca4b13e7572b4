#include "commands/length.h"

#include <fmt/format.h>

#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/flow/part_measures.h"

namespace ibmfair::commands {

double Length::on(const Points& X, const Topology& topology, const MeshParts& parts) const {
  switch (unit) {
    case Unit::edges:
      return value * mean_edge_length(X, topology, parts);
    case Unit::diagonal:
      return value / 100 * diagonal(X, parts);
    case Unit::absolute:
      break;
  }
  return value;
}

Length parse_length_option(std::string_view name, std::string_view text, Length::Unit unit) {
  std::string_view number = text;
  if (!number.empty()) {
    const char last = number.back();
    if (last == 'e' || last == '%' || last == 'u') {
      unit = last == 'e'   ? Length::Unit::edges
             : last == '%' ? Length::Unit::diagonal
                           : Length::Unit::absolute;
      number.remove_suffix(1);
    }
  }
  try {
    return {parse_real_option(name, number, positive), unit};
  } catch (const BadOption&) {
    throw BadOption(fmt::format(
        "{}: '{}' is not a positive length; write 8e (mean edge lengths), 2% (of the bounding "
        "box's diagonal) or 0.5u (mesh units)",
        name, text));
  }
}

void note_units_of_length(CLI::App& app, const CLI::Option& option, Length::Unit unit) {
  note_of(app, option).unit =
      unit == Length::Unit::edges
          ? "mean edge lengths (8 or 8e), % of the bounding box's diagonal (2%), mesh units (0.5u)"
          : "mesh units (0.5 or 0.5u), mean edge lengths (8e), % of the bounding box's diagonal "
            "(2%)";
}

}  // namespace ibmfair::commands
