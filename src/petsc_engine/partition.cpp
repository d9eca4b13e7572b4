#include "petsc_engine/partition.h"

#include <algorithm>

#include <petscmat.h>

#include "petsc_engine/check.h"

namespace ibmfair::petsc {
namespace {

/// Meshes with fewer vertices per rank are divided into blocks, because partitioners can fail for
/// parts of a few vertices.
constexpr std::int64_t worth_partitioning = 64;  // vertices per rank

struct Edge {
  Index from, to;
  auto operator<=>(const Edge&) const = default;
};

/// The edges at the vertices of this rank's block, sorted, each once.
std::vector<Edge> edges_of_block(const Communicator& comm, const Blocks& vertices,
                                 const std::vector<std::array<Index, 3>>& triangles) {
  std::vector<Edge> edges;
  edges.reserve(6 * triangles.size());
  for (const auto& x : triangles) {
    for (int i = 0; i < 3; ++i) {
      const Index a = x[i], b = x[(i + 1) % 3];
      if (a != b) {
        edges.push_back({a, b});
        edges.push_back({b, a});
      }
    }
  }
  edges = comm.exchange(sort_by_rank(edges, comm.size(),
                                     [&vertices](const Edge& e) { return vertices.owner(e.from); }))
              .items;
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// The adjacency graph of the edges. PETSc takes ownership of the arrays and frees them.
Mat adjacency(const Communicator& comm, const Blocks& vertices, const std::vector<Edge>& edges) {
  const auto rows = static_cast<PetscInt>(vertices.count(comm.rank()));
  PetscInt *first = nullptr, *neighbour = nullptr;
  check(PetscMalloc1(rows + 1, &first));
  check(PetscMalloc1(edges.size() + 1, &neighbour));
  std::size_t at = 0;
  for (PetscInt i = 0; i < rows; ++i) {
    first[i] = static_cast<PetscInt>(at);
    for (; at < edges.size() && edges[at].from == vertices.first(comm.rank()) + i; ++at) {
      neighbour[at] = edges[at].to;
    }
  }
  first[rows] = static_cast<PetscInt>(at);
  Mat graph = nullptr;
  check(MatCreateMPIAdj(comm.get(), rows, static_cast<PetscInt>(vertices.total), first, neighbour,
                        nullptr, &graph));
  return graph;
}

}  // namespace

std::vector<int> partition_vertices(const Communicator& comm, const Blocks& vertices,
                                    const std::vector<std::array<Index, 3>>& triangles) {
  const auto rows = static_cast<std::size_t>(vertices.count(comm.rank()));
  if (comm.size() == 1 || vertices.total < worth_partitioning * comm.size()) {
    return std::vector<int>(rows, comm.rank());
  }
  Mat graph = adjacency(comm, vertices, edges_of_block(comm, vertices, triangles));
  MatPartitioning partitioning = nullptr;
  IS ranks = nullptr;
  check(MatPartitioningCreate(comm.get(), &partitioning));
  check(MatPartitioningSetAdjacency(partitioning, graph));
  check(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  check(MatPartitioningSetFromOptions(partitioning));
  check(MatPartitioningApply(partitioning, &ranks));
  const PetscInt* rank_of = nullptr;
  check(ISGetIndices(ranks, &rank_of));
  std::vector<int> result(rank_of, rank_of + rows);
  check(ISRestoreIndices(ranks, &rank_of));
  check(ISDestroy(&ranks));
  check(MatPartitioningDestroy(&partitioning));
  check(MatDestroy(&graph));
  return result;
}

}  // namespace ibmfair::petsc
