// The interpreter's lock (GIL), released for long computations and taken again, and the end of the
// interpreter, which waits for them.
//
// A daemon thread may still compute when the interpreter ends. It must not go on then: the process
// destroys what the computation uses, and taking the lock would end the thread through destructors
// (until Python 3.14), which aborts the process. So the interpreter first waits until every such
// thread has left the computation; there the threads stay until the process ends, as daemon threads
// do that wait in Python.
#pragma once

#include <pybind11/pybind11.h>

namespace ibmfair::python {

/// Makes the end of the interpreter wait for computations. To be called once, by the module.
void bind_interpreter_end();

/// Releases the lock while this object exists: the thread computes.
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  PyThreadState* state_;
};

/// Takes the lock within a computation, while this object exists.
class Locked {
 public:
  Locked();
  ~Locked();
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;

 private:
  PyGILState_STATE state_;
};

/// Calls a Python function, as long as it may take: the interpreter does not wait for it at its
/// end, and leaves the thread in it. The lock must be held. Throws error_already_set.
pybind11::object call(const pybind11::object& function, const pybind11::tuple& arguments);

}  // namespace ibmfair::python
