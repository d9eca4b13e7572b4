#include "commands/batch/claim.h"

#include <cerrno>
#include <ctime>
#include <filesystem>
#include <random>
#include <set>
#include <utility>

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "commands/batch/claim_chain.h"
#include "commands/batch/file_state.h"
#include "commands/batch/heartbeat.h"
#include "commands/batch/this_machine.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

std::string random_digits() {
  std::random_device source;
  return fmt::format("{:08x}{:08x}", source(), source());
}

/// A new file with this text, under a unique temporary name (commands/batch/temporaries.h).
class UniqueFile {
 public:
  UniqueFile(const ClaimFolder& folder, const std::string& id, const std::string& text)
      : path_(fmt::format("{}/.ibmfair-{}-{}.tmp", folder.path, getpid(), id)) {
    fd_ =
        open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0666);
    // futimens() sets the time by the file server's clock; fsync() makes the text visible to other
    // machines.
    const bool made = fd_ >= 0 &&
                      write(fd_, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                      fsync(fd_) == 0 && futimens(fd_, nullptr) == 0;
    if (!made) {
      const int error = errno;
      remove();
      cannot_claim_at(path_, error);
    }
  }
  ~UniqueFile() { remove(); }
  UniqueFile(const UniqueFile&) = delete;
  UniqueFile& operator=(const UniqueFile&) = delete;

  const std::string& path() const { return path_; }
  int descriptor() const { return fd_; }

  /// Hands over the descriptor, which stays open when the temporary name is removed.
  int release() { return std::exchange(fd_, -1); }

 private:
  void remove() {
    unlink(path_.c_str());
    if (fd_ >= 0) {
      close(fd_);
    }
  }

  std::string path_;
  int fd_ = -1;
};

std::int64_t time_of_folder(const ClaimFolder& folder) {
  const UniqueFile file(folder, random_digits(), "");
  struct stat status {};
  if (fstat(file.descriptor(), &status) != 0) {
    cannot_claim_at(file.path(), errno);
  }
  return nanoseconds(status.st_mtim);
}

/// Links the file to `name`; returns false if another file has this name.
bool link_as(const UniqueFile& file, const std::string& name) {
  if (link(file.path().c_str(), name.c_str()) == 0) {
    return true;
  }
  const int error = errno;
  // A network file system may have made the link although its reply was lost.
  struct stat own {
  }, found{};
  if (fstat(file.descriptor(), &own) == 0 && lstat(name.c_str(), &found) == 0 &&
      own.st_dev == found.st_dev && own.st_ino == found.st_ino) {
    return true;
  }
  if (error != EEXIST) {
    cannot_claim_at(name, error);
  }
  return false;
}

std::int64_t nanoseconds_of(double seconds) {
  return static_cast<std::int64_t>(seconds * 1e9);
}

}  // namespace

std::unique_ptr<Claim> Claim::take(const ClaimFolder& folder, const std::string& key,
                                   Heartbeat& heartbeat) {
  std::unique_ptr<Claim> claim(new Claim(heartbeat));
  return claim->make(folder, key) ? std::move(claim) : nullptr;
}

bool Claim::make(const ClaimFolder& folder, const std::string& key) {
  lost_ = true;  // until the claim is made
  std::vector<FoundClaim> before = find_chain(folder, key);
  if (!before.empty()) {
    // The time is read before the claims, so that no claim seems older than it is, even if this
    // process is suspended in between.
    const std::int64_t now = time_of_folder(folder);
    before = find_chain(folder, key);
    if (!before.empty() && !holder_is_gone(before.back()) &&
        now - before.back().last_sign <= nanoseconds_of(folder.expiry)) {
      return false;
    }
  }
  const std::string id = random_digits();
  const ordered_json json = {{"id", id},
                             {"item", key},
                             {"host", host_name()},
                             {"pid", getpid()},
                             {"processes_of", process_space()},
                             {"start", fmt::format("{:%FT%TZ}", fmt::gmtime(std::time(nullptr)))}};
  const std::string text = json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  UniqueFile file(folder, id, text + "\n");
  const std::string name = name_of_claim(folder, key, before.empty() ? "" : before.back().mark);
  if (!link_as(file, name)) {
    return false;
  }
  const std::vector<FoundClaim> chain = find_chain(folder, key);
  if (chain.empty() || chain.back().path != name) {
    unlink(name.c_str());  // the chain that it should extend has been removed
    return false;
  }
  for (const FoundClaim& found : chain) {
    chain_.push_back(found.path);
    abandoned_.push_back({found.process, found.last_sign + nanoseconds_of(folder.expiry / 2)});
  }
  abandoned_.pop_back();
  mark_ = mark_of(text);
  successor_ = name_of_claim(folder, key, mark_);
  fd_ = file.release();
  lost_ = false;
  heartbeat_.add(*this);
  return true;
}

Claim::~Claim() {
  if (fd_ < 0) {
    return;
  }
  heartbeat_.remove(*this);
  renew();
  if (!lost_) {
    // The first claim is removed first: as long as it exists, no process can begin another chain,
    // and without it the rest of the chain cannot be reached.
    for (const std::string& name : chain_) {
      unlink(name.c_str());
    }
  }
  close(fd_);
}

void Claim::renew() {
  lost_ = lost_ || access(successor_.c_str(), F_OK) == 0 || is_removed();
  if (!lost_) {
    // Sets the file server's time. An error is ignored, because the next call may succeed.
    futimens(fd_, nullptr);
  }
}

/// Whether another process took over the item, gave it up and so removed this claim. The link count
/// of the file is not used, because some file systems have none.
bool Claim::is_removed() const {
  try {
    return mark_at(chain_.back()) != mark_;
  } catch (const CannotWrite&) {
    return false;  // the file may become readable again
  }
}

void Claim::note_process(pid_t process) const {
  const std::string line = fmt::format("{{\"process\":{}}}\n", process);
  // An error is ignored: it can only have the effect that a temporary file is left behind.
  [[maybe_unused]] const ssize_t count = write(fd_, line.data(), line.size());
  fsync(fd_);
}

void remove_left_claims(const ClaimFolder& folder, const std::vector<std::string>& keys,
                        Heartbeat& heartbeat) {
  std::set<std::string> claimed;
  std::error_code ignored;  // claims that remain do no harm
  for (const auto& entry : std::filesystem::directory_iterator(folder.path, ignored)) {
    if (entry.path().extension() == ".claim") {
      const std::string name = entry.path().stem().string();
      claimed.insert(name.substr(0, name.find('-')));
    }
  }
  for (const std::string& key : keys) {
    if (claimed.contains(hash_of_text(key))) {
      // The returned claim is destroyed at once, which removes the whole chain.
      Claim::take(folder, key, heartbeat);
    }
  }
}

}  // namespace ibmfair::commands
