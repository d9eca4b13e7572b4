#include "petsc_engine/communicator.h"

#include <algorithm>
#include <exception>
#include <limits>

#include "commands/exit_code.h"
#include "ibmfair/base/errors.h"

namespace ibmfair::petsc {
namespace {

/// Converts the exception being handled into a Failure.
Failure current_failure() {
  std::string message;
  try {
    throw;
  } catch (const Failure& failure) {
    return failure;
  } catch (const std::exception& error) {
    message = error.what();
  } catch (...) {
    message = "an error of unknown kind";
  }
  return {static_cast<int>(commands::exit_code_of_current_exception()), message};
}

}  // namespace

Communicator::Communicator(MPI_Comm comm) : comm_(comm) {
  MPI_Comm_rank(comm, &rank_);
  MPI_Comm_size(comm, &size_);
}

double Communicator::sum(double x) const {
  std::vector<double> all(static_cast<std::size_t>(size_));
  MPI_Allgather(&x, 1, MPI_DOUBLE, all.data(), 1, MPI_DOUBLE, comm_);
  return std::accumulate(all.begin(), all.end(), 0.0);
}

std::int64_t Communicator::sum(std::int64_t x) const {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_INT64_T, MPI_SUM, comm_);
  return x;
}

double Communicator::max(double x) const {
  MPI_Allreduce(MPI_IN_PLACE, &x, 1, MPI_DOUBLE, MPI_MAX, comm_);
  return x;
}

bool Communicator::any(bool x) const {
  return sum(std::int64_t{x}) > 0;
}

std::string Communicator::from_first(std::string text) const {
  auto size = static_cast<std::int64_t>(text.size());
  MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm_);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, comm_);
  return text;
}

void Communicator::together(const std::function<void()>& work) const {
  Failure failure(0, {});
  try {
    work();
  } catch (...) {
    failure = current_failure();
  }
  int first = failure.code() != 0 ? rank_ : std::numeric_limits<int>::max();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, comm_);
  if (first == std::numeric_limits<int>::max()) {
    return;
  }
  int code = failure.code();
  MPI_Bcast(&code, 1, MPI_INT, first, comm_);
  std::string message = failure.message();
  auto size = static_cast<int>(message.size());
  MPI_Bcast(&size, 1, MPI_INT, first, comm_);
  message.resize(static_cast<std::size_t>(size));
  MPI_Bcast(message.data(), size, MPI_CHAR, first, comm_);
  throw Failure(code, message);
}

}  // namespace ibmfair::petsc
