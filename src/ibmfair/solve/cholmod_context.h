// The settings and errors of CHOLMOD, for the files of this room only.
#pragma once

#include <cholmod.h>

#include "ibmfair/energy/hessian.h"

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
  /// the message. `failed_unknown` is where a matrix is not positive definite, or -1.
  void check(const char* stage, std::int64_t failed_unknown = -1) const;

 private:
  cholmod_common common_;
};

/// While one exists, CHOLMOD's own loops run on one thread. Debian's build asks for four whatever
/// the machine has: a mesh of 2,562 vertices then factors 1.5 times slower, one of 164k 1.2 times.
class SerialRegion {
 public:
  SerialRegion();
  ~SerialRegion();
  SerialRegion(const SerialRegion&) = delete;
  SerialRegion& operator=(const SerialRegion&) = delete;

 private:
  int levels_;  // of nested parallelism that were allowed before
};

/// Views `J` as CHOLMOD sees it; nothing is copied, and nothing may be written through it.
cholmod_sparse view(const SymmetricMatrix& J);

}  // namespace ibmfair
