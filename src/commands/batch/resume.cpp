#include "commands/batch/resume.h"

#include <filesystem>

#include <nlohmann/json.hpp>

#include "commands/batch/shell_words.h"
#include "commands/printable.h"
#include "ibmfair/base/version.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;

bool same_options(const Item& item, const Finished& record) {
  return record.program == version() && record.options == options_hash(item);
}

bool same_inputs(const Item& item, const Finished& record) {
  if (record.inputs.size() != item.reads.size()) {
    return false;
  }
  for (std::size_t i = 0; i < item.reads.size(); ++i) {
    const auto stamp = stamp_of(item.reads[i]);
    const Finished::Input& before = record.inputs[i];
    const bool same =
        stamp && (*stamp == before.stamp ||
                  (stamp->size == before.stamp.size && hash_of_file(item.reads[i]) == before.hash));
    if (!same) {
      return false;
    }
  }
  return true;
}

bool same_outputs(const Item& item, const Finished& record) {
  if (record.outputs.size() != item.writes.size()) {
    return false;
  }
  for (std::size_t i = 0; i < item.writes.size(); ++i) {
    const auto stamp = stamp_of(item.writes[i]);
    const FileStamp& before = record.outputs[i];
    if (!stamp || stamp->size != before.size || stamp->mtime != before.mtime) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string journal_key(const Item& item, const std::string& journal_path) {
  if (item.writes.empty()) {
    return item.command + " " + options_hash(item);
  }
  std::error_code error;
  const fs::path folder = fs::weakly_canonical(fs::absolute(journal_path, error), error);
  const fs::path file = fs::weakly_canonical(fs::absolute(item.writes.front(), error), error);
  const std::string name = file.lexically_relative(folder.parent_path()).string();
  return printable(name) == name ? name : shell_words({name});  // text that JSON does not change
}

std::string options_hash(const Item& item) {
  nlohmann::ordered_json job = nlohmann::ordered_json::parse(item.job);
  // These two options do not change the result.
  job["options"].erase("threads");
  job["options"].erase("overwrite");
  return hash_of_text(job.dump() + (item.job_is_exact ? "" : shell_words(item.words)));
}

Finished begin_record(const Item& item) {
  Finished record;
  record.options = options_hash(item);
  record.program = version();
  for (const std::string& path : item.reads) {
    record.inputs.push_back({stamp_of(path).value_or(FileStamp{}), ""});
  }
  return record;
}

bool add_hashes(const Item& item, Finished& record) {
  for (std::size_t i = 0; i < item.reads.size(); ++i) {
    const auto hash = hash_of_file(item.reads[i]);
    if (!hash || stamp_of(item.reads[i]) != record.inputs[i].stamp) {
      return false;
    }
    record.inputs[i].hash = *hash;
  }
  return true;
}

bool same_task(const Item& item, const Finished& record) {
  return same_options(item, record) && same_inputs(item, record);
}

std::optional<Outcome> still_valid(const Item& item, const std::vector<Finished>& records) {
  for (const Finished& record : records) {
    if (same_options(item, record) && same_outputs(item, record) && same_inputs(item, record)) {
      Outcome outcome = record.outcome;
      outcome.status = Status::skipped;
      return outcome;
    }
  }
  return std::nullopt;
}

}  // namespace ibmfair::commands
