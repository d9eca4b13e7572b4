#include "commands/fill_arguments.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "commands/argument_roles.h"
#include "commands/documentation.h"
#include "commands/numeric_options.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {
namespace {

std::vector<Index> parse_ids(const std::string& option, const std::string& text) {
  std::vector<Index> ids;
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    ids.push_back(static_cast<Index>(parse_integer_option(option, text.substr(begin, end - begin),
                                                          0, std::numeric_limits<Index>::max())));
    begin = end + 1;
  }
  return ids;
}

std::array<Index, 2> parse_pair(const std::string& text) {
  const std::vector<Index> ids = parse_ids("--bridge", text);
  if (ids.size() != 2) {
    throw BadOption(fmt::format(
        "--bridge: '{}' is not a pair of ids such as 0,3; `ibmfair holes` lists the ids", text));
  }
  return {ids[0], ids[1]};
}

void add_bridge_option(CLI::App& app, FillArguments& a) {
  CLI::Option* bridge =
      app.add_option_function<std::vector<std::string>>(
             "--bridge",
             [&a](const std::vector<std::string>& pairs) {
               for (const std::string& pair : pairs) {
                 a.choice.bridges.push_back(parse_pair(pair));
               }
             },
             "join these two holes by a tube that continues the mesh at both ends, instead of "
             "filling them: two pieces become one, or one piece gets a handle. All other holes are "
             "filled as usual; --only A,B leaves them open. Where the tube does not converge, as "
             "on long thin tubes, --continuity 1 makes one. Can be given several times")
          ->type_name("A,B")
          ->allow_extra_args(false);
  note_of(app, *bridge).unit = "ids that `ibmfair holes` lists";
}

void add_choice_options(CLI::App& app, FillArguments& a) {
  constexpr Index most = std::numeric_limits<Index>::max();
  begin_group(app, "Which holes");
  app.add_flag("--all", a.choice.all,
               "also fill the outer borders of open sheets: boundary loops that span more than 60 "
               "% of the area of their component");
  CLI::Option* only = add_parsed_option(
      app, "--only", "ID,...", "fill only these holes",
      [&a](const std::string& text) { a.choice.only = parse_ids("--only", text); });
  note_of(app, *only).unit = "ids that `ibmfair holes` lists";
  note_of(app, *only).default_text = "all but outer borders";
  CLI::Option* stitch = add_optional_length(
      app, "--stitch", Length::Unit::absolute,
      "close cracks first, without new vertices: split edges at vertices that lie on them "
      "(T-junctions), and merge vertices of edges that lie on each other. The two sides of a crack "
      "may be LENGTH apart, but at most 0.3 of the shortest boundary edge at a vertex. The ids of "
      "--only are then those of the stitched mesh",
      [&a](std::optional<Length> reach) {
        a.stitch = true;
        a.stitch_reach = reach;
      });
  note_of(app, *stitch).default_text =
      "no cracks are closed; with --stitch alone, a thousandth of the shortest boundary edge at a "
      "vertex";
  add_bridge_option(app, a);
  CLI::Option* edges = add_integer(app, "--max-edges", a.choice.most_edges, Index{1}, most,
                                   "leave holes open that have more edges than this");
  CLI::Option* perimeter =
      add_length(app, "--max-perimeter", a.max_perimeter, Length::Unit::absolute,
                 "leave holes open whose boundary is longer than this");
  CLI::Option* diameter =
      add_length(app, "--max-diameter", a.max_diameter, Length::Unit::absolute,
                 "leave holes open whose bounding box has a longer diagonal than this");
  note_of(app, *edges).unit = "edges";
  for (const CLI::Option* limit : {edges, perimeter, diameter}) {
    note_of(app, *limit).default_text = "no limit";
  }
}

void add_region_options(CLI::App& app, FillArguments& a) {
  begin_group(app, "A region instead of holes");
  CLI::Option* region =
      app.add_option("--region", a.region,
                     "fair a part of the mesh instead of holes: the inner vertices of an OBJ "
                     "group, object or material, the vertices whose PLY property is not zero, or "
                     "the vertices whose numbers, counted from 0, are listed in a text file; @all "
                     "is the whole mesh without the two rings of vertices along open boundaries")
          ->type_name(name_or_file_to_read)
          ->excludes(app.get_option("--stitch"));
  note_of(app, *region).offers = {"@all"};
  CLI::Option* tangential =
      app.add_option("--tangential", a.tangential,
                     "tangential relaxation: move the vertices of the region within the surface so "
                     "that triangles become even (relax); new patches are always relaxed")
          ->check(CLI::IsMember({"relax", "none"}))
          ->needs(region);
  note_of(app, *tangential).default_text = "none";  // no value: it needs --region
}

