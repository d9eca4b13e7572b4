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
#include "commands/smooth_arguments.h"
#include "commands/smooth_report.h"
#include "commands/smooth_setup.h"
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
using commands::Progress;
using commands::Report;
using commands::SmoothArguments;
using commands::SmoothFigures;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Throws BadOption for options that need the whole mesh in one process.
void require_shareable(const SmoothArguments& arguments) {
  const auto refuse = [](bool asked, const char* option) {
    if (asked) {
      throw BadOption(
          fmt::format("{} needs the mesh in one place: not with --engine petsc", option));
    }
  };
  refuse(!arguments.picture.path.empty(), "--picture");
  refuse(arguments.dry_run, "--dry-run");
  refuse(arguments.denoise, "--denoise");
  refuse(arguments.cutoff_auto, "--cutoff auto");
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

SharedMesh read(const Communicator& comm, const SmoothArguments& arguments, const Console& console,
                SmoothFigures& figures, Progress& progress) {
  SharedMesh mesh;
  progress.begin("read");
  {
    const Stopwatch watch(figures.seconds_read);
    mesh.source =
        open_source(comm, arguments.input, arguments.output.path, arguments.reading, console);
  }
  progress.begin("distribute");
  const Stopwatch watch(figures.seconds_topology);
  const BlockMesh blocks = mesh.source->take_mesh();
  mesh.piece = make_piece(comm, blocks, partition_vertices(comm, blocks.vertices, blocks.F));
  mesh.parts = std::make_unique<PetscParts>(comm, mesh.piece);
  comm.together([&] { mesh.topology = build_topology(mesh.piece.X, mesh.piece.F); });
  mesh.X = mesh.piece.X;
  figures.vertices = mesh.piece.vertices.total;
  figures.triangles = mesh.piece.triangles.total;
  const Topology& topology = mesh.topology;
  const auto on_boundary = [&](Index v) { return topology.kind[v] == VertexKind::boundary; };
  bool open = false;
  for (Index v = 0; v < mesh.piece.own; ++v) {
    open = open || on_boundary(v);
  }
  figures.closed = !comm.any(open);
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

FlowOptions flow_options(const SmoothArguments& arguments, const SharedMesh& mesh) {
  FlowOptions options = arguments.flow;
  commands::set_flow_options(arguments, options);
  if (!arguments.weights.empty()) {
    options.cutoff_factor = values_of(mesh, arguments, arguments.weights, 0, "--weights");
  }
  if (!arguments.h0.empty()) {
    if (const std::optional<double> number = commands::finite_number(arguments.h0)) {
      options.spontaneous_curvature = Eigen::VectorXd::Constant(mesh.X.rows(), *number);
    } else {
      options.spontaneous_curvature = values_of(mesh, arguments, arguments.h0, -infinity, "--h0");
    }
    if (mesh.parts->any(mesh.topology.turned_triangles > 0)) {
      throw BadMesh("--h0 needs triangles that all look to the same side of the surface");
    }
  }
  return options;
}

std::vector<std::uint8_t> fixed(const SmoothArguments& arguments, const SharedMesh& mesh,
                                const Eigen::VectorXd& weights) {
  const MeshPiece& piece = mesh.piece;
  std::vector<Index> listed;
  mesh.parts->communicator().together([&] {
    if (arguments.fix_file.empty()) {
      return;
    }
    const auto total = static_cast<Index>(piece.vertices.total);
    for (const Index number : commands::read_vertex_list(arguments.fix_file, total)) {
      const auto own_end = piece.vertex.begin() + piece.own;
      const auto found = std::lower_bound(piece.vertex.begin(), own_end, number);
      if (found != own_end && *found == number) {
        listed.push_back(static_cast<Index>(found - piece.vertex.begin()));
      }
    }
  });
  std::vector<std::uint8_t> mask;
  if (!arguments.mask.empty()) {
    mask = mesh.at_vertices(mesh.source->vertex_mask(arguments.mask));
  }
  auto fixed = commands::held_by(arguments, mesh.topology, listed, mask, weights);
  mesh.parts->refresh(fixed);  // the border of the piece is no boundary of the mesh
  return fixed;
}

void measure_moves(const SharedMesh& mesh, SmoothFigures& figures) {
  const Index own = mesh.piece.own;
  SmoothFigures here;
  commands::measure_moves(mesh.piece.X.topRows(own), mesh.X.topRows(own), here);
  figures.largest_move = mesh.parts->max(here.largest_move);
  const double squares = mesh.parts->sum(here.rms_move * here.rms_move * own);
  figures.rms_move = std::sqrt(squares / static_cast<double>(mesh.piece.vertices.total));
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
  SharedSmooth(const Communicator& comm, SmoothArguments arguments, const CLI::App& app,
               Console& console)
      : comm_(comm), arguments_(std::move(arguments)), console_(console), report_(app) {}

  ExitCode run() {
    if (!comm_.is_first()) {
      console_.set_level(Console::Level::quiet);
    }
    comm_.together([&] {
      require_shareable(arguments_);
      if (comm_.is_first()) {
        check_outputs(arguments_);
        require_writable(arguments_.output);
      }
    });
    Progress progress(console_);
    SharedMesh mesh = read(comm_, arguments_, console_, figures_, progress);
    print_defects(mesh);
    const LinearSolver solver =
        arguments_.flow.solver == "mumps" ? LinearSolver::mumps : LinearSolver::cg;
    arguments_.flow.solver = "auto";
    arguments_.textured = mesh.source->has_texture_coordinates();
    arguments_.flow = flow_options(arguments_, mesh);
    arguments_.flow.make_solver = [&parts = *mesh.parts, solver](const JacobianShape& shape) {
      return std::make_unique<PetscJacobian>(shape, parts, solver);
    };
    figures_.mean_edge_length = mean_edge_length(mesh.X, mesh.topology, *mesh.parts);
    const auto fixed_vertices = fixed(arguments_, mesh, arguments_.flow.cutoff_factor);
    commands::project_directions(arguments_, mesh.X, mesh.topology, fixed_vertices, *mesh.parts,
                                 figures_, progress);
    progress.begin("measure");
    figures_.before = measured(mesh);
    if (arguments_.flow.steps > 0) {
      commands::run_smoothing(arguments_, mesh.X, mesh.topology, fixed_vertices, *mesh.parts,
                              figures_, progress);
    }
    progress.begin("measure");
    figures_.after = measured(mesh);
    measure_moves(mesh, figures_);
    write(mesh, progress);
    return commands::exit_code_of(figures_);
  }

 private:
  static void require_writable(const commands::OutputOptions& output) {
    if (output.path != "-") {
      ibmfair::require_writable(output.path, output.write.overwrite);
    }
  }

  commands::MeshFigures measured(const SharedMesh& mesh) {
    const Stopwatch watch(figures_.seconds_measure);
    return mesh_figures(mesh.piece, mesh.X, mesh.topology, arguments_.flow, *mesh.parts);
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
    const commands::OutputOptions output = figures_.flow.status == FlowStatus::interrupted
                                               ? checkpoint_of(arguments_)
                                               : arguments_.output;
    WriteReport written;
    progress.begin("write");
    {
      const Stopwatch watch(figures_.seconds_write);
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
    print_smoothing(arguments_, figures_, output.path, written,
                    fmt::format(", on {} ranks", comm_.size()), console_, report_);
    deliver_report(arguments_.report, output.write.overwrite, report_);
  }

  const Communicator& comm_;
  SmoothArguments arguments_;
  Console& console_;
  Report report_;
  SmoothFigures figures_;
};

}  // namespace

commands::Runner declare_shared_smooth(CLI::App& app, const Communicator& comm) {
  auto arguments = std::make_shared<SmoothArguments>();
  add_smooth_arguments(app, *arguments);
  return [arguments, &app, &comm](Console& console) {
    if (app["--threads"]->empty()) {
      set_thread_count(1);  // by default each rank uses one core
    }
    return SharedSmooth(comm, *arguments, app, console).run();
  };
}

}  // namespace ibmfair::petsc
