#include "commands/batch/item_conflicts.h"

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include <fmt/format.h>

#include "commands/output_files.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

/// The item that writes a file, by the identity of the file.
using Writers = std::unordered_map<std::string, const Item*>;

bool reads_own_output(const Item& item, const Writers& writers) {
  const auto writer = writers.find(file_identity(item.input));
  return writer != writers.end() && writer->second != &item;
}

void add_writer(const std::string& path, const Item& item, Writers& writers) {
  const auto [place, added] = writers.emplace(file_identity(path), &item);
  if (added || is_special_file(path)) {
    return;
  }
  const Item& other = *place->second;
  if (&other == &item) {
    throw BadOption(fmt::format("{}'{}' is written twice by {}", item.place, path, item.label()));
  }
  throw BadOption(
      fmt::format("{}'{}' would be written by two items: {} and {} (names can hold {{stem}}, "
                  "{{name}}, {{dir}})",
                  item.place, path, other.label(), item.label()));
}

}  // namespace

std::vector<Item> without_own_outputs(std::vector<Item> items,
                                      const std::vector<bool>& found_by_glob) {
  Writers writers;
  for (const Item& item : items) {
    for (const std::string& path : item.writes) {
      writers.emplace(file_identity(path), &item);
    }
  }
  std::vector<Item> kept;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!found_by_glob[i] || !reads_own_output(items[i], writers)) {
      kept.push_back(items[i]);
    }
  }
  return kept;
}

void require_inputs(const std::vector<Item>& items) {
  for (const Item& item : items) {
    for (const std::string& path : item.reads) {
      std::error_code error;
      if (!fs::exists(path, error)) {
        throw BadFile(fmt::format("{}{}: there is no such file", item.place, path));
      }
    }
  }
}

void reject_conflicts(const std::vector<Item>& items) {
  Writers writers;
  for (const Item& item : items) {
    for (const std::string& path : item.writes) {
      add_writer(path, item, writers);
    }
  }
  for (const Item& item : items) {
    for (const std::string& path : item.reads) {
      const auto writer = writers.find(file_identity(path));
      if (writer == writers.end() || is_special_file(path)) {
        continue;
      }
      if (writer->second == &item) {
        throw BadOption(
            fmt::format("{}'{}' would be replaced by what is made from it", item.place, path));
      }
      throw BadOption(
          fmt::format("{}'{}' is written by another item, {}; items run in no particular order, so "
                      "this takes a second batch",
                      item.place, path, writer->second->label()));
    }
  }
}

}  // namespace ibmfair::commands