/// These options steer the flow that makes patches with --continuity 2.
constexpr std::array flow_options{"--laplacian", "--mass",       "--no-mass",   "--tolerance",
                                  "--max-steps", "--rim-smooth", "--keep-sharp"};

/// Throws BadOption for the first of these options that has another value than its default.
void refuse_flow_options(const FillArguments& a) {
  const FillOptions defaults;
  const std::array<bool, flow_options.size()> changed{
      a.laplacian_is_given(),
      !a.mass.name.empty(),
      a.mass.without,
      a.fill.fairing.tolerance != defaults.fairing.tolerance,
      a.fill.fairing.most_steps != defaults.fairing.most_steps,
      a.fill.rim_smooth != defaults.rim_smooth,
      a.keep_sharp || a.fill.choose_sharp_angle};
  for (std::size_t i = 0; i < changed.size(); ++i) {
    if (changed[i]) {
      throw BadOption(
          fmt::format("fill: {} cannot be combined with --continuity {}; it applies to 2 only",
                      flow_options[i], a.continuity));
    }
  }
}

void add_continuity_option(CLI::App& app, FillArguments& a) {
  app.add_option("--continuity", a.continuity,
                 "what the patches continue at their rims. 2: the curvature of the mesh; the patch "
                 "in a sphere is a part of the sphere. 1: only the tangent directions of the mesh, "
                 "by linear fairing; there is no crease between patch and mesh. 0: only the "
                 "positions of the rim; the patch has the least area, like a soap film, and is a "
                 "flat lid on a flat rim. " +
                     fmt::format("{} apply to 2 only", fmt::join(flow_options, ", ")))
      ->check(CLI::IsMember({"0", "1", "2"}))
      ->capture_default_str()
      ->excludes("--no-fair")
      ->excludes("--region");
}

void add_patch_options(CLI::App& app, FillArguments& a) {
  constexpr Index most = std::numeric_limits<Index>::max();
  begin_group(app, "Patches");
  CLI::Option* rings = add_parsed_option(
      app, "--rim-smooth", "N|auto",
      "also move N rings of vertices around each hole, beginning with its rim; for ragged rims "
      "only. auto moves none; where the mesh around a hole is noisy, the patch takes smoothed "
      "directions, unless --laplacian is given",
      [&a](const std::string& text) {
        a.fill.rim_smooth = text == "auto" ? 0 : static_cast<int>(or_other("auto", [&] {
          return parse_integer_option("--rim-smooth", text, 0, 1000);
        }));
      });
  note_of(app, *rings).unit = "rings";
  note_of(app, *rings).default_text = "auto";
  note_of(app, *rings).offers = {"auto"};
  app.add_flag("--no-fair", a.no_fair,
               "triangulate and refine the holes, but do not fair the patches");
  CLI::Option* unrefined =
      app.add_flag("--no-refine", a.no_refine, "add no vertices inside the holes");
  CLI::Option* edge_length =
      add_length(app, "--edge-length", a.edge_length, Length::Unit::absolute,
                 "edge length of the triangles inside the patches; it changes gradually from the "
                 "edge length along the rim to this one")
          ->excludes(unrefined)
          ->excludes("--region");
  note_of(app, *edge_length).default_text = "the edge length along the rim";
  add_continuity_option(app, a);
  CLI::Option* sharp = add_parsed_option(
      app, "--keep-sharp", "ANGLE|auto",
      "continue sharp edges that end at a hole through the patch: edges at which the surface turns "
      "by more than this angle; auto takes the angle from the mesh",
      [&a](const std::string& text) {
        a.fill.choose_sharp_angle = text == "auto";
        a.keep_sharp.reset();
        if (text != "auto") {
          a.keep_sharp = or_other(
              "auto", [&] { return parse_real_option("--keep-sharp", text, turning_angle); });
        }
      });
  sharp->excludes(rings)->excludes(unrefined);
  note_of(app, *sharp).unit = "degrees";
  note_of(app, *sharp).default_text = "none";
  note_of(app, *sharp).offers = {"auto"};
  CLI::Option* vertices = add_integer(app, "--max-new-vertices", a.fill.most_new_vertices, Index{1},
                                      most, "most vertices to add, in all holes together");
  note_of(app, *vertices).unit = "vertices";
  note_of(app, *vertices).default_text =
      "as many as the mesh has and at least 100000; in each hole half the square of its number of "
      "edges";
  app.add_flag("--allow-intersections", a.allow_intersections,
               "do not fail if a patch intersects itself or the mesh");
}

