#include "commands/batch/json_text.h"

#include <algorithm>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "ibmfair/base/errors.h"
#include "ibmfair/base/short_text.h"

namespace ibmfair::commands {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t longest_value = 40;

/// The parser's message from `start` on, without the error code and position in front.
std::string reason_of(const ordered_json::exception& error, std::string_view start) {
  const std::string text = error.what();
  const std::size_t at = text.find(start);
  return short_text(at == std::string::npos ? text : text.substr(at));
}

[[noreturn]] void fail_at(std::string_view text, const std::string& name,
                          const ordered_json::parse_error& error) {
  // The parser counts bytes from 1; for a text that ends too early it returns one byte more.
  const std::size_t at = std::min(text.size(), std::max<std::size_t>(error.byte, 1) - 1);
  const std::string_view before = text.substr(0, at);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t column = at - (before.rfind('\n') + 1) + 1;
  throw BadFile(fmt::format("{}:{}:{}: {}", name, line, column, reason_of(error, "syntax error")));
}

/// Rejects repeated keys, of which the parser would silently use the last value, and deep nesting,
/// because the library copies and prints values by recursion.
class Scrutiny {
 public:
  explicit Scrutiny(const std::string& name) : name_(name) {}

  bool operator()(int depth, ordered_json::parse_event_t event, const ordered_json& value) {
    if (depth > deepest) {
      throw BadFile(fmt::format("{}: values are nested more than {} deep", name_, deepest));
    }
    if (event == ordered_json::parse_event_t::object_start) {
      open_.emplace_back();
    } else if (event == ordered_json::parse_event_t::object_end) {
      open_.pop_back();
    } else if (event == ordered_json::parse_event_t::key) {
      const auto key = value.get<std::string>();
      if (!open_.back().insert(key).second) {
        throw BadFile(fmt::format("{}: the key '{}' stands twice in one object", name_,
                                  short_text(key, longest_value)));
      }
    }
    return true;
  }

 private:
  static constexpr int deepest = 100;

  const std::string& name_;
  std::vector<std::set<std::string>> open_;
};

}  // namespace

ordered_json parse_json_text(std::string_view text, const std::string& name) {
  try {
    Scrutiny scrutiny(name);
    constexpr bool with_exceptions = true;
    constexpr bool with_comments = true;
    return ordered_json::parse(
        text,
        [&](int depth, ordered_json::parse_event_t event, const ordered_json& value) {
          return scrutiny(depth, event, value);
        },
        with_exceptions, with_comments);
  } catch (const ordered_json::parse_error& error) {
    fail_at(text, name, error);
  } catch (const ordered_json::out_of_range& error) {
    throw BadFile(fmt::format("{}: {}", name, reason_of(error, "number overflow")));
  }
}

std::string shown(const ordered_json& value) {
  return short_text(value.dump(), longest_value);
}

}  // namespace ibmfair::commands
