// The settings and errors of CHOLMOD, for use within solve/ only.
#pragma once

#include <cholmod.h>

namespace ibmfair {

/// An initialised cholmod_common with 64-bit indices that prints nothing.
class CholmodContext {
 public:
  CholmodContext();
  ~CholmodContext();
  CholmodContext(const CholmodContext&) = delete;
  CholmodContext& operator=(const CholmodContext&) = delete;

  cholmod_common* get() { return &common_; }

  /// Throws OutOfMemory or FactorizationFailed if the status of the last call is an error.
  void check() const;

 private:
  cholmod_common common_;
};

}  // namespace ibmfair
