#include "interpreter_lock.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include <pthread.h>

namespace py = pybind11;

namespace ibmfair::python {
namespace {

/// The threads that compute without the interpreter's lock.
struct Computations {
  std::mutex mutex;
  std::condition_variable left;
  int running = 0;
  std::optional<std::thread::id> ending;  // the thread that ends the interpreter, once it does

  /// That thread itself may compute on, in functions that Python calls at its end.
  bool must_end() const { return ending && *ending != std::this_thread::get_id(); }
};

// Never destroyed: daemon threads use it until the process ends.
Computations* computations = new Computations;

[[noreturn]] void wait_for_the_end_of_the_process() {
  while (true) {
    std::this_thread::sleep_for(std::chrono::hours(1));
  }
}

void enter() {
  std::unique_lock lock(computations->mutex);
  if (computations->must_end()) {
    lock.unlock();
    wait_for_the_end_of_the_process();
  }
  ++computations->running;
}

void leave() {
  const std::lock_guard lock(computations->mutex);
  --computations->running;
  computations->left.notify_all();
}

/// Whether the interpreter ends and the calling thread is to leave its computation.
bool interpreter_ends() {
  const std::lock_guard lock(computations->mutex);
  return computations->must_end();
}

void leave_if_interpreter_ends() {
  if (interpreter_ends()) {
    leave();
    wait_for_the_end_of_the_process();
  }
}

/// Python ends daemon threads by unwinding them, without the lock, which no destructor expects. A
/// thread waits here instead.
class NotUnwound {
 public:
  NotUnwound() = default;
  ~NotUnwound() {
    if (is_finalizing() && interpreter_ends()) {
      wait_for_the_end_of_the_process();
    }
  }
  NotUnwound(const NotUnwound&) = delete;
  NotUnwound& operator=(const NotUnwound&) = delete;

 private:
  static bool is_finalizing() {
#if PY_VERSION_HEX >= 0x030d0000
    return Py_IsFinalizing() != 0;
#else
    return _Py_IsFinalizing() != 0;
#endif
  }
};

void wait_for_computations() {
  const py::gil_scoped_release unlocked;
  std::unique_lock lock(computations->mutex);
  computations->ending = std::this_thread::get_id();
  computations->left.wait(lock, [] { return computations->running == 0; });
}

}  // namespace

void bind_interpreter_end() {
  py::module_::import("atexit").attr("register")(py::cpp_function(&wait_for_computations));
  // A child process has only the thread that forked, which held the interpreter's lock.
  pthread_atfork(nullptr, nullptr, [] { computations = new Computations; });
}

Unlocked::Unlocked() : state_(PyEval_SaveThread()) {
  enter();
}

Unlocked::~Unlocked() {
  leave_if_interpreter_ends();
  PyEval_RestoreThread(state_);
  leave();
}

Locked::Locked() {
  leave_if_interpreter_ends();
  state_ = PyGILState_Ensure();
  leave();  // what the thread does in Python, the interpreter does not wait for
}

Locked::~Locked() {
  if (interpreter_ends()) {
    PyGILState_Release(state_);
    wait_for_the_end_of_the_process();
  }
  enter();
  PyGILState_Release(state_);
}

py::object call(const py::object& function, const py::tuple& arguments) {
  PyObject* result = nullptr;
  {
    const NotUnwound here;
    result = PyObject_CallObject(function.ptr(), arguments.ptr());
  }
  if (result == nullptr) {
    throw py::error_already_set();
  }
  return py::reinterpret_steal<py::object>(result);
}

}  // namespace ibmfair::python
