// The interpreter's lock (GIL), released for long computations and taken again.
//
// pybind11's own guards end the thread when the interpreter is shutting down, which would pass
// through destructors and abort the process. A daemon thread waits here instead: the process ends
// without it, as it ends without threads that wait in Python.
#pragma once

#include <chrono>
#include <thread>

#include <pybind11/pybind11.h>

namespace ibmfair::python {

inline void wait_if_interpreter_ends() {
#if PY_VERSION_HEX >= 0x030d0000
  const bool ends = Py_IsFinalizing() != 0;
#else
  const bool ends = _Py_IsFinalizing() != 0;
#endif
  while (ends) {
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

/// Releases the lock while this object exists.
class Unlocked {
 public:
  Unlocked() : state_(PyEval_SaveThread()) {}
  ~Unlocked() {
    wait_if_interpreter_ends();
    PyEval_RestoreThread(state_);
  }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Holds the lock while this object exists, on any thread.
class Locked {
 public:
  Locked() : state_((wait_if_interpreter_ends(), PyGILState_Ensure())) {}
  ~Locked() { PyGILState_Release(state_); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

}  // namespace ibmfair::python
