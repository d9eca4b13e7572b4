#include "commands/batch/summary.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/exit_code.h"
#include "commands/printable.h"
#include "commands/report/report_formats.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr std::array all_statuses{Status::ok, Status::failed, Status::skipped, Status::interrupted,
                                  Status::not_run};
constexpr std::size_t most_lines = 20;

struct Total {
  std::size_t items = 0;
  double seconds = 0;
};

Total total_of(const std::vector<Outcome>& outcomes, Status status) {
  Total total;
  for (const Outcome& outcome : outcomes) {
    if (outcome.status == status) {
      ++total.items;
      total.seconds += outcome.seconds;
    }
  }
  return total;
}

bool is_done(const Outcome& outcome) {
  return outcome.status == Status::ok || outcome.status == Status::skipped;
}

/// The columns that every item has, in JSON and in the table.
ordered_json item_json(const Item& item, const Outcome& outcome) {
  return {{"command", item.command},
          {"input", item.input},
          {"output", item.output},
          {"status", name_of(outcome.status)},
          {"exit_code", outcome.exit_code},
          {"seconds", outcome.seconds},
          {"peak_megabytes", outcome.peak_megabytes},
          {"message", outcome.message}};
}

/// Adds the figures to a row; a figure with the name of a common column gets the prefix `report.`.
void add_figures(const ordered_json& figures, ordered_json& row) {
  static const ordered_json columns = item_json({}, {});
  for (const auto& [name, value] : figures.items()) {
    row[columns.contains(name) ? "report." + name : name] = value;
  }
}

/// Whether the item has run far enough to write its reports.
bool has_reports(const Outcome& outcome) {
  return is_done(outcome) || (outcome.status == Status::failed &&
                              outcome.exit_code == static_cast<int>(ExitCode::not_reached));
}

/// The path of the HTML page that the item has written; empty if there is none.
std::string page_of(const Item& item, const Outcome& outcome) {
  const auto page = std::find_if(item.writes.begin(), item.writes.end(), is_page);
  return page != item.writes.end() && has_reports(outcome) ? *page : std::string();
}

}  // namespace

const char* name_of(Status status) {
  static constexpr std::array names{"ok", "failed", "skipped", "interrupted", "not run"};
  return names[static_cast<std::size_t>(status)];
}

std::string status_line(const Item& item, const Outcome& outcome, std::size_t total) {
  std::string line = fmt::format("[{}/{}] {:<7} {:7.2f} s  {}", item.number, total,
                                 name_of(outcome.status), outcome.seconds, item.label());
  if (outcome.status == Status::failed) {
    line += fmt::format(" (exit code {})", outcome.exit_code);
  }
  return outcome.message.empty() ? line : line + ": " + outcome.message;
}

std::string summary_line(const std::vector<Outcome>& outcomes, double seconds) {
  return fmt::format("{} of {} done in {:.2f} s",
                     std::count_if(outcomes.begin(), outcomes.end(), is_done), outcomes.size(),
                     seconds);
}

std::string summary_table(const std::vector<Item>& items, const std::vector<Outcome>& outcomes) {
  std::string text = fmt::format("  {:<12}{:>8}{:>12}\n", "", "items", "seconds");
  for (const Status status : all_statuses) {
    if (const Total total = total_of(outcomes, status); total.items > 0) {
      text += fmt::format("  {:<12}{:>8}{:>12.2f}\n", name_of(status), total.items, total.seconds);
    }
  }
  std::size_t lines = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!is_done(outcomes[i]) && outcomes[i].status != Status::not_run && ++lines <= most_lines) {
      text += "  " + printable(status_line(items[i], outcomes[i], items.size())) + "\n";
    }
  }
  return lines <= most_lines ? text : text + fmt::format("  and {} more\n", lines - most_lines);
}

void add_summary(const std::vector<Item>& items, const std::vector<Outcome>& outcomes,
                 double seconds, Report& report) {
  ordered_json& json = report.figures;
  json["seconds"] = seconds;
  json["counts"] = ordered_json::object();
  for (const Status status : all_statuses) {
    json["counts"][name_of(status)] = total_of(outcomes, status).items;
  }
  json["items"] = ordered_json::array();
  report.table = Table{item_json({}, {}), {}};
  for (std::size_t i = 0; i < items.size(); ++i) {
    const ordered_json columns = item_json(items[i], outcomes[i]);
    json["items"].push_back(columns);
    json["items"].back()["figures"] = outcomes[i].figures;
    report.table->rows.push_back(columns);
    add_figures(outcomes[i].figures, report.table->rows.back());
    if (const std::string page = page_of(items[i], outcomes[i]); !page.empty()) {
      report.pages.emplace_back(ordered_json::json_pointer(fmt::format("/items/{}/page", i)), page);
    }
  }
}

}  // namespace ibmfair::commands
