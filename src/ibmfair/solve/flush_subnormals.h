// Numbers too small for float32's exponent.
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace ibmfair {

/// While one exists, this thread's results below float32's smallest normal number are zero. Fill
/// far from the diagonal decays to there, and each such operation takes a hundred times longer:
/// a factorization, ten times.
class FlushSubnormals {
 public:
  FlushSubnormals() {
#if defined(__SSE__)
    before_ = _mm_getcsr();
    _mm_setcsr(before_ | flush_to_zero | subnormals_are_zero);
#endif
  }
  ~FlushSubnormals() {
#if defined(__SSE__)
    _mm_setcsr(before_);
#endif
  }
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

 private:
#if defined(__SSE__)
  static constexpr unsigned flush_to_zero = 0x8000, subnormals_are_zero = 0x0040;
  unsigned before_;
#endif
};

}  // namespace ibmfair
