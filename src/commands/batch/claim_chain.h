// The claims to an item, as anybody finds them: see claim.h for what they mean.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

#include "commands/batch/claim.h"

namespace ibmfair::commands {

struct FoundClaim {
  std::string path;
  std::string mark;            // that no other claim has
  std::int64_t last_sign = 0;  // of life, nanoseconds
  pid_t holder_here = 0;       // the process that holds it, if that is one of this machine
  pid_t process = 0;           // that runs the item, where it says so
};

/// From the first to the one that is held; empty where nobody claims the item of this key. Throws
/// CannotWrite where what has the name of a claim is none.
std::vector<FoundClaim> find_chain(const ClaimFolder& folder, const std::string& key);

/// The name of the first claim to an item, or of the successor of the one that has this mark.
std::string name_of_claim(const ClaimFolder& folder, const std::string& key,
                          const std::string& predecessor_mark);

/// The mark of the claim of that name; empty where there is none. Throws as find_chain.
std::string mark_at(const std::string& path);

/// The mark of a claim with this text: the hash of its first line, which is like no other.
std::string mark_of(const std::string& text);

/// Whether the holder is known to have ended without anybody having to wait for that.
bool holder_is_gone(const FoundClaim& claim);

[[noreturn]] void cannot_claim_at(const std::string& path, int error);

}  // namespace ibmfair::commands
