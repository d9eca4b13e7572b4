#include "commands/batch/shared_list.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "commands/batch/resume.h"
#include "commands/batch/this_machine.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

/// Makes a new journal and returns its path, which no process of any machine has used before.
std::string make_own_journal(const std::string& folder) {
  std::error_code ignored;  // creating the file will report the error
  fs::create_directories(folder, ignored);
  for (int number = 1;; ++number) {
    const std::string path =
        fmt::format("{}/{}-{}-{}.journal", folder, host_name(), getpid(), number);
    const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd >= 0) {
      close(fd);
      return path;
    }
    if (errno != EEXIST) {
      throw CannotWrite(fmt::format("{}: cannot be written: {}", path, std::strerror(errno)));
    }
  }
}

/// The time between two renewals of a claim: one fifth of the expiry, so that one may be late.
milliseconds interval_of(double claim_expiry) {
  return milliseconds(
      std::max<std::int64_t>(1, static_cast<std::int64_t>(1000 * claim_expiry / 5)));
}

}  // namespace

SharedList::SharedList(const std::string& list_journal, double claim_expiry,
                       const JournalRecord& earlier)
    : list_journal_(list_journal),
      folder_{folder_of_processes(list_journal), claim_expiry},
      journal_(make_own_journal(folder_.path)),
      news_(earlier.continued()),
      heartbeat_(interval_of(claim_expiry)) {}

SharedList::~SharedList() {
  if (const auto stamp = stamp_of(journal_); stamp && stamp->size == 0) {
    unlink(journal_.c_str());
  }
}

std::optional<Outcome> SharedList::ended(const Item& item, const std::string& key) const {
  const Finished* last = news_.last(key);
  if (last == nullptr || last->refused || !same_options(item, *last)) {
    return std::nullopt;
  }
  // The output files are not checked, because a network file system may return outdated attributes.
  Outcome outcome = last->outcome;
  if (outcome.status == Status::ok) {
    outcome.status = Status::skipped;
  }
  return outcome;
}

std::unique_ptr<Claim> SharedList::claim(const std::string& key) {
  std::unique_ptr<Claim> claim = Claim::take(folder_, key, heartbeat_);
  if (claim) {
    // A process records the end of an item before it gives up its claim, so the record is complete
    // now. The claim file that was just made in the folder forces a network file system to update
    // its listing of the folder.
    read_news();
  }
  return claim;
}

void SharedList::clear_up(const std::vector<std::string>& keys) {
  remove_left_claims(folder_, keys, heartbeat_);
}

milliseconds SharedList::longest_pause() const {
  return std::min(milliseconds(5000), interval_of(folder_.expiry));
}

void SharedList::read_news() {
  std::vector<std::string> journals = journals_of_processes(list_journal_);
  std::erase(journals, journal_);
  news_.read(journals);
}

}  // namespace ibmfair::commands
