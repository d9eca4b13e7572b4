#include "petsc_engine/row_exchange.h"

#include <cstring>

namespace ibmfair::petsc {
namespace {

/// Sends rows that are sorted by rank; `sent` and `received` are the numbers of rows per rank.
std::string exchange_rows(const Communicator& comm, std::string_view rows, std::int64_t row,
                          const std::vector<int>& sent, const std::vector<int>& received) {
  const std::vector<int> from = first_places(sent), to = first_places(received);
  std::string result(static_cast<std::size_t>(row) * (to.back() + received.back()), '\0');
  MPI_Datatype type = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(static_cast<int>(row), MPI_BYTE, &type);
  MPI_Type_commit(&type);
  MPI_Alltoallv(rows.data(), sent.data(), from.data(), type, result.data(), received.data(),
                to.data(), type, comm.get());
  MPI_Type_free(&type);
  return result;
}

}  // namespace

std::string fetch_rows(const Communicator& comm, const Blocks& blocks, std::string_view block,
                       std::int64_t row, const std::vector<Index>& numbers) {
  const Route route(comm, blocks, numbers);
  std::string answers;
  answers.reserve(static_cast<std::size_t>(row) * route.wanted.items.size());
  for (const Index number : route.wanted.items) {
    answers += block.substr(row * (number - blocks.first(comm.rank())), row);
  }
  return exchange_rows(comm, answers, row, route.wanted.counts, route.asked.counts);
}

std::string deliver_rows(const Communicator& comm, const Blocks& blocks, std::string_view rows,
                         std::int64_t row, const std::vector<Index>& numbers) {
  const Route route(comm, blocks, numbers);
  const std::string received =
      exchange_rows(comm, rows, row, route.asked.counts, route.wanted.counts);
  std::string block(static_cast<std::size_t>(row * blocks.count(comm.rank())), '\0');
  for (std::size_t i = 0; i < route.wanted.items.size(); ++i) {
    const std::int64_t place = route.wanted.items[i] - blocks.first(comm.rank());
    std::memcpy(&block[row * place], &received[row * i], row);
  }
  return block;
}

}  // namespace ibmfair::petsc
