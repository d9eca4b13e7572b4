// Small meshes of any topology and with any coordinates, made from bytes.
#pragma once

#include <cstdint>
#include <string_view>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair::fuzz {

/// Returns the bytes one after the other, and zeros after the last byte.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : rest_(bytes) {}

  bool empty() const { return rest_.empty(); }

  std::uint8_t next() {
    if (rest_.empty()) return 0;
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  /// A number in 0 .. count - 1.
  template <class Count>
  Count below(Count count) {
    return static_cast<Count>(next() % count);
  }

  bool flag() { return (next() & 1) != 0; }

 private:
  std::string_view rest_;
};

/// Three bytes choose a sheet, tube, torus, Moebius strip, Klein bottle or sphere of at most 25
/// vertices, or nothing. The other bytes change the mesh: they move vertices (also to 1e300 and
/// 1e-300); scale and shift the mesh; add, turn, repeat and remove faces; and join vertices. All
/// bytes are used.
Mesh small_mesh(Bytes& bytes);

}  // namespace ibmfair::fuzz