void add_fairing_options(CLI::App& app, FillArguments& a) {
  begin_group(app, groups::energy_and_flow);
  CLI::Option* laplacian =
      add_laplacian_option(app, a.fill.fairing.laplacian,
                           "discrete Laplacian of the bending energy (see the list below)");
  laplacian->default_str("");  // no value: without the option, the surroundings decide
  note_of(app, *laplacian).default_text =
      "for a hole, crouzeix-raviart where the mesh around it is very rough by shape, and "
      "intrinsic-delaunay elsewhere; lagrange for a region and with --mass";
  a.laplacian_is_given = [laplacian] { return laplacian->count() > 0; };
  add_mass_options(app, a.mass);
  CLI::Option* tolerance =
      add_real(app, "--tolerance", a.fill.fairing.tolerance, positive,
               "normal part of the gradient at which a patch counts as stationary");
  note_of(app, *tolerance).unit = "relative to its initial value";
  CLI::Option* steps = add_integer(app, "--max-steps", a.fill.fairing.most_steps, 1, 1'000'000,
                                   "most time steps at each level of refinement");
  note_of(app, *steps).unit = "steps";
  begin_group(app, groups::solver_and_memory);
  CLI::Option* memory = add_bytes(app, "--memory", a.fill.fairing.memory_limit,
                                  "memory that the program may use, for example 800M or 4G: a "
                                  "patch that needs more is not faired, and the run fails");
  note_of(app, *memory).default_text = "the memory that is available";
}

}  // namespace

Continuity continuity_of(const FillArguments& a) {
  return a.continuity == "0"   ? Continuity::positions
         : a.continuity == "1" ? Continuity::tangents
                               : Continuity::curvature;
}

/// Throws BadOption for the first option about holes and patches that is given beside --region.
void refuse_hole_options(const FillArguments& a) {
  const FillOptions defaults;
  const HoleChoice all_holes;
  const std::array<std::pair<const char*, bool>, 11> given{
      {{"--bridge", !a.choice.bridges.empty()},
       {"--all", a.choice.all},
       {"--only", !a.choice.only.empty()},
       {"--max-edges", a.choice.most_edges != all_holes.most_edges},
       {"--max-perimeter", a.max_perimeter.has_value()},
       {"--max-diameter", a.max_diameter.has_value()},
       {"--rim-smooth", a.fill.rim_smooth != defaults.rim_smooth},
       {"--no-fair", a.no_fair},
       {"--no-refine", a.no_refine},
       {"--keep-sharp", a.keep_sharp || a.fill.choose_sharp_angle},
       {"--max-new-vertices", a.fill.most_new_vertices != defaults.most_new_vertices}}};
  for (const auto& [name, is_given] : given) {
    if (is_given) {
      throw BadOption(
          fmt::format("fill: {} is about holes and cannot be combined with --region", name));
    }
  }
}

void check_fill_arguments(const FillArguments& a) {
  if (!a.region.empty()) {
    refuse_hole_options(a);
  }
  if (a.keep_sharp && !(*a.keep_sharp < 180)) {
    throw BadOption("fill: --keep-sharp must be above 0 and below 180 degrees");
  }
  if (continuity_of(a) != Continuity::curvature) {
    refuse_flow_options(a);
  }
}

void add_fill_arguments(CLI::App& app, FillArguments& a) {
  add_input_argument(app, a.input);
  add_output_options(app, a.output);
  add_choice_options(app, a);
  add_region_options(app, a);
  add_patch_options(app, a);
  add_fairing_options(app, a);
  add_input_options(app, a.reading);
  app.add_flag("--strict", a.strict,
               "write nothing unless every hole was filled well; fail with exit code 4 if the mesh "
               "has defects");
  add_overwrite_option(app, a.output.write.overwrite);
  add_report_options(app, a.report);
  add_picture_options(app, "the mesh before and after, seen straight onto the largest patch,",
                      a.picture);
  documentation_of(app).examples = {
      {"ibmfair fill scan.ply closed.ply", "closes all holes except outer borders"},
      {"ibmfair fill scan.ply closed.ply --stitch",
       "closes cracks by splitting edges and merging vertices, and then fills the holes"},
      {"ibmfair fill part.obj fair.obj --region blend",
       "fairs the inside of the group `blend`, with the triangles that it has"},
  };
}

}  // namespace ibmfair::commands
