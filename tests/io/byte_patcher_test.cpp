// The byte patcher, by which the writers of all formats copy their files, does the same as edits of
// a string.
#include "ibmfair/io/byte_patcher.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ibmfair/base/random_numbers.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/io/numbers.h"

namespace ibmfair::test {
namespace {

/// A text, and edits of the text: the places and their replacements.
struct Edits {
  enum class What { real, single, text, nothing };

  struct Edit {
    std::size_t first, size;
    What what;
    double value;
  };

  std::string text;
  std::vector<Edit> edits;

  /// The text consists of words with `gap` bytes after each word. `choose` says by what each word
  /// is replaced; every fifth word stays.
  template <class Choose>
  Edits(int count, std::size_t gap, Choose choose) {
    RandomNumbers random(7);
    for (int i = 0; i < count; ++i) {
      const std::string word = fmt::format("word{}", i);
      if (i % 5 != 4) {
        edits.push_back({text.size(), word.size(), choose(i), 1e3 * random.uniform() - 500});
      }
      text += word + std::string(gap, static_cast<char>('a' + i % 26));
    }
  }

  std::string expected() const {
    std::string result;
    std::size_t copied = 0;
    for (const auto& [first, size, what, value] : edits) {
      result.append(text, copied, first - copied);
      copied = first + size;
      char buffer[number_text_capacity];
      if (what == What::real) result += number_text(value, buffer);
      if (what == What::single) result += number_text(static_cast<float>(value), buffer);
      if (what == What::text) result += fmt::format("<{}>", first);
    }
    return result.append(text, copied);
  }

  std::string patched() const {
    const auto source = SourceBytes::from_memory("text", text);
    MemorySink out;
    BytePatcher patcher(*source, out);
    for (const auto& [offset, size, what, value] : edits) {
      const char* const first = source->begin() + offset;
      const char* const last = first + size;
      if (what == What::real) patcher.replace(first, last, value);
      if (what == What::single) patcher.replace(first, last, static_cast<float>(value));
      if (what == What::text) patcher.replace(first, last, fmt::format("<{}>", offset));
      if (what == What::nothing) patcher.remove(first, last);
    }
    patcher.finish();
    return out.text();
  }
};

void expect_right(const Edits& edits) {
  const std::string expected = edits.expected();
  const int before = thread_count();
  for (const int threads : {1, 2, 3}) {
    set_thread_count(threads);
    EXPECT_TRUE(edits.patched() == expected)
        << edits.edits.size() << " edits, " << threads << " threads";  // the texts are long
  }
  set_thread_count(before);
}

TEST(BytePatcher, ReplacesAnyCountOfNumbers) {
  for (const int count : {0, 1, 2, 700, 1025, 10'240, 10'241, 50'000}) {
    expect_right({count, 1, [](int) { return Edits::What::real; }});
    expect_right({count, 1, [](int i) { return Edits::What(i % 2); }});
  }
}

TEST(BytePatcher, KeepsTheOrderOfAllThatItReplacesAndLeavesOut) {
  for (const int rarely : {1, 7, 1000, 9001}) {
    expect_right(
        {30'000, 2, [&](int i) { return Edits::What(i % rarely == 0 ? i / rarely % 4 : i % 2); }});
  }
}

TEST(BytePatcher, CopiesWhateverLengthIsInBetween) {
  for (const std::size_t gap : {0, 100, 5000, 3'000'000}) {
    const int count = gap > 1'000'000 ? 12 : 2000;
    expect_right({count, gap, [](int i) { return Edits::What(i % 3 == 2 ? 3 : 0); }});
  }
}

}  // namespace
}  // namespace ibmfair::test
