#include "cloth/timing_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "cloth/sheet_meshes.h"
#include "ibmfair/base/stopwatch.h"
#include "ibmfair/base/threads.h"

namespace ibmfair::cloth {
namespace {

using Row = std::array<double, 8>;  // four resolutions, regular and irregular

struct Quantity {
  std::string_view name;
  double Costs::*cost;
};

constexpr std::array quantities{Quantity{"gradient", &Costs::gradient},
                                Quantity{"Hessian", &Costs::hessian},
                                Quantity{"explicit step", &Costs::explicit_step},
                                Quantity{"implicit step", &Costs::implicit_step}};

constexpr std::array<Index, 8> resolutions{400, 1600, 6400, 25600, 450, 2100, 6500, 22500};

/// Figure 7, milliseconds on a Pentium D at 3.4 GHz: for each quantity hinge and IBM.
constexpr std::array<std::array<std::array<Row, 2>, 4>, 2> paper{
    {{{{{{0.937, 3.45, 16.4, 66.6, 1.10, 5.43, 17.6, 67.8},
         {0.081, 0.338, 2.19, 9.15, 0.098, 0.494, 2.32, 9.68}}},
       {{{12.8, 54.2, 218, 890, 15.2, 77.2, 246, 888},
         {0.237, 0.963, 3.87, 15.7, 0.266, 1.28, 3.99, 13.6}}},
       {{{3.81, 6.64, 27.5, 112, 2.16, 9.53, 31.4, 140},
         {2.63, 2.90, 11.9, 48.8, 0.964, 4.35, 15.2, 76.5}}},
       {{{28.6, 138, 470, 1730, 33.9, 219, 557, 1880},
         {11.0, 62.7, 168, 505, 13.6, 103, 219, 612}}}}},
     {{{{{0.975, 3.99, 16.0, 64.0, 1.10, 5.43, 17.8, 68.7},
         {0.085, 0.341, 2.14, 8.75, 0.099, 0.490, 2.31, 9.28}}},
       {{{13.4, 54.8, 212, 849, 15.2, 77.4, 247, 887},
         {0.251, 0.974, 3.79, 14.99, 0.267, 1.30, 3.96, 13.7}}},
       {{{1.73, 7.05, 27.7, 112, 1.97, 9.80, 32.7, 134},
         {0.780, 3.26, 13.3, 53.4, 0.900, 4.54, 16.1, 70.0}}},
       {{{27.6, 106, 420, 1680, 33.5, 155, 513, 1880},
         {9.53, 32.9, 127, 490, 12.5, 50.4, 166, 608}}}}}}};

constexpr double seconds_of_batch = 0.2;

/// Milliseconds of one call: the shortest mean over `batches` of at least `seconds` each.
template <class Work>
double milliseconds(int batches, double seconds, const Work& work) {
  double shortest = INFINITY;
  for (int batch = 0; batch < batches; ++batch) {
    double spent = 0;
    int calls = 0;
    for (; spent < seconds || calls == 0; ++calls) {
      const Stopwatch watch(spent);
      work();
    }
    shortest = std::min(shortest, 1000 * spent / calls);
  }
  return shortest;
}

/// A state in which nothing is flat: waves across the sheet.
Points waves(const Scene& scene) {
  const Points normals = scene.start;
  const Vec3 across = scene.surroundings.sphere ? Vec3(0, 1, 0) : Vec3(0, 0, 1);
  const Eigen::ArrayXd phase = 20 * (normals.rowwise().sum()).array();
  return normals + 0.01 * phase.sin().matrix() * across.transpose();
}

std::unique_ptr<Integrator> bind(std::string_view name, const SceneRow& row, const Scene& scene,
                                 const BendingForce& bending) {
  StepOptions options;
  options.newton_iterations = 1;
  options.time_step = name == "implicit" ? row.time_step : 0;
  return integrator(name).bind(scene.plate, scene.surroundings, bending, options);
}

double milliseconds_of_steps(std::string_view name, const SceneRow& row, const Scene& scene,
                             const BendingForce& bending, double seconds) {
  const auto stepper = bind(name, row, scene, bending);
  Motion motion = at_rest(scene.start);
  stepper->step(motion);  // analyses the pattern
  return milliseconds(3, seconds, [&] { stepper->step(motion); });
}

void print_row(std::string_view label, const std::vector<double>& values, int digits) {
  fmt::print("    {:<14}", label);
  for (const double value : values) {
    fmt::print("{:>9.{}f}", value, digits);
  }
  fmt::print("\n");
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The columns of Figure 7 that are measured.
std::vector<std::size_t> columns(bool quick) {
  return quick ? std::vector<std::size_t>{0, 1, 4, 5}
               : std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7};
}

std::vector<double> ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> quotients;
  for (std::size_t i = 0; i < a.size(); ++i) {
    quotients.push_back(a[i] / b[i]);
  }
  return quotients;
}

/// Prints one quantity of one scene; returns the ratios here and in the paper.
std::array<std::vector<double>, 2> print_quantity(const Quantity& quantity,
                                                  const std::array<std::vector<Costs>, 2>& costs,
                                                  const std::array<Row, 2>& published,
                                                  const std::vector<std::size_t>& chosen) {
  fmt::print("  {}, ms\n", quantity.name);
  std::array<std::vector<double>, 2> ours, theirs;
  for (std::size_t model = 0; model < 2; ++model) {
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      ours[model].push_back(costs[model][i].*quantity.cost);
      theirs[model].push_back(published[model][chosen[i]]);
    }
    print_row(bending_forces()[model].name, ours[model], 3);
  }
  std::array ratios{ratio(ours[0], ours[1]), ratio(theirs[0], theirs[1])};
  print_row("ratio", ratios[0], 2);
  print_row("in the paper", ratios[1], 2);
  return ratios;
}

}  // namespace

