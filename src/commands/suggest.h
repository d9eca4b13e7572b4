// Spelling hints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ibmfair::commands {

/// The smallest number of insertions, deletions and replacements of letters and swaps of
/// neighbouring letters that turn one word into the other (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// `; did you mean 'smooth'?` for the candidate nearest to `word`, or an empty string if no
/// candidate is near: at a distance of at most one third of the letters of `word`, or 1.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ibmfair::commands
