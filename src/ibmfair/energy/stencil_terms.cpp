#include "ibmfair/energy/stencil_terms.h"

namespace ibmfair {
namespace {

bool all_have(const CompressedRows& rows, std::int64_t width) {
  for (std::size_t i = 0; i < rows.first.size(); ++i) {
    if (rows.first[i] != width * static_cast<std::int64_t>(i)) {
      return false;
    }
  }
  return true;
}

}  // namespace

StencilTerms::StencilTerms(const CompressedRows& stencils, Index vertex_count)
    : stencils_(stencils),
      places_(positions_by_value(stencils.value, vertex_count)),
      all_are_hinges_(all_have(stencils, hinge_width)),
      stencil_of_place_(all_are_hinges_ ? std::vector<Index>{} : row_of_position(stencils)) {}

}  // namespace ibmfair
