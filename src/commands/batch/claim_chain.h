// Reading the chain of claims to an item. See claim.h for the meaning of claims.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

#include "commands/batch/claim.h"

namespace ibmfair::commands {

struct FoundClaim {
  std::string path;
  std::string mark;            // differs from the marks of all other claims
  std::int64_t last_sign = 0;  // time of the last sign of life, nanoseconds
  pid_t holder_here = 0;       // the holder, if it is a process of this machine; else 0
  pid_t process = 0;           // the process that runs the item; 0: not known
};

/// The claims to the item with this key, from the first to the last, which is the valid one; empty
/// if there is no claim. Throws CannotWrite if a file with the name of a claim is not a claim.
std::vector<FoundClaim> find_chain(const ClaimFolder& folder, const std::string& key);

/// The name of the successor of the claim with the mark `predecessor_mark`; if the mark is empty,
/// the name of the first claim to the item.
std::string name_of_claim(const ClaimFolder& folder, const std::string& key,
                          const std::string& predecessor_mark);

/// The mark of the claim at `path`; empty if there is no claim. Throws like find_chain.
std::string mark_at(const std::string& path);

/// The mark of a claim with this text: the hash of its first line, which contains a random number.
std::string mark_of(const std::string& text);

/// Whether the holder is a process of this machine that has ended, so that it is not necessary to
/// wait for the expiry of the claim.
bool holder_is_gone(const FoundClaim& claim);

[[noreturn]] void cannot_claim_at(const std::string& path, int error);

}  // namespace ibmfair::commands
