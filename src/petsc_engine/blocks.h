// Rows of a file, distributed to the ranks in equal blocks before the mesh has been partitioned.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ibmfair/base/types.h"
#include "petsc_engine/communicator.h"

namespace ibmfair::petsc {

/// The distribution of rows 0 .. total - 1: rank r holds rows first(r) .. first(r + 1) - 1.
struct Blocks {
  std::int64_t total = 0;
  int ranks = 1;

  std::int64_t first(int rank) const { return total * rank / ranks; }
  std::int64_t count(int rank) const { return first(rank + 1) - first(rank); }
  int owner(std::int64_t row) const { return static_cast<int>(((row + 1) * ranks - 1) / total); }
};

/// The rows that each rank requests from the blocks of the other ranks.
struct Route {
  Parcels<Index> asked;   ///< row numbers that this rank requests, sorted by owner
  Parcels<Index> wanted;  ///< row numbers that the other ranks request from this rank

  /// Collective.
  Route(const Communicator& comm, const Blocks& blocks, const std::vector<Index>& rows)
      : asked(sort_by_rank(rows, comm.size(), [&](Index row) { return blocks.owner(row); })),
        wanted(comm.exchange(asked)) {}
};

/// Returns the value of each of `rows`, which may be in any order and contain duplicates, from the
/// rank that holds the row. Collective.
template <class T>
std::vector<T> fetch(const Communicator& comm, const Blocks& blocks, const std::vector<T>& values,
                     const std::vector<Index>& rows) {
  const Route route(comm, blocks, rows);
  Parcels<T> answers{{}, route.wanted.counts};
  answers.items.reserve(route.wanted.items.size());
  const std::int64_t first = blocks.first(comm.rank());
  for (const Index row : route.wanted.items) {
    answers.items.push_back(values[static_cast<std::size_t>(row - first)]);
  }
  Parcels<T> received{std::vector<T>(rows.size()), route.asked.counts};
  comm.exchange_known(answers, received);
  std::vector<int> next = first_places(route.asked.counts);
  std::vector<T> result;
  result.reserve(rows.size());
  for (const Index row : rows) {
    result.push_back(received.items[next[blocks.owner(row)]++]);
  }
  return result;
}

/// The reverse of fetch(): sends each value to the rank that holds its row, and stores the received
/// values in `block`. No row may be named by two ranks. Rows that no rank names keep their value in
/// `block`. Collective.
template <class T>
void deliver(const Communicator& comm, const Blocks& blocks, const std::vector<Index>& rows,
             const std::vector<T>& values, std::vector<T>& block) {
  struct Delivery {
    Index row;
    T value;
  };
  std::vector<Delivery> deliveries;
  deliveries.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    deliveries.push_back({rows[i], values[i]});
  }
  const Parcels<Delivery> received = comm.exchange(sort_by_rank(
      deliveries, comm.size(), [&](const Delivery& d) { return blocks.owner(d.row); }));
  for (const Delivery& d : received.items) {
    block[static_cast<std::size_t>(d.row - blocks.first(comm.rank()))] = d.value;
  }
}

}  // namespace ibmfair::petsc
