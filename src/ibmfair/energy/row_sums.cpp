#include "ibmfair/energy/row_sums.h"

namespace ibmfair {

RowSums::RowSums(const StencilTerms& terms, const Unknowns& unknowns, Others others)
    : terms_(terms), vertex_(unknowns.vertex) {
  blocks_.resize(static_cast<std::size_t>((size() + block_size - 1) / block_size));
  places_.resize(blocks_.size());
  const auto find = [&](std::int64_t begin, std::int64_t end, std::vector<Index>& place_of) {
    RowBlock& block = blocks_[begin / block_size];
    Places& places = places_[begin / block_size];
    std::size_t count = 0;
    for (std::int64_t u = begin; u < end; ++u) {
      count += terms.terms_at(vertex_[u]);
    }
    places.narrow.reserve(count);
    std::vector<Index> columns;
    for (auto u = static_cast<Index>(begin); u < end; ++u) {
      find_row(unknowns, u, others, place_of, columns, places);
      block.first.push_back(static_cast<std::int64_t>(columns.size()));
    }
    block.column.assign(columns.begin(), columns.end());
  };
  parallel_parts<Index>(size(), block_size, unknowns.unknown.size(), find);
  for (const RowBlock& block : blocks_) {
    for (std::size_t i = 1; i < block.first.size(); ++i) {
      widest_ = std::max(widest_, static_cast<std::size_t>(block.first[i] - block.first[i - 1]));
    }
  }
}

/// Appends the columns of row u, and the places of its terms, to those of its block. `place_of` has
/// one number for each unknown; all are zero before and after the call.
void RowSums::find_row(const Unknowns& unknowns, Index u, Others others,
                       std::vector<Index>& place_of, std::vector<Index>& columns,
                       Places& places) const {
  const auto for_vertices = [&](const auto& take) {
    terms_.for_vertices(vertex_[u], [&](Index w) { take(unknowns.unknown[w]); });
  };
  const auto first = static_cast<std::ptrdiff_t>(columns.size());
  const Index least = others == Others::later ? u : 0;
  columns.push_back(u);
  place_of[u] = 1;
  for_vertices([&](Index v) {
    if (v >= least && place_of[v] == 0) {
      columns.push_back(v);
      place_of[v] = 1;
    }
  });
  if (others == Others::later) {
    std::sort(columns.begin() + first + 1, columns.end());
  }
  const auto count = static_cast<Index>(columns.size()) - static_cast<Index>(first);
  for (Index k = 0; k < count; ++k) {
    place_of[columns[first + k]] = k + 1;
  }
  const Index padding = others == Others::all_in_pairs && count % 2 == 0 ? 1 : 0;
  const std::size_t terms = terms_.terms_at(vertex_[u]);
  const auto append = [&]<class Place>(std::vector<Place>& all) {
    all.resize(all.size() + terms);
    Place* place = all.data() + (all.size() - terms);
    for_vertices([&](Index v) { *place++ = static_cast<Place>(v < 0 ? 0 : place_of[v]); });
  };
  if (count + padding <= widest_narrow) {
    append(places.narrow);
  } else {
    append(places.wide);
  }
  for (Index k = 0; k < count; ++k) {
    place_of[columns[first + k]] = 0;
  }
  columns.insert(columns.end(), padding, u);
}

}  // namespace ibmfair
