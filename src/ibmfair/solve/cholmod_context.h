// The settings and errors of CHOLMOD, for the files of this room only.
#pragma once

#include <cholmod.h>

namespace ibmfair {

/// One cholmod_common of 64-bit indices: started, and quiet.
class CholmodContext {
 public:
  CholmodContext();
  ~CholmodContext();
  CholmodContext(const CholmodContext&) = delete;
  CholmodContext& operator=(const CholmodContext&) = delete;

  cholmod_common* get() { return &common_; }

  /// Throws what the last call's status means: OutOfMemory or FactorizationFailed.
  void check() const;

 private:
  cholmod_common common_;
};

}  // namespace ibmfair
