#include "petsc_engine/petsc_options.h"

#include <algorithm>
#include <cctype>

namespace ibmfair::petsc {
namespace {

bool is_petsc_option(const std::string& word) {
  return word.size() > 2 && word[0] == '-' &&
         std::isalpha(static_cast<unsigned char>(word[1])) != 0;
}

}  // namespace

SplitArguments split_arguments(const std::vector<std::string>& words) {
  const auto first = std::find_if(words.begin(), words.end(), is_petsc_option);
  return {{words.begin(), first}, {first, words.end()}};
}

}  // namespace ibmfair::petsc
