// Handling of subnormal numbers: numbers below the smallest normal float32.
#pragma once

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace ibmfair {

/// While an object exists, results of this thread below float32's smallest normal number become
/// zero. Fill-in far from the diagonal decays to such numbers; an operation on a subnormal number
/// takes a hundred times longer, and a whole factorization ten times.
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
