// Spelling hints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace ibmfair::commands {

/// The number of letters to insert, drop, exchange, or swap with their neighbour to turn one word
/// into the other (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

/// `; did you mean 'smooth'?` for the candidate nearest to `word`, or an empty string where none is
/// near: up to one mistake in three letters.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace ibmfair::commands
