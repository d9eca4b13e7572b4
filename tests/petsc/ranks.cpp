#include "petsc/ranks.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "ibmfair/io/mesh_file.h"
#include "ibmfair/mesh/geometry.h"
#include "support/files.h"

namespace ibmfair::test {

Points Fair::X() const {
  TemporaryDirectory directory;
  write_bytes(directory / "out.ply", bytes);
  return read_mesh(directory / "out.ply").mesh().X;
}

std::string RanksTest::file_of(const Mesh& mesh, const std::string& name) const {
  write_mesh(mesh, files_ / name, {.overwrite = true});
  return files_ / name;
}

Fair RanksTest::collect(RunResult run, const std::string& output) const {
  Fair fair{std::move(run), {}, nlohmann::json::parse("{}")};
  if (std::filesystem::exists(files_ / output)) {
    fair.bytes = read_bytes(files_ / output);
  } else {
    ADD_FAILURE() << "exit code " << fair.run.exit_code << " and no " << output << ": "
                  << fair.run.err;
  }
  if (fair.run.out.starts_with('{')) {
    fair.report = nlohmann::json::parse(fair.run.out);
  }
  return fair;
}

Words RanksTest::mpi_environment() const {
  return {"OMPI_ALLOW_RUN_AS_ROOT=1",
          "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
          "OMPI_MCA_rmaps_base_oversubscribe=1",
          "OMPI_MCA_hwloc_base_binding_policy=none",
          "OMPI_MCA_mpi_yield_when_idle=1",
          "TMPDIR=" + sessions_.path().string()};
}

Fair RanksTest::on_one(const std::string& input, const Words& options,
                       const std::string& output) const {
  std::filesystem::remove(files_ / output);  // the file that is there afterwards is from this run
  return collect(run_program(Words{"smooth", input, files_ / output, "--overwrite", "--json",
                                   "--solver", "multifrontal", "--solver-tolerance", "1e-12"} +
                             options),
                 output);
}

Fair RanksTest::on_ranks(int count, const std::string& input, const Words& options,
                         const Words& petsc, const std::string& output) const {
  std::filesystem::remove(files_ / output);
  return collect(
      run_on_ranks(count, Words{"smooth", input, files_ / output, "--overwrite", "--json",
                                "--engine", "petsc", "--solver-tolerance", "1e-12"} +
                              options + petsc),
      output);
}

RunResult RanksTest::run_on_ranks(int count, const Words& arguments, RunOptions options) const {
  options.launcher = options.launcher + Words{IBMFAIR_MPIRUN, "-n", std::to_string(count)};
  options.environment = options.environment + mpi_environment();
  return run_program(arguments, options);
}

double relative_difference(const Points& X, const Points& Y) {
  return (X - Y).cwiseAbs().maxCoeff() / bounding_box_size(X).norm();
}

}  // namespace ibmfair::test
