// The library's exceptions. Each has one meaning everywhere, and the program maps each to one exit
// code; the library itself never prints and never exits.
#pragma once

#include <stdexcept>
#include <string>

namespace ibmfair {

/// Base of everything that the library throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An option or argument has a value that cannot be used (exit code 2).
class BadOption : public Error {
 public:
  using Error::Error;
};

/// An input file cannot be read or is malformed; the message starts with `FILE:LINE:COL:` for text
/// and names element and byte for binary formats (exit code 3).
class BadFile : public Error {
 public:
  using Error::Error;
};

/// The geometry cannot be processed, although its file is well formed (exit code 4).
class BadMesh : public Error {
 public:
  using Error::Error;
};

/// The sparse factorization failed: the matrix is not positive definite, or a limit is exceeded
/// (exit code 4).
class FactorizationFailed : public Error {
 public:
  using Error::Error;
};

/// Memory ran out inside a library that reports it instead of throwing std::bad_alloc (exit code
/// 5).
class OutOfMemory : public Error {
 public:
  using Error::Error;
};

/// An output could not be written; the target is as it was before (exit code 6).
class CannotWrite : public Error {
 public:
  using Error::Error;
};

}  // namespace ibmfair
