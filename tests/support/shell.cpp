#include "support/shell.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include <sys/wait.h>

#include "support/run_program.h"

namespace ibmfair::test {

ShellResult run_shell(const std::string& line, const std::string& folder) {
  const std::string program = std::filesystem::path(program_path()).parent_path().string();
  const std::string whole = "cd " + shell_quoted(folder) + " && PATH=" + shell_quoted(program) +
                            ":$PATH exec sh -c " + shell_quoted(line) + " 2>&1 </dev/null";
  FILE* pipe = popen(whole.c_str(), "r");
  if (pipe == nullptr) {
    throw std::runtime_error("cannot run sh");
  }
  ShellResult result;
  std::array<char, 4096> buffer{};
  for (std::size_t count = 0; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    result.out.append(buffer.data(), count);
  }
  const int status = pclose(pipe);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return result;
}

bool is_installed(const std::string& program) {
  return run_shell("command -v " + shell_quoted(program), "/").exit_code == 0;
}

std::string shell_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace ibmfair::test
