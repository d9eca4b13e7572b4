#include "fuzz/mesh_laws.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "fuzz/targets.h"
#include "ibmfair/io/line_end.h"
#include "ibmfair/io/source_bytes.h"

namespace ibmfair::fuzz {

namespace {

void require_complete(const MeshAttributes& attributes, const Mesh& mesh) {
  const auto vertices = static_cast<std::size_t>(mesh.X.rows());
  const std::size_t corners = mesh.faces.corner.size();
  const auto textures = static_cast<Index>(attributes.texture_coordinates.size());
  law(attributes.corner_texture.empty() || attributes.corner_texture.size() == corners,
      "every corner has a texture coordinate or none has");
  law(std::all_of(attributes.corner_texture.begin(), attributes.corner_texture.end(),
                  [&](Index t) { return t >= -1 && t < textures; }),
      "texture coordinates exist");
  law(attributes.colours.empty() || attributes.colours.size() == vertices,
      "every vertex has a colour or none has");
  const auto all_finite = [](const auto& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  };
  law(std::all_of(attributes.colours.begin(), attributes.colours.end(), all_finite) &&
          std::all_of(attributes.texture_coordinates.begin(), attributes.texture_coordinates.end(),
                      all_finite),
      "attributes are finite");
  law(std::all_of(attributes.face_statements.begin(), attributes.face_statements.end(),
                  [&](const auto& s) { return s.first >= 0 && s.first <= mesh.faces.size(); }),
      "statements stand before faces");
}

/// A few words, taken from the end of the bytes, that might name a group or a property.
std::vector<std::string> some_names(std::string_view bytes) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<std::string> names{""};
  for (std::size_t end = bytes.size(); end != 0 && names.size() < 4;) {
    const std::size_t last = bytes.find_last_not_of(blanks, end - 1);
    if (last == std::string_view::npos) break;
    const std::size_t before = bytes.find_last_of(blanks, last);
    const std::size_t first = before == std::string_view::npos ? 0 : before + 1;
    names.emplace_back(bytes.substr(first, last + 1 - first));
    end = first;
  }
  return names;
}

/// Whether the bytes have this place, counted from 1. The end of a line (LF, CRLF or CR) belongs to
/// the line. The bytes after the last line end are a line, too.
bool has_place(std::string_view bytes, std::int64_t line, std::int64_t column) {
  std::string_view rest = bytes;
  for (std::int64_t at_line = 1; at_line < line; ++at_line) {
    const std::size_t end = rest.find_first_of("\r\n");
    if (end == std::string_view::npos) return false;
    rest.remove_prefix(end + leading_line_end(rest.substr(end)).size());
  }
  const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
  const std::size_t length = end + leading_line_end(rest.substr(end)).size();
  return column >= 1 && column <= static_cast<std::int64_t>(length) + 1;
}

/// Removes a whole number, and the text that must follow it, from the start of a text.
std::optional<std::int64_t> take_number(std::string_view& text, std::string_view follower) {
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view rest = text.substr(static_cast<std::size_t>(end - text.data()));
  if (error != std::errc() || !rest.starts_with(follower)) return std::nullopt;
  text = rest.substr(follower.size());
  return number;
}

/// The numbers LINE and COL of a message `LINE:COL: message`.
std::optional<std::pair<std::int64_t, std::int64_t>> place_in_text(std::string_view message) {
  const auto line = take_number(message, ":");
  if (!line) return std::nullopt;
  const auto column = take_number(message, ": ");
  law(column.has_value(), "a line is followed by a column");
  return std::pair(*line, *column);
}

/// The number B of a message `ELEMENT ROW (byte B): message`.
std::optional<std::int64_t> byte_in(std::string_view message) {
  constexpr std::string_view sign = "(byte ";
  const std::size_t at = message.find(sign);
  if (at == std::string_view::npos) return std::nullopt;
  message.remove_prefix(at + sign.size());
  return take_number(message, "): ");
}

}  // namespace

void require_sound(const MeshFile& file) {
  const Mesh& mesh = file.mesh();
  const Polygons& faces = mesh.faces;
  law(mesh.X.rows() > 0 && mesh.X.allFinite(), "there are vertices, and all are finite");
  law(faces.size() > 0, "there are faces");
  law(faces.first.front() == 0 &&
          faces.first.back() == static_cast<std::int64_t>(faces.corner.size()),
      "faces begin with the first corner and end with the last");
  for (Index f = 0; f < faces.size(); ++f)
    law(faces.first[f + 1] - faces.first[f] >= 3, "a face has three corners and more");
  law(std::all_of(faces.corner.begin(), faces.corner.end(),
                  [&](Index v) { return v >= 0 && v < mesh.X.rows(); }),
      "corners are vertices");
  law(triangulate(mesh).F.rows() ==
          static_cast<Eigen::Index>(faces.corner.size()) - 2 * Eigen::Index{faces.size()},
      "a polygon is cut into two triangles less than it has corners");
  require_complete(file.attributes(), mesh);
  for (const std::string& name : some_names(file.bytes().view())) {
    try {
      law(file.vertex_mask(name).size() == static_cast<std::size_t>(mesh.X.rows()),
          "a mask is about every vertex");
    } catch (const BadOption&) {
      continue;                       // no such group or property
    } catch (const BadFile& error) {  // two groups or properties
      require_clear(error, file.bytes().name(), file.bytes().view());
    }
  }
}

void require_clear(const BadFile& error, const std::string& name, std::string_view bytes) {
  const std::string message = error.what();
  law(message.starts_with(name + ":"), "messages start with the file: " + message);
  law(message.size() < name.size() + 300, "messages are short: " + message);
  law(std::none_of(message.begin(), message.end(),
                   [](unsigned char c) { return c < ' ' || c == 0x7f; }),
      "messages hold no control characters: " + message);
  const std::string_view rest = std::string_view(message).substr(name.size() + 1);
  if (const auto place = place_in_text(rest)) {
    law(has_place(bytes, place->first, place->second),
        "the file has that line and column: " + message);
  } else if (const auto byte = byte_in(rest)) {
    law(*byte <= static_cast<std::int64_t>(bytes.size()), "the file has that byte: " + message);
  }
  law(rest.find(": ") != std::string_view::npos || rest.starts_with(' '),
      "messages say something: " + message);
}

bool same_faces(const Polygons& a, const Polygons& b) {
  return a.first == b.first && a.corner == b.corner;
}

}  // namespace ibmfair::fuzz
