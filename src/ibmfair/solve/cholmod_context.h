// The settings and errors of CHOLMOD, for the files of this room only.
#pragma once

#include <cholmod.h>

namespace ibmfair {

/// One cholmod_common: started, quiet, set to the supernodal L L^T of 64-bit indices.
class CholmodContext {
 public:
  CholmodContext();
  ~CholmodContext();
  CholmodContext(const CholmodContext&) = delete;
  CholmodContext& operator=(const CholmodContext&) = delete;

  cholmod_common* get() { return &common_; }

  /// Throws what the last call's status means: OutOfMemory or FactorizationFailed with `stage` in
  /// the message.
  void check(const char* stage) const;

 private:
  cholmod_common common_;
};

}  // namespace ibmfair
