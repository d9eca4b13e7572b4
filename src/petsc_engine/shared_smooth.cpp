#include "petsc_engine/shared_smooth.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/defect_warnings.h"
#include "commands/progress.h"
#include "commands/report/report_formats.h"
#include "commands/signals.h"
#include "commands/smooth_arguments.h"
#include "commands/smooth_plan.h"
#include "commands/smooth_remarks.h"
#include "commands/smooth_report.h"
#include "commands/smooth_run.h"
#include "commands/vertex_list.h"
#include "commands/vertex_values.h"
#include "ibmfair/base/errors.h"
#include "ibmfair/base/process_memory.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/flow/part_measures.h"
#include "ibmfair/flow/willmore_flow.h"
#include "ibmfair/io/atomic_file.h"
#include "petsc_engine/mesh_source.h"
#include "petsc_engine/partition.h"
#include "petsc_engine/petsc_jacobian.h"
#include "petsc_engine/piece_measures.h"

namespace ibmfair::petsc {
namespace {

using commands::Console;
using commands::ExitCode;
using commands::Host;
using commands::Progress;
using commands::Report;
using commands::SmoothArguments;
using commands::SmoothInput;
using commands::SmoothResult;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Throws BadOption for options that need the whole mesh in one process.
void require_shareable(const SmoothArguments& arguments) {
  const auto refuse = [](bool asked, const char* option) {
    if (asked) {
      throw BadOption(fmt::format(
          "{} needs the whole mesh in one process, so it cannot be combined with --engine petsc",
          option));
    }
  };
  refuse(!arguments.picture.path.empty(), "--picture");
  refuse(arguments.dry_run, "--dry-run");
  refuse(arguments.denoise, "--denoise");
  refuse(arguments.boundary == "fair", "--boundary fair");
  refuse(arguments.cutoff_auto, "--cutoff auto");
  refuse(arguments.first_stage == "normals", "--first-stage normals");
  refuse(std::isfinite(arguments.flow.memory_limit), "--memory");
  refuse(arguments.flow.keep_volume, "--keep-volume");
  refuse(arguments.flow.keep_area, "--keep-area");
  refuse(arguments.flow.solver == "multifrontal", "--solver multifrontal");
  refuse(arguments.flow.solver == "cholmod", "--solver cholmod");
  for (const std::string& path : arguments.report.paths) {
    refuse(path.ends_with(".html"), "a page as --report");
  }
}

/// The piece of this rank, with the data at its vertices.
struct SharedMesh {
  std::unique_ptr<MeshSource> source;
  MeshPiece piece;
  std::unique_ptr<PetscParts> parts;
  Topology topology;
  Points X;  // after

