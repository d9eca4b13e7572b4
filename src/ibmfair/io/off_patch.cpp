// Writes an OFF file with only the coordinates of moved vertices, and their normals, changed.
#include <optional>

#include "ibmfair/io/byte_patcher.h"
#include "ibmfair/io/normals.h"
#include "ibmfair/io/off.h"
#include "ibmfair/io/token_cursor.h"

namespace ibmfair::off {
namespace {

using Token = std::string_view;

void replace(BytePatcher& file, Token token, double value) {
  file.replace(token.data(), token.data() + token.size(), value);
}

}  // namespace

std::vector<std::string> patch(const PatchRequest& request, AtomicFile& out) {
  const Layout layout = read_layout(request.source);
  if (layout.binary) return patch_binary(request, layout, out);

  std::optional<RenewedNormals> normals;
  if (layout.normal) {
    normals.emplace(request.mesh.faces, request.mesh.X, request.X, request.moved);
  }
  BytePatcher file(request.source, out);
  TokenCursor cursor(request.source, layout.body, true);
  for (std::int64_t v = 0; v < layout.vertex_count; ++v) {
    for (int c = 0; c < 3; ++c) {
      const Token token = cursor.token();
      if (request.X(v, c) != request.mesh.X(v, c)) replace(file, token, request.X(v, c));
    }
    if (normals) {
      std::array<Token, 3> tokens;
      Vec3 old = Vec3::Zero();
      for (int c = 0; c < 3; ++c) {
        const Token token = cursor.token();
        parse_real(token.data(), token.data() + token.size(), old[c]);
        tokens[static_cast<std::size_t>(c)] = token;
      }
      const Vec3 renewed = normals->is_stale(v) ? normals->renew(v, old) : old;
      for (int c = 0; c < 3 && normals->is_stale(v); ++c) {
        replace(file, tokens[static_cast<std::size_t>(c)], renewed[c]);
      }
    }
    for (int c = layout.normal ? 3 : 0; c < layout.extra_columns(); ++c)
      cursor.token();
  }
  file.finish();
  return {};
}

}  // namespace ibmfair::off
