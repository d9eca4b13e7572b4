#include "commands/fill_arguments.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <CLI/CLI.hpp>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"

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
  begin_group(app, "Which holes");
  app.add_flag("--all", a.choice.all,
               "fill outer borders of open sheets, too: loops that span more than 60 % of their "
               "component's area, which are left open otherwise");
  CLI::Option* only =
      add_parsed_option(app, "--only", "ID,...", "fill only these holes",
                        [&a](const std::string& text) { a.choice.only = parse_ids(text); });
  note_of(app, *only).unit = "numbers as `ibmfair holes` lists them";
  note_of(app, *only).default_text = "all but outer borders";
  CLI::Option* edges = add_integer(app, "--max-edges", a.choice.most_edges, Index{1}, most,
                                   "leave holes of more edges open");
  CLI::Option* perimeter = add_length(app, "--max-perimeter", a.max_perimeter,
                                      Length::Unit::absolute, "leave longer holes open");
  CLI::Option* diameter = add_length(app, "--max-diameter", a.max_diameter, Length::Unit::absolute,
                                     "leave holes open whose bounding box has a longer diagonal");
  note_of(app, *edges).unit = "edges";
  for (const CLI::Option* limit : {edges, perimeter, diameter}) {
    note_of(app, *limit).default_text = "no limit";
  }
}

void add_region_options(CLI::App& app, FillArguments& a) {
  begin_group(app, "A region instead of holes");
  CLI::Option* region =
      app.add_option(
             "--region", a.region,
             "fair a part of the mesh again instead: the inner vertices of an OBJ group, "
             "object or material, the vertices whose PLY property is not zero, or those "
             "listed in a file, counted from 0; @all are all but the two rings of vertices along "
             "open boundaries")
          ->type_name(name_or_file_to_read);
  note_of(app, *region).offers = {"@all"};
  CLI::Option* tangential =
      app.add_option("--tangential", a.tangential,
                     "even out the vertices of the region within the surface (relax), which new "
                     "patches always do")
          ->check(CLI::IsMember({"relax", "none"}))
          ->needs(region);
  note_of(app, *tangential).default_text = "none";  // no value: a job without a region has none
}

void add_patch_options(CLI::App& app, FillArguments& a) {
  constexpr Index most = std::numeric_limits<Index>::max();
  begin_group(app, "Patches");
  CLI::Option* rings =
      add_integer(app, "--rim-smooth", a.fill.rim_smooth, 0, 1000,
                  "let this many rings of vertices outside move, too, the rim being the first: a "
                  "ragged rim spoils any patch");
  note_of(app, *rings).unit = "rings";
  app.add_flag("--no-fair", a.no_fair, "triangulate and refine only");
  app.add_flag("--no-refine", a.no_refine, "add no vertices");
  CLI::Option* vertices = add_integer(app, "--max-new-vertices", a.fill.most_new_vertices, Index{1},
                                      most, "in all holes together");
  note_of(app, *vertices).unit = "vertices";
  note_of(app, *vertices).default_text =
      "as many as the mesh has, at least 100000, and half the square of its edges in a hole";
  app.add_flag("--allow-intersections", a.allow_intersections,
               "do not fail where a patch passes through itself or the mesh");
}

void add_fairing_options(CLI::App& app, FillArguments& a) {
  begin_group(app, groups::energy_and_flow);
  add_laplacian_option(app, a.fill.fairing.laplacian, "member of the family of energies");
  add_mass_options(app, a.mass);
  CLI::Option* tolerance = add_real(app, "--tolerance", a.fill.fairing.tolerance, positive,
                                    "normal gradient at which a patch counts as stationary");
  note_of(app, *tolerance).unit = "times its value at the start";
  CLI::Option* steps = add_integer(app, "--max-steps", a.fill.fairing.most_steps, 1, 1'000'000,
                                   "at each level of refinement before giving up");
  note_of(app, *steps).unit = "steps";
  begin_group(app, groups::solver_and_memory);
  CLI::Option* memory =
      add_bytes(app, "--memory", a.fill.fairing.memory_limit,
                "memory that the program may take, as in 800M or 4G: a patch that needs more is "
                "refused before it is faired");
  note_of(app, *memory).default_text = "what there is";
}

}  // namespace

void add_fill_arguments(CLI::App& app, FillArguments& a) {
  add_input_argument(app, a.input);
  add_output_options(app, a.output);
  add_choice_options(app, a);
  add_region_options(app, a);
  add_patch_options(app, a);
  add_fairing_options(app, a);
  add_input_options(app, a.reading);
  app.add_flag("--strict", a.strict,
               "write nothing unless everything was achieved; fail (exit code 4) where the mesh "
               "has defects");
  add_overwrite_option(app, a.output.write.overwrite);
  add_report_options(app, a.report);
  add_picture_options(app, "the mesh before and after", a.picture);
  documentation_of(app).examples = {
      {"ibmfair fill scan.ply closed.ply --rim-smooth 2",
       "closes all holes but outer borders, and evens out their ragged rims"},
      {"ibmfair fill part.obj fair.obj --region blend",
       "fairs the inside of the group `blend` again, on its own triangles"},
  };
}

}  // namespace ibmfair::commands
