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

/// Makes a journal of a name that no other process, of whatever machine, has or had.
std::string make_own_journal(const std::string& folder) {
  std::error_code ignored;  // making the file will tell
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

/// Several signs of life fit into the expiry, so that one may be late.
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
  // Its files are not looked at: what a network file system says of them may be from before.
  Outcome outcome = last->outcome;
  if (outcome.status == Status::ok) {
    outcome.status = Status::skipped;
  }
  return outcome;
}

std::unique_ptr<Claim> SharedList::claim(const std::string& key) {
  std::unique_ptr<Claim> claim = Claim::take(folder_, key, heartbeat_);
  if (claim) {
    // Whoever has given the item up has noted before how it ended. The file that this process has
    // just made in their folder makes a network file system list it anew.
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
