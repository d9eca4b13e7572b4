#include "ibmfair/base/huge_pages.h"

#include <cstdint>

#include <sys/mman.h>

namespace ibmfair {

void advise_huge_pages(void* start, std::size_t bytes) {
  constexpr std::size_t page = std::size_t{1} << 21;
  // The advice is given for the whole pages inside the buffer only.
  const std::size_t before = (page - reinterpret_cast<std::uintptr_t>(start) % page) % page;
  if (bytes < before + page) return;
  madvise(static_cast<char*>(start) + before, (bytes - before) / page * page, MADV_HUGEPAGE);
}

}  // namespace ibmfair
