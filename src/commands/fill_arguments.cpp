#include "commands/fill_arguments.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/numeric_options.h"
#include "ibmfair/energy/bending_energy.h"

namespace ibmfair::commands {
namespace {

std::vector<Index> parse_ids(const std::string& text) {
  std::vector<Index> ids;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    ids.push_back(static_cast<Index>(parse_integer_option("--only", text.substr(begin, end - begin),
                                                          0, std::numeric_limits<Index>::max())));
    begin = end + 1;
  }
  return ids;
}

void add_choice_options(CLI::App& app, FillArguments& a) {
  constexpr Index most = std::numeric_limits<Index>::max();
  app.add_flag("--all", a.choice.all,
               "fill outer borders of open sheets, too (left open otherwise)");
  add_parsed_option(app, "--only", "ID,...", "fill only these holes, as `ibmfair holes` lists them",
                    [&a](const std::string& text) { a.choice.only = parse_ids(text); });
  add_integer(app, "--max-edges", a.choice.most_edges, Index{1}, most,
              "leave holes of more edges open");
  add_length(app, "--max-perimeter", a.max_perimeter, Length::Unit::absolute,
             "leave holes of a longer perimeter open: in the mesh's units, or with e in mean edge "
             "lengths, or with % of the bounding box's diagonal");
  add_length(app, "--max-diameter", a.max_diameter, Length::Unit::absolute,
             "the same for the diagonal of a hole's bounding box");
  auto* region =
      app.add_option(
             "--region", a.region,
             "fair a part of the mesh again instead: the inner vertices of an OBJ group, "
             "object or material, the vertices whose PLY property is not zero, or those "
             "listed in a file, counted from 0; @all are all but the two rings of vertices along "
             "open boundaries")
          ->type_name(name_or_file_to_read);
  app.add_option("--tangential", a.tangential,
                 "relax or none: even out the vertices of the region within the surface, which new "
                 "patches always do (default none)")
      ->check(CLI::IsMember({"relax", "none"}))
      ->needs(region);
}

void add_fairing_options(CLI::App& app, FillArguments& a) {
  constexpr Index most = std::numeric_limits<Index>::max();
  app.add_flag("--no-fair", a.no_fair, "triangulate and refine only");
  app.add_flag("--no-refine", a.no_refine, "add no vertices");
  add_integer(app, "--rim-smooth", a.fill.rim_smooth, 0, 1000,
              "let N rings of vertices outside move, too, the rim being the first (default 0)");
  std::vector<std::string> names;
  for (const BendingModel& model : bending_models()) {
    names.emplace_back(model.name);
  }
  app.add_option("--laplacian", a.fill.fairing.laplacian, "member of the family of energies")
      ->check(CLI::IsMember(names))
      ->capture_default_str();
  app.add_flag("--no-mass", a.no_mass, "leave the mass matrix out of the energy");
  add_real(app, "--tolerance", a.fill.fairing.tolerance, positive,
           "normal gradient at which a patch is stationary, relative to its start (default 1e-3)");
  add_integer(app, "--max-steps", a.fill.fairing.most_steps, 1, 1'000'000,
              "steps at each level of refinement before giving up (default 100)");
  add_integer(
      app, "--max-new-vertices", a.fill.most_new_vertices, Index{1}, most,
      "in all holes together (default: as many as the mesh has, at least 100000, and half the "
      "square of its edges in a hole)");
  add_bytes(
      app, "--memory", a.fill.fairing.memory_limit,
      "memory that the program may take, as in 800M or 4G: a patch that needs more is refused "
      "before it is faired (default: what there is)");
  app.add_flag("--allow-intersections", a.allow_intersections,
               "do not fail where a patch passes through itself or the mesh");
}

}  // namespace

void add_fill_arguments(CLI::App& app, FillArguments& a) {
  app.add_option("IN", a.input, "mesh file to read; - is standard input")->required();
  add_output_options(app, a.output);
  add_choice_options(app, a);
  add_fairing_options(app, a);
  add_input_options(app, a.reading);
  app.add_flag("--strict", a.strict,
               "write nothing unless everything was achieved; fail (exit code 4) where the mesh "
               "has defects");
  add_report_options(app, a.report);
  add_picture_options(app, "the mesh before and after", a.picture);
  add_overwrite_option(app, a.output.write.overwrite);
}

}  // namespace ibmfair::commands
