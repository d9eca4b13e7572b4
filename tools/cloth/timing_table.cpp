#include "cloth/timing_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "cloth/model_timer.h"
#include "cloth/published_timings.h"
#include "cloth/sheet_meshes.h"
#include "ibmfair/base/threads.h"

namespace ibmfair::cloth {
namespace {

/// In the order of timed_quantities.
constexpr std::array works{&ModelTimer::gradient, &ModelTimer::hessian, &ModelTimer::explicit_step,
                           &ModelTimer::implicit_step, &ModelTimer::factor_and_solve};
static_assert(works.size() == timed_quantities.size());

constexpr int batches = 5;
constexpr double batch_seconds = 0.1;

/// Rows of bending_forces().
enum Model : std::size_t { hinge, ibm };

using Values = std::vector<double>;  // one for each column of the table

/// Mean milliseconds of processor time of one call, over at least `seconds`. Processor time hardly
/// depends on other work of the machine.
template <class Work>
double milliseconds(double seconds, const Work& work) {
  const std::clock_t start = std::clock();
  double spent = 0;
  int calls = 0;
  while (spent < seconds || calls == 0) {
    work();
    ++calls;
    spent = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  return 1000 * spent / calls;
}

double median(Values values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

void print_values(std::string_view label, const Values& values, int digits) {
  fmt::print("    {:<14}", label);
  for (const double value : values) {
    fmt::print("{:>9.{}f}", value, digits);
  }
  fmt::print("\n");
}

/// The columns of Figure 7 that are measured.
std::vector<std::size_t> chosen_columns(bool quick) {
  return quick ? std::vector<std::size_t>{0, 1, 4, 5}
               : std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6, 7};
}

/// Ratios of hinge to IBM, for the medians at the end.
struct Ratios {
  Values here, paper;
};

/// Prints one quantity of one scene; `costs` has a row for each column.
void print_quantity(std::size_t quantity, const std::vector<std::vector<Costs>>& costs,
                    Ratios& ratios) {
  Values of_hinge, of_ibm, ratio;
  for (const std::vector<Costs>& cost : costs) {
    of_hinge.push_back(cost[hinge][quantity]);
    of_ibm.push_back(cost[ibm][quantity]);
    ratio.push_back(of_hinge.back() / of_ibm.back());
  }
  fmt::print("  {}, ms\n", timed_quantities[quantity]);
  print_values("hinge", of_hinge, 3);
  print_values("ibm", of_ibm, 3);
  print_values("ratio", ratio, 2);
  ratios.here.insert(ratios.here.end(), ratio.begin(), ratio.end());
}

void print_published(const PublishedTimings& timings, const std::vector<std::size_t>& columns,
                     Ratios& ratios) {
  Values ratio;
  for (const std::size_t column : columns) {
    ratio.push_back(timings.hinge[column] / timings.ibm[column]);
  }
  print_values("in the paper", ratio, 2);
  ratios.paper.insert(ratios.paper.end(), ratio.begin(), ratio.end());
}

/// The row of costs for each column; prints the columns' heads on the way.
std::vector<std::vector<Costs>> measure_scene(const SceneRow& row,
                                              const std::vector<std::size_t>& columns) {
  fmt::print("{}, regular and irregular meshes\n    {:<14}", row.name, "vertices");
  std::vector<std::vector<Costs>> costs;
  for (const std::size_t column : columns) {
    const Index vertices = published_resolutions[column];
    fmt::print("{:>9}", vertices);
    std::fflush(stdout);
    costs.push_back(measure_costs(row, sheet_meshes()[column / 4].make(vertices), batch_seconds));
  }
  fmt::print("\n");
  return costs;
}

}  // namespace

std::vector<Costs> measure_costs(const SceneRow& row, const TriangleMesh& sheet, double seconds) {
  std::vector<std::unique_ptr<ModelTimer>> timers;
  for (const BendingForce& bending : bending_forces()) {
    timers.push_back(std::make_unique<ModelTimer>(row, sheet, bending));
  }
  Costs unknown;
  unknown.fill(INFINITY);
  std::vector<Costs> costs(timers.size(), unknown);
  for (std::size_t quantity = 0; quantity < works.size(); ++quantity) {
    for (int batch = 0; batch < batches; ++batch) {
      for (std::size_t model = 0; model < timers.size(); ++model) {
        ModelTimer& timer = *timers[model];
        const double cost = milliseconds(seconds, [&] { (timer.*works[quantity])(); });
        costs[model][quantity] = std::min(costs[model][quantity], cost);
      }
    }
  }
  return costs;
}

void print_timing_table(bool quick) {
  set_thread_count(1);
  const std::vector<std::size_t> columns = chosen_columns(quick);
  std::array<Ratios, timed_quantities.size()> ratios;
  for (std::size_t s = 0; s < scenes().size(); ++s) {
    const auto costs = measure_scene(scenes()[s], columns);
    for (std::size_t quantity = 0; quantity < timed_quantities.size(); ++quantity) {
      print_quantity(quantity, costs, ratios[quantity]);
      if (quantity < published_timings[s].size()) {
        print_published(published_timings[s][quantity], columns, ratios[quantity]);
      }
    }
  }
  fmt::print("median of the ratios\n    {:<14}{:>9}{:>9}\n", "", "here", "paper");
  for (std::size_t quantity = 0; quantity < timed_quantities.size(); ++quantity) {
    const Ratios& ratio = ratios[quantity];
    fmt::print("    {:<14}{:>9.2f}", timed_quantities[quantity], median(ratio.here));
    fmt::print("{}\n", ratio.paper.empty() ? "" : fmt::format("{:>9.2f}", median(ratio.paper)));
  }
}

}  // namespace ibmfair::cloth