Costs measure_costs(const SceneRow& row, const TriangleMesh& sheet, const BendingForce& bending,
                    double seconds) {
  Scene scene = row.build(sheet);
  scene.start = waves(scene);
  const Points& X = scene.start;
  ElasticSheet elastic(scene.plate, bending);
  Points G = Points::Zero(X.rows(), 3);
  Costs costs;
  costs.gradient = milliseconds(5, seconds / 4, [&] { elastic.bending->add_gradient(X, G); });
  costs.hessian = milliseconds(
      5, 0.05, [&] { elastic.bending->add_hessian(X, HessianPart::exact, elastic.hessian); });
  costs.explicit_step = milliseconds_of_steps("explicit", row, scene, bending, seconds / 2);
  costs.implicit_step = milliseconds_of_steps("implicit", row, scene, bending, seconds);
  return costs;
}

void print_timing_table(bool quick) {
  set_thread_count(1);
  const std::vector<std::size_t> chosen = columns(quick);
  std::array<std::array<std::vector<double>, 2>, quantities.size()> all;
  for (std::size_t s = 0; s < scenes().size(); ++s) {
    fmt::print("{}: {} and {} meshes\n    {:<14}", scenes()[s].name, sheet_meshes()[0].name,
               sheet_meshes()[1].name, "vertices");
    std::array<std::vector<Costs>, 2> costs;
    for (const std::size_t column : chosen) {
      fmt::print("{:>9}", resolutions[column]);
      std::fflush(stdout);
      const TriangleMesh sheet = sheet_meshes()[column / 4].make(resolutions[column]);
      for (std::size_t model = 0; model < 2; ++model) {
        costs[model].push_back(
            measure_costs(scenes()[s], sheet, bending_forces()[model], seconds_of_batch));
      }
    }
    fmt::print("\n");
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      const auto ratios = print_quantity(quantities[q], costs, paper[s][q], chosen);
      for (std::size_t i = 0; i < 2; ++i) {
        all[q][i].insert(all[q][i].end(), ratios[i].begin(), ratios[i].end());
      }
    }
  }
  fmt::print("median of the ratios hinge / ibm\n    {:<14}{:>9}{:>9}\n", "", "here", "paper");
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    fmt::print("    {:<14}{:>9.2f}{:>9.2f}\n", quantities[q].name, median(all[q][0]),
               median(all[q][1]));
  }
}

}  // namespace ibmfair::cloth
