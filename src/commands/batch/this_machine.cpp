#include "commands/batch/this_machine.h"

#include <array>
#include <cctype>
#include <fstream>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace ibmfair::commands {

std::string host_name() {
  std::array<char, 256> buffer{};
  if (gethostname(buffer.data(), buffer.size() - 1) != 0 || buffer[0] == '\0') {
    return "host";
  }
  std::string name(buffer.data());
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '-') {
      c = '_';
    }
  }
  return name;
}

std::string process_space() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string boot;
  struct stat space {};
  if (!(file >> boot) || stat("/proc/self/ns/pid", &space) != 0) {
    return "";
  }
  return fmt::format("{}/{}", boot, space.st_ino);
}

}  // namespace ibmfair::commands
