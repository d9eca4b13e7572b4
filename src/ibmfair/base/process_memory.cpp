#include "ibmfair/base/process_memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace ibmfair {
namespace {

/// The number behind a name in a file of lines such as `VmRSS:   1234 kB`, in bytes.
double entry(const char* path, const std::string& name, double otherwise) {
  std::ifstream file(path);
  for (std::string word; file >> word;) {
    if (double kilobytes = 0; word == name && file >> kilobytes) {
      return 1024 * kilobytes;
    }
  }
  return otherwise;
}

}  // namespace

double resident_bytes() {
  return entry("/proc/self/status", "VmRSS:", 0);
}

double available_bytes() {
  return entry("/proc/meminfo", "MemAvailable:", std::numeric_limits<double>::infinity());
}

}  // namespace ibmfair
