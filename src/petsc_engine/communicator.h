// A C++ interface to MPI. All members that communicate are collective: every process of the run
// must call them, in the same order.
#pragma once

#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include <mpi.h>

namespace ibmfair::petsc {

/// Items to be sent to each rank, or received from each rank, in the order of the ranks.
template <class T>
struct Parcels {
  std::vector<T> items;
  std::vector<int> counts;  ///< number of items for (from) each rank
};

/// The error of one rank, with the message and the exit code with which all ranks end.
class Failure {
 public:
  Failure(int code, std::string message) : code_(code), message_(std::move(message)) {}
  int code() const { return code_; }
  const std::string& message() const { return message_; }

 private:
  int code_;
  std::string message_;
};

/// An MPI type of sizeof(T) bytes.
template <class T>
class BytesType {
 public:
  static_assert(std::is_trivially_copyable_v<T>);
  BytesType() {
    MPI_Type_contiguous(static_cast<int>(sizeof(T)), MPI_BYTE, &type_);
    MPI_Type_commit(&type_);
  }
  ~BytesType() { MPI_Type_free(&type_); }
  BytesType(const BytesType&) = delete;
  BytesType& operator=(const BytesType&) = delete;
  MPI_Datatype get() const { return type_; }

 private:
  MPI_Datatype type_ = MPI_DATATYPE_NULL;
};

/// The index of the first item of each rank: the exclusive prefix sums of `counts`.
inline std::vector<int> first_places(const std::vector<int>& counts) {
  std::vector<int> first;
  first.reserve(counts.size());
  int next = 0;
  for (const int count : counts) {
    first.push_back(next);
    next += count;
  }
  return first;
}

class Communicator {
 public:
  explicit Communicator(MPI_Comm comm);

  MPI_Comm get() const { return comm_; }
  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_first() const { return rank_ == 0; }

  /// The sum over all ranks. The terms are added in the order of the ranks, so that all ranks get
  /// the same bits.
  double sum(double x) const;
  std::int64_t sum(std::int64_t x) const;
  double max(double x) const;
  bool any(bool x) const;

  /// Returns the text of the first rank on all ranks.
  std::string from_first(std::string text) const;

  /// Runs `work` on every rank. If `work` throws on some ranks, throws Failure on all ranks, with
  /// the message of the lowest rank that threw. `work` itself must not communicate.
  void together(const std::function<void()>& work) const;

  /// Sends the items of each parcel to its rank, and returns the items that all ranks have sent to
  /// this rank.
  template <class T>
  Parcels<T> exchange(const Parcels<T>& sent) const {
    Parcels<T> received;
    received.counts.resize(sent.counts.size());
    MPI_Alltoall(sent.counts.data(), 1, MPI_INT, received.counts.data(), 1, MPI_INT, comm_);
    received.items.resize(
        std::accumulate(received.counts.begin(), received.counts.end(), std::size_t{0}));
    exchange_known(sent, received);
    return received;
  }

  /// Like exchange(), if the counts are known: `received` has its counts set and its items resized.
  template <class T>
  void exchange_known(const Parcels<T>& sent, Parcels<T>& received) const {
    const BytesType<T> type;
    const std::vector<int> from = first_places(sent.counts), to = first_places(received.counts);
    MPI_Alltoallv(sent.items.data(), sent.counts.data(), from.data(), type.get(),
                  received.items.data(), received.counts.data(), to.data(), type.get(), comm_);
  }

  /// Returns the items of all ranks, in the order of the ranks, on the first rank; on the other
  /// ranks returns nothing.
  template <class T>
  std::vector<T> gather_to_first(const std::vector<T>& items) const {
    Parcels<T> sent{items, std::vector<int>(static_cast<std::size_t>(size_), 0)};
    sent.counts[0] = static_cast<int>(items.size());
    return exchange(sent).items;
  }

 private:
  MPI_Comm comm_;
  int rank_ = 0, size_ = 1;
};

/// Sorts the items by the rank that `rank_of` returns for them; the sort is stable.
template <class T, class RankOf>
Parcels<T> sort_by_rank(const std::vector<T>& items, int ranks, const RankOf& rank_of) {
  Parcels<T> parcels{std::vector<T>(items.size()), std::vector<int>(ranks, 0)};
  for (const T& item : items) {
    ++parcels.counts[rank_of(item)];
  }
  std::vector<int> next = first_places(parcels.counts);
  for (const T& item : items) {
    parcels.items[next[rank_of(item)]++] = item;
  }
  return parcels;
}

}  // namespace ibmfair::petsc
