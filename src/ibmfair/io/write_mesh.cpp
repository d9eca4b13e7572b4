// Decides between patching the source's own bytes and generating a new file.
#include <optional>

#include <fmt/format.h>

#include "ibmfair/base/errors.h"
#include "ibmfair/io/atomic_file.h"
#include "ibmfair/io/extend_attributes.h"
#include "ibmfair/io/extend_values.h"
#include "ibmfair/io/extension.h"
#include "ibmfair/io/formats.h"
#include "ibmfair/io/gzip_sink.h"
#include "ibmfair/io/mesh_file.h"
#include "ibmfair/io/precision.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair {
namespace {

const Format& choose_format(const std::string& path, const WriteOptions& options,
                            const Format* source) {
  const std::string extension = path_extension(path);
  const std::string& wanted = options.format.empty() ? extension : options.format;
  const Format* format = wanted.empty() ? source : find_format(wanted);
  if (format == nullptr && wanted.empty()) {
    throw BadOption(fmt::format("{}: name the output's format with --format (one of: {})",
                                path == "-" ? "standard output" : path, writable_formats()));
  }
  if (format == nullptr || format->generate == nullptr) {
    throw BadOption(fmt::format(
        "{}: '{}' is not a mesh format that can be written; name one with --format (one of: {})",
        path == "-" ? "standard output" : path, wanted, writable_formats()));
  }
  return *format;
}

void require_finite(const Points& X) {
  for (Eigen::Index v = 0; v < X.rows(); ++v) {
    if (!X.row(v).allFinite()) {
      throw BadMesh(
          fmt::format("vertex {} has a coordinate that is not finite; nothing is written", v));
    }
  }
}

std::vector<std::uint8_t> find_moved(const Points& before, const Points& after) {
  std::vector<std::uint8_t> moved(static_cast<std::size_t>(before.rows()));
  for (Eigen::Index v = 0; v < before.rows(); ++v) {
    moved[v] = before.row(v) != after.row(v) ? 1 : 0;
  }
  return moved;
}

CoordinateTypes types_of(WriteOptions::Precision precision) {
  switch (precision) {
    case WriteOptions::Precision::float32:
      return CoordinateTypes::float32;
    case WriteOptions::Precision::float64:
      return CoordinateTypes::float64;
    case WriteOptions::Precision::keep:
      break;
  }
  return CoordinateTypes::by_rounding;
}

/// The types for a file that is generated. Only a source of the same format has declared any.
CoordinateTypes types_to_generate(const WriteOptions& options, const RoundingSums& sums) {
  const CoordinateTypes types = types_of(options.precision);
  if (types != CoordinateTypes::by_rounding) return types;
  return float32_suffices(sums) ? CoordinateTypes::as_declared : CoordinateTypes::float64;
}

void note_unused_precision(const Format& format, const WriteOptions& options, WriteReport& report) {
  if (options.precision == WriteOptions::Precision::keep || format.declares_types) return;
  report.notes.push_back(fmt::format(
      "--precision applies to PLY only: {} files do not declare the type of their coordinates",
      format.title));
}

/// The output file, compressed if its name says so.
class MeshOutput {
 public:
  MeshOutput(const std::string& path, const WriteOptions& options)
      : file_(path, options.overwrite) {
    if (is_gzip_name(path)) zipped_.emplace(file_);
  }

  ByteSink& sink() { return zipped_ ? static_cast<ByteSink&>(*zipped_) : file_; }

  WriteReport finish(WriteReport report) {
    if (zipped_) zipped_->finish();
    file_.commit();
    report.bytes = file_.bytes();
    return report;
  }

 private:
  AtomicFile file_;
  std::optional<GzipSink> zipped_;
};

/// Writes a mesh that was read from a file, by patching or by generating; `extension` may be null.
WriteReport write(const MeshFile& source, const Points& X, const Extension* extension,
                  const std::string& path, const WriteOptions& options) {
  const Mesh& mesh = source.mesh();
  if (X.rows() != mesh.X.rows()) {
    throw BadMesh(fmt::format("{} positions for the {} vertices of {}", X.rows(), mesh.X.rows(),
                              source.name()));
  }
  require_finite(X);
  if (extension != nullptr) require_fit(*extension, mesh);
  const Format& format = choose_format(path, options, &source.format());
  const std::vector<std::uint8_t> moved = find_moved(mesh.X, X);

  WriteReport report;
  for (const std::uint8_t flag : moved)
    report.moved_vertices += flag;
  const bool same_format = &format == &source.format();
  const bool retyped = format.declares_types && options.precision != WriteOptions::Precision::keep;
  const bool copied = same_format && report.moved_vertices == 0 && extension == nullptr &&
                      !retyped && (!source.welded() || format.always_weld);
  report.patched = copied || (same_format && format.patch != nullptr && !source.welded());
  MeshOutput output(path, options);
  ByteSink& out = output.sink();
  if (copied) {
    out.write(source.bytes().view());
  } else if (!report.patched) {
    const SourceBytes* flavour = same_format ? &source.bytes() : nullptr;
    MeshAttributes attributes = source.attributes();
    if (extension != nullptr) {
      attributes = extended_attributes(std::move(attributes), mesh, *extension, report.notes);
      // The notes concern OBJ statements, which no other format can hold.
      if (flavour == nullptr) report.notes.clear();
    }
    const Mesh target =
        extension == nullptr ? Mesh{X, mesh.faces} : extended_mesh(mesh, X, *extension);
    RoundingSums sums(mesh, X, static_cast<Index>(X.rows()));
    if (extension != nullptr) sums.add(extension->X);
    const CoordinateTypes types = types_to_generate(options, sums);
    for (std::string& note : format.generate({target, attributes, flavour, types}, out))
      report.notes.push_back(std::move(note));
  } else {
    report.notes =
        format.patch({source.bytes(), mesh, source.has_texture_coordinates(), source.has_normals(),
                      X, moved, report.moved_vertices > 0, types_of(options.precision), extension},
                     out);
  }
  note_unused_precision(format, options, report);
  return output.finish(std::move(report));
}

}  // namespace

WriteReport write_mesh(const MeshFile& source, const Points& X, const std::string& path,
                       const WriteOptions& options) {
  return write(source, X, nullptr, path, options);
}

WriteReport write_mesh(const MeshFile& source, const Points& X, const Extension& extension,
                       const std::string& path, const WriteOptions& options) {
  const bool adds_nothing = extension.X.rows() == 0 && extension.F.rows() == 0;
  return write(source, X, adds_nothing ? nullptr : &extension, path, options);
}

void require_writable_format(const MeshFile& source, const std::string& path,
                             const WriteOptions& options) {
  choose_format(path, options, &source.format());
}

WriteReport write_mesh(const Mesh& mesh, const std::string& path, const WriteOptions& options) {
  require_finite(mesh.X);
  const Format& format = choose_format(path, options, nullptr);
  MeshOutput output(path, options);
  ByteSink& out = output.sink();
  WriteReport report;
  report.moved_vertices = mesh.X.rows();
  const MeshAttributes none;
  report.notes = format.generate({mesh, none, nullptr, types_of(options.precision)}, out);
  note_unused_precision(format, options, report);
  return output.finish(std::move(report));
}

}  // namespace ibmfair
