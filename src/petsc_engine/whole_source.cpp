#include "petsc_engine/whole_source.h"

#include <fmt/format.h>

#include "ibmfair/base/errors.h"

namespace ibmfair::petsc {
namespace {

/// Distributes rows that the first rank holds: each rank gets the rows of its block.
template <class T>
std::vector<T> deal(const Communicator& comm, const Blocks& blocks, std::vector<T> rows) {
  Parcels<T> sent{std::move(rows), std::vector<int>(static_cast<std::size_t>(comm.size()), 0)};
  for (int r = 0; comm.is_first() && r < comm.size(); ++r) {
    sent.counts[r] = static_cast<int>(blocks.count(r));
  }
  return comm.exchange(sent).items;
}

template <class T, class Matrix>
std::vector<std::array<T, 3>> rows_of(const Matrix& matrix) {
  std::vector<std::array<T, 3>> rows;
  rows.reserve(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2)});
  }
  return rows;
}

}  // namespace

WholeSource::WholeSource(const Communicator& comm, const std::string& path,
                         const commands::InputOptions& options, const commands::Host& host)
    : comm_(comm) {
  std::vector<std::array<double, 3>> X;
  std::vector<std::array<Index, 3>> F;
  comm.together([&] {
    if (comm.is_first()) {
      file_ = commands::read_input(path, options, host);
      X = rows_of<double>(file_.mesh().X);
      F = rows_of<Index>(triangulate(file_.mesh()).F);
      has_texture_ = file_.has_texture_coordinates();
    }
  });
  vertices_ = {comm.sum(static_cast<std::int64_t>(X.size())), comm.size()};
  mesh_.vertices = vertices_;
  mesh_.triangles = {comm.sum(static_cast<std::int64_t>(F.size())), comm.size()};
  has_texture_ = comm.any(has_texture_);
  mesh_.X = deal(comm, mesh_.vertices, std::move(X));
  mesh_.F = deal(comm, mesh_.triangles, std::move(F));
}

std::vector<std::uint8_t> WholeSource::vertex_mask(const std::string& name) {
  std::vector<std::uint8_t> mask;
  comm_.together([&] {
    if (comm_.is_first()) {
      mask = file_.vertex_mask(name);
    }
  });
  return deal(comm_, vertices_, std::move(mask));
}

std::vector<double> WholeSource::vertex_values(const std::string& name) {
  std::vector<double> values;
  comm_.together([&] {
    if (comm_.is_first()) {
      auto found = file_.vertex_values(name);
      if (!found) {
        throw BadOption(fmt::format("{}: no vertex property is called '{}'", file_.name(), name));
      }
      values = std::move(*found);
    }
  });
  return deal(comm_, vertices_, std::move(values));
}

WriteReport WholeSource::write(const MeshPiece& piece, const Points& X, const std::string& path,
                               const WriteOptions& options) {
  const std::vector<Index> own(piece.vertex.begin(), piece.vertex.begin() + piece.own);
  std::vector<std::array<double, 3>> block(static_cast<std::size_t>(vertices_.count(comm_.rank())));
  deliver(comm_, vertices_, own, rows_of<double>(X.topRows(piece.own)), block);
  const std::vector<std::array<double, 3>> all = comm_.gather_to_first(block);
  WriteReport report;
  comm_.together([&] {
    if (comm_.is_first()) {
      Points after(static_cast<Eigen::Index>(all.size()), 3);
      for (std::size_t v = 0; v < all.size(); ++v) {
        after.row(static_cast<Eigen::Index>(v)) = Vec3(all[v][0], all[v][1], all[v][2]);
      }
      report = write_mesh(file_, after, path, options);
    }
  });
  return report;
}

}  // namespace ibmfair::petsc
