#include "commands/batch/merge.h"

#include "commands/batch/resume.h"

namespace ibmfair::commands {

namespace {

Outcome merged_outcome(const Item& item, const JournalRecord& record, const std::string& key) {
  if (std::optional<Outcome> done = still_valid(item, record.finished(key))) {
    done->status = Status::ok;
    return *done;
  }
  const Finished* last = record.last(key);
  if (last != nullptr && last->outcome.status == Status::failed && same_task(item, *last)) {
    return last->outcome;
  }
  Outcome left;
  if (last != nullptr) {
    left.message = "its options, inputs or outputs have changed since it was run";
  } else if (record.started(key)) {
    left.message = "started, but not finished";
  }
  return left;
}

}  // namespace

std::vector<Outcome> merged_outcomes(const std::vector<Item>& items, const JournalRecord& record,
                                     const std::string& list_journal) {
  std::vector<Outcome> outcomes;
  outcomes.reserve(items.size());
  for (const Item& item : items) {
    outcomes.push_back(merged_outcome(item, record, journal_key(item, list_journal)));
  }
  return outcomes;
}

}  // namespace ibmfair::commands