  /// The values at the piece's vertices, from values that are distributed in blocks.
  template <class T>
  std::vector<T> at_vertices(const std::vector<T>& block) const {
    return fetch(parts->communicator(), piece.vertices, block, piece.vertex);
  }
};

SharedMesh read(const Communicator& comm, const SmoothArguments& arguments, const Host& host,
                SmoothResult& result, Progress& progress) {
  SharedMesh mesh;
  progress.begin("read");
  {
    const Stopwatch watch(result.seconds_read);
    mesh.source =
        open_source(comm, arguments.input, arguments.output.path, arguments.reading, host);
  }
  progress.begin("distribute");
  const Stopwatch watch(result.seconds_topology);
  const BlockMesh blocks = mesh.source->take_mesh();
  mesh.piece = make_piece(comm, blocks, partition_vertices(comm, blocks.vertices, blocks.F));
  mesh.parts = std::make_unique<PetscParts>(comm, mesh.piece);
  comm.together([&] { mesh.topology = build_topology(mesh.piece.X, mesh.piece.F); });
  mesh.X = mesh.piece.X;
  result.vertices = mesh.piece.vertices.total;
  result.triangles = mesh.piece.triangles.total;
  const Topology& topology = mesh.topology;
  const auto on_boundary = [&](Index v) { return topology.kind[v] == VertexKind::boundary; };
  bool open = false;
  for (Index v = 0; v < mesh.piece.own; ++v) {
    open = open || on_boundary(v);
  }
  result.has_rims = comm.any(open);
  result.closed = !result.has_rims;
  return mesh;
}

/// A property of the vertices; its values must be finite and at least `least`.
Eigen::VectorXd values_of(const SharedMesh& mesh, const SmoothArguments& arguments,
                          const std::string& property, double least, const std::string& option) {
  const std::vector<double> values = mesh.at_vertices(mesh.source->vertex_values(property));
  mesh.parts->communicator().together([&] {
    for (Index v = 0; v < mesh.piece.own; ++v) {
      commands::require_vertex_value(values[v], least, mesh.piece.vertex[v], arguments.input,
                                     property, option);
    }
  });
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

/// The values of --h0.
Eigen::VectorXd spontaneous_curvature(const SharedMesh& mesh, const SmoothArguments& arguments) {
  if (mesh.parts->any(mesh.topology.turned_triangles > 0)) {
    throw BadMesh("--h0 needs triangles that all look to the same side of the surface");
  }
  const std::optional<double> number = commands::finite_number(arguments.h0);
  return number ? Eigen::VectorXd::Constant(mesh.X.rows(), *number)
                : values_of(mesh, arguments, arguments.h0, -infinity, "--h0");
}

/// The own vertices of the piece that a list of vertices of the whole mesh names.
std::vector<Index> own_vertices(const std::vector<Index>& numbers, const MeshPiece& piece) {
  std::vector<Index> own;
  for (const Index number : numbers) {
    const auto own_end = piece.vertex.begin() + piece.own;
    const auto found = std::lower_bound(piece.vertex.begin(), own_end, number);
    if (found != own_end && *found == number) {
      own.push_back(static_cast<Index>(found - piece.vertex.begin()));
    }
  }
  return own;
}

/// The piece with the data at its vertices that the options name.
SmoothInput input_of(const SmoothArguments& arguments, const SharedMesh& mesh) {
  SmoothInput input{.X = mesh.piece.X, .topology = mesh.topology, .parts = *mesh.parts};
  input.textured = mesh.source->has_texture_coordinates();
  if (!arguments.weights.empty()) {
    input.weights = values_of(mesh, arguments, arguments.weights, 0, "--weights");
  }
  if (!arguments.h0.empty()) {
    input.h0 = spontaneous_curvature(mesh, arguments);
  }
  mesh.parts->communicator().together([&] {
    if (!arguments.fix_file.empty()) {
      const auto total = static_cast<Index>(mesh.piece.vertices.total);
      input.listed =
          own_vertices(commands::read_vertex_list("--fix", arguments.fix_file, total), mesh.piece);
    }
  });
  if (!arguments.mask.empty()) {
    input.mask = mesh.at_vertices(mesh.source->vertex_mask(arguments.mask));
  }
  const LinearSolver solver =
      arguments.flow.solver == "mumps" ? LinearSolver::mumps : LinearSolver::cg;
  input.make_solver = [&parts = *mesh.parts, solver](const JacobianShape& shape) {
    return std::make_unique<PetscJacobian>(shape, parts, solver);
  };
  return input;
}

void measure_moves(const SharedMesh& mesh, SmoothResult& result) {
  const Index own = mesh.piece.own;
  SmoothResult here;
  commands::measure_moves(mesh.piece.X.topRows(own), mesh.X.topRows(own), here);
  result.largest_move = mesh.parts->max(here.largest_move);
  const double squares = mesh.parts->sum(here.rms_move * here.rms_move * own);
  result.rms_move = std::sqrt(squares / static_cast<double>(mesh.piece.vertices.total));
}

/// The share of each rank in the work, for the report.
nlohmann::ordered_json ranks_json(const Communicator& comm, const MeshPiece& piece) {
  struct Share {
    std::int64_t vertices, others, triangles;
    double memory;
  };
  const std::vector<Share> shares = comm.gather_to_first(std::vector{Share{
      piece.own, std::ssize(piece.vertex) - piece.own, piece.F.rows(), peak_resident_bytes()}});
  nlohmann::ordered_json ranks = nlohmann::ordered_json::array();
  for (const Share& share : shares) {
    ranks.push_back({{"vertices", share.vertices},
                     {"vertices_of_others", share.others},
                     {"triangles", share.triangles},
                     {"peak_memory_bytes", share.memory}});
  }
  return ranks;
}

class SharedSmooth {
 public:
  SharedSmooth(const Communicator& comm, const SmoothArguments& arguments, const CLI::App& app,
               Host& host)
      : comm_(comm), arguments_(arguments), host_(host), console_(host.console()), report_(app) {}

  ExitCode run() {
    if (!comm_.is_first()) {
      console_.set_level(Console::Level::quiet);
    }
    comm_.together([&] {
      require_shareable(arguments_);
      if (comm_.is_first()) {
        commands::check_outputs(arguments_);
        require_writable(arguments_.output);
      }
    });
    Progress progress(console_);
    SharedMesh mesh = read(comm_, arguments_, host_, result_, progress);
    print_defects(mesh);
    result_.plan = commands::plan_smoothing(arguments_, input_of(arguments_, mesh), progress);
    progress.begin("measure");
    result_.before = measured(mesh);
    {
      std::optional<commands::PostponedEnd> postponed;
      if (!arguments_.checkpoint.empty()) {
        postponed.emplace();
      }
      result_.flow = commands::run_smoothing(
          result_.plan, mesh.X, mesh.topology, *mesh.parts, [this] { return host_.wants_end(); },
          progress);
    }
    progress.begin("measure");
    result_.after = measured(mesh);
    measure_moves(mesh, result_);
    write(mesh, progress);
    return commands::exit_code_of(result_);
  }

 private:
  static void require_writable(const commands::OutputOptions& output) {
    if (output.path != "-") {
      ibmfair::require_writable(output.path, output.write.overwrite);
    }
  }

  commands::MeshStatistics measured(const SharedMesh& mesh) {
    const Stopwatch watch(result_.seconds_measure);
    return mesh_statistics(mesh.piece, mesh.X, mesh.topology, result_.plan.flow, *mesh.parts);
  }

  void print_defects(const SharedMesh& mesh) {
    const Topology defects = gathered_defects(comm_, mesh.topology, mesh.piece);
    comm_.together([&] {
      if (comm_.is_first()) {
        commands::warn_of_defects(defects, arguments_.strict, console_);
        report_.figures["defects"] = commands::defects_json(defects);
        for (const std::string& line : commands::defect_lines(defects)) {
          report_.warnings.push_back({line});
        }
      }
    });
  }

  void write(const SharedMesh& mesh, Progress& progress) {
    const commands::OutputOptions output = commands::output_of(arguments_, result_.flow.status);
    WriteReport written;
    progress.begin("write");
    {
      const Stopwatch watch(result_.seconds_write);
      written = mesh.source->write(mesh.piece, mesh.X, output.path, output.write);
    }
    progress.end();
    const nlohmann::ordered_json ranks = ranks_json(comm_, mesh.piece);
    comm_.together([&] {
      if (comm_.is_first()) {
        tell(written, output, ranks);
      }
    });
  }

  void tell(const WriteReport& written, const commands::OutputOptions& output,
            const nlohmann::ordered_json& ranks) {
    report_.figures["ranks"] = ranks;
    print_result(arguments_, result_, output.path, written,
                 fmt::format(", on {} ranks", comm_.size()), console_, report_);
    host_.deliver(arguments_.report, output.write.overwrite, report_);
  }

  const Communicator& comm_;
  const SmoothArguments& arguments_;
  Host& host_;
  Console& console_;
  Report report_;
  SmoothResult result_;
};

}  // namespace

commands::Runner declare_shared_smooth(CLI::App& app, const Communicator& comm) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments, &app, &comm](Host& host) {
    if (app["--threads"]->empty()) {
      set_thread_count(1);  // by default each rank uses one core
    }
    return SharedSmooth(comm, *arguments, app, host).run();
  };
}

}  // namespace ibmfair::petsc
