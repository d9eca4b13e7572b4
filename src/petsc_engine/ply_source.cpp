#include "petsc_engine/ply_source.h"

#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/precision.h"
#include "petsc_engine/row_exchange.h"

namespace ibmfair::petsc {
namespace {

constexpr std::size_t largest_header = std::size_t{1} << 16;

/// The first bytes of a file; empty if the file cannot be read.
std::string start_of(const std::string& path) {
  std::string bytes(largest_header, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

}  // namespace

PlySource::PlySource(const Communicator& comm, const std::string& path, PlyRows rows)
    : comm_(comm), path_(path), rows_(std::move(rows)) {
  file_ = std::make_unique<MpiFile>(comm, path, path, MpiFile::Mode::read);
  vertices_ = {rows_.vertices(), comm.size()};
  mesh_.vertices = vertices_;
  mesh_.triangles = {rows_.triangles(), comm.size()};
}

std::unique_ptr<PlySource> PlySource::open(const Communicator& comm, const std::string& path) {
  const std::string start = comm.from_first(comm.is_first() ? start_of(path) : std::string());
  if (!ply::recognises(start)) {
    return nullptr;
  }
  const std::int64_t size = MpiFile(comm, path, path, MpiFile::Mode::read).size();
  std::optional<PlyRows> rows = PlyRows::find(path, start, size);
  if (!rows) {
    return nullptr;
  }
  std::unique_ptr<PlySource> source(new PlySource(comm, path, std::move(*rows)));
  return source->read() ? std::move(source) : nullptr;
}

std::string PlySource::rows_of_block(std::int64_t offset, std::int64_t row, const Blocks& blocks) {
  return file_->read(offset + row * blocks.first(comm_.rank()), row * blocks.count(comm_.rank()));
}

bool PlySource::read() {
  auto X = rows_.positions(rows_of_block(rows_.vertex_offset(), rows_.vertex_row(), vertices_));
  auto F =
      rows_.corners(rows_of_block(rows_.triangle_offset(), rows_.triangle_row(), mesh_.triangles));
  if (comm_.any(!X || !F)) {
    return false;
  }
  mesh_.X = std::move(*X);
  mesh_.F = std::move(*F);
  return true;
}

std::vector<double> PlySource::vertex_values(const std::string& name) {
  auto values =
      rows_.values(rows_of_block(rows_.vertex_offset(), rows_.vertex_row(), vertices_), name);
  if (!values) {  // on all ranks, because they depend on the header only
    throw BadOption(fmt::format("{}: no vertex property is called '{}'; there are: {}", path_, name,
                                fmt::join(rows_.property_names(), ", ")));
  }
  return std::move(*values);
}

std::vector<std::uint8_t> PlySource::vertex_mask(const std::string& name) {
  std::vector<std::uint8_t> mask;
  for (const double value : vertex_values(name)) {
    mask.push_back(ply::selects(value) ? 1 : 0);
  }
  return mask;
}

void PlySource::write_moved(MpiFile& out, const MeshPiece& piece, const Points& X,
                            const PlyRows::Rewriting& rewriting, const RowTypes& types) {
  const std::vector<Index> own(piece.vertex.begin(), piece.vertex.begin() + piece.own);
  std::string rows;
  const std::string old = fetch_rows(
      comm_, vertices_, rows_of_block(rows_.vertex_offset(), rows_.vertex_row(), vertices_),
      rows_.vertex_row(), own);
  comm_.together([&] { rows = rows_.rewritten(old, piece, X, types); });
  const std::int64_t header = rows_.first_row_offset();
  const auto new_header = static_cast<std::int64_t>(rewriting.header.size());
  const std::int64_t shift = new_header - header;
  const std::int64_t behind = rows_.vertex_offset() + rows_.vertex_row() * rows_.vertices();
  const std::int64_t new_behind = rows_.vertex_offset() + shift + rewriting.row * rows_.vertices();
  out.write(0, comm_.is_first() ? rewriting.header : std::string());
  out.copy(*file_, header, rows_.vertex_offset(), new_header);
  out.write(rows_.vertex_offset() + shift + rewriting.row * vertices_.first(comm_.rank()),
            deliver_rows(comm_, vertices_, rows, rewriting.row, own));
  out.copy(*file_, behind, file_->size(), new_behind);
}

RowTypes PlySource::types_of(const MeshPiece& piece, const Points& X,
                             const WriteOptions& options) const {
  RoundingSums sums(mesh_from_triangles(piece.X, piece.F), X, piece.own);
  for (double* sum : {&sums.rounding, &sums.moves, &sums.lengths}) {
    *sum = comm_.sum(*sum);
  }
  for (std::int64_t* sum : {&sums.written, &sums.moved, &sums.edges}) {
    *sum = comm_.sum(*sum);
  }
  const std::string cost = float32_suffices(sums) ? std::string() : why_float32_fails(sums);
  switch (options.precision) {
    case WriteOptions::Precision::float32:
      comm_.together([&] {
        require_float32_range(X.topRows(piece.own), "a PLY file with float coordinates",
                              [&](Index v) { return piece.vertex[v]; });
      });
      return {CoordinateTypes::float32};
    case WriteOptions::Precision::float64:
      return {CoordinateTypes::float64};
    case WriteOptions::Precision::keep:
      break;
  }
  return {cost.empty() ? CoordinateTypes::as_declared : CoordinateTypes::float64, cost};
}

WriteReport PlySource::write(const MeshPiece& piece, const Points& X, const std::string& path,
                             const WriteOptions& options) {
  WriteReport report;
  report.patched = true;
  std::int64_t moved = 0;
  for (Index v = 0; v < piece.own; ++v) {
    moved += X.row(v) != piece.X.row(v) ? 1 : 0;
  }
  report.moved_vertices = comm_.sum(moved);
  const std::string row = file_->read(rows_.vertex_offset(), rows_.vertex_row());
  const RowTypes types = types_of(piece, X, options);
  const PlyRows::Rewriting rewriting = rows_.rewriting(row, types);

  std::unique_ptr<AtomicFile> target;  // only on the first rank
  std::string shared;
  comm_.together([&] {
    if (!X.topRows(piece.own).allFinite()) {
      throw BadMesh("a vertex has a coordinate that is not finite; nothing is written");
    }
    if (comm_.is_first()) {
      target = std::make_unique<AtomicFile>(path, options.overwrite, AtomicFile::Sharing::by_name);
      shared = target->shared_name();
    }
  });
  {
    MpiFile out(comm_, comm_.from_first(shared), path, MpiFile::Mode::write);
    if (report.moved_vertices > 0 || options.precision != WriteOptions::Precision::keep) {
      write_moved(out, piece, X, rewriting, types);
      report.notes = rewriting.notes;
    } else {
      out.copy(*file_, 0, file_->size(), 0);
    }
    out.sync();
    report.bytes = out.size();
  }
  comm_.together([&] {
    if (target) {
      target->commit();
    }
  });
  return report;
}

}  // namespace ibmfair::petsc
