// A loop over the blocks of a mesh on all threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ibmfair/base/parallel.h"
#include "ibmfair/base/threads.h"
#include "ibmfair/energy/mesh_blocks.h"

namespace ibmfair {

/// Memory in which a thread keeps the data of the block that it computes.
struct BlockScratch {
  BlockVertices vertices;
  std::vector<Row4> triangles;
  std::vector<FanFrame> frames;
};

class BlockLoop {
 public:
  /// Calls body(block, scratch) for every block, in parallel, and adds up the returned values in
  /// the order of the blocks.
  template <class Body>
  double sum(const MeshBlocks& blocks, const Body& body) {
    scratch_.resize(std::max<std::size_t>(scratch_.size(), worker_count()));
    partial_.resize(blocks.block.size());
    const auto run = [&](std::int64_t b) {
      partial_[b] = body(blocks.block[b], scratch_[worker_index()]);
    };
    run_tasks(static_cast<std::int64_t>(blocks.block.size()), blocks.are_worth_sharing(), run);
    double sum = 0;
    for (const double part : partial_) {
      sum += part;
    }
    return sum;
  }

 private:
  std::vector<BlockScratch> scratch_;  // one per thread, reused because allocation is slow
  std::vector<double> partial_;
};

}  // namespace ibmfair
