#include "ibmfair/io/obj_scanner.h"

#include <charconv>
#include <system_error>

namespace ibmfair::obj {

ObjScanner::ObjScanner(const SourceBytes& source) : ObjScanner(source, source.begin()) {
  if (source.view().starts_with("\xEF\xBB\xBF")) p_ += 3;
}

bool ObjScanner::next_statement() {
  if (!keyword_.empty()) skip_line();
  while (true) {
    skip_blanks();
    if (p_ == end_) return false;
    if (*p_ == '#') {
      // A comment ends with its line even if the line ends with a backslash, as in `# C:\meshes\`.
      skip_to(line_end);
    }
    if (p_ == end_) return false;
    if (!is(*p_, line_end)) break;
    ++p_;
  }
  const char* start = p_++;
  skip_to(delimiter);
  keyword_ = {start, static_cast<std::size_t>(p_ - start)};
  return true;
}

void ObjScanner::skip_line() {
  while (true) {
    skip_to(statement_end | continuation);
    if (is(*p_, line_end)) return;
    if (*p_ == '\\') {
      if (continues_line()) {
        skip_continuations();
      } else {
        ++p_;
      }
    } else if (is(p_[-1], blank)) {
      skip_to(line_end);
    } else {
      ++p_;
    }
  }
}

void ObjScanner::skip_continuations() {
  while (*p_ == '\\' && continues_line()) {
    const bool pair = p_[1] == '\r' && p_ + 2 != end_ && p_[2] == '\n';
    p_ = characters::find_not(p_ + (pair ? 3 : 2), blank);
  }
}

const char* ObjScanner::after_statement() {
  skip_line();
  const char* p = p_;
  if (p != end_ && *p == '\r') ++p;
  if (p != end_ && *p == '\n') ++p;
  return p;
}

void ObjScanner::corner_references(const char* start, RawCorner& corner) {
  ++p_;
  const bool has_texture = index(corner.texture);
  if (has_texture && corner.texture == 0) fail(start, "texture coordinates are counted from 1");
  if (*p_ != '/') return;
  ++p_;
  const bool has_normal = index(corner.normal);
  if (has_normal && corner.normal == 0) fail(start, "normals are counted from 1");
}

std::string_view ObjScanner::word() {
  if (at_statement_end()) return {};
  const char* start = p_;
  skip_to(blank | line_end | continuation);
  // A backslash inside a line is an ordinary character.
  while (*p_ == '\\' && !continues_line()) {
    ++p_;
    skip_to(blank | line_end | continuation);
  }
  return {start, static_cast<std::size_t>(p_ - start)};
}

std::string_view ObjScanner::rest() {
  skip_blanks();
  const char* start = p_;
  skip_line();
  const char* stop = p_;
  while (stop != start && is(stop[-1], blank))
    --stop;
  return {start, static_cast<std::size_t>(stop - start)};
}

double ObjScanner::any_real() {
  skip_blanks();
  const char* start = p_ != end_ && *p_ == '+' ? p_ + 1 : p_;
  double value = 0.0;
  const auto [after, error] = std::from_chars(start, end_, value);
  if (error == std::errc::invalid_argument || !is(*after, delimiter)) fail(p_, "not a number");
  p_ = after;
  return std::isfinite(value) ? value : 0.0;
}

void ObjScanner::fail_at_real() const {
  fail(p_, describe_bad_real(p_, end_));
}

}  // namespace ibmfair::obj
