#include "cloth/plate.h"

#include <utility>

#include "ibmfair/mesh/geometry.h"

namespace ibmfair::cloth {
namespace {

template <class Table>
void append_rows(const Table& table, CompressedRows& rows) {
  for (Index i = 0; i < table.rows(); ++i) {
    rows.value.insert(rows.value.end(), table.row(i).data(), table.row(i).data() + table.cols());
    rows.first.push_back(static_cast<std::int64_t>(rows.value.size()));
  }
}

}  // namespace

Plate make_plate(const Points& rest, const Triangles& F, const Material& material,
                 std::vector<std::uint8_t> fixed) {
  Plate plate{rest, build_topology(rest, F), material, std::move(fixed), {}};
  plate.fixed.resize(static_cast<std::size_t>(rest.rows()), 0);
  plate.mass = material.density * lumped_vertex_mass(rest, plate.topology);
  return plate;
}

CompressedRows triangle_rows(const Topology& topology) {
  CompressedRows rows;
  append_rows(topology.F, rows);
  return rows;
}

CompressedRows hinge_rows(const Topology& topology) {
  CompressedRows rows;
  append_rows(topology.H, rows);
  return rows;
}

CompressedRows element_rows(const Topology& topology) {
  CompressedRows rows = triangle_rows(topology);
  append_rows(topology.H, rows);
  return rows;
}

}  // namespace ibmfair::cloth
