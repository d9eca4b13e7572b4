// Small meshes of any topology and any coordinates, made of bytes.
#pragma once

#include <cstdint>
#include <string_view>

#include "ibmfair/mesh/mesh.h"

namespace ibmfair::fuzz {

/// Takes bytes one after the other; zeros once there are none left.
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

  /// 0 .. count - 1.
  template <class Count>
  Count below(Count count) {
    return static_cast<Count>(next() % count);
  }

  bool flag() { return (next() & 1) != 0; }

 private:
  std::string_view rest_;
};

/// Three bytes choose a sheet, tube, torus, Moebius strip, Klein bottle or sphere of at most 25
/// vertices, or nothing; the others change it: move vertices, to 1e300 and 1e-300, too; scale and
/// shift; add, turn, repeat and remove faces; join vertices. Takes all bytes that there are.
Mesh small_mesh(Bytes& bytes);

}  // namespace ibmfair::fuzz
