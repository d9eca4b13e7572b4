// The functions that libFuzzer calls. They run the target that `--target=NAME` names. For
// tools/fuzz, `--list` prints one line per target: its name, its kinds, and its folders of seeds.
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <span>
#include <string_view>

#include "fuzz/targets.h"

namespace {

const ibmfair::fuzz::Target* chosen = nullptr;

void list_targets() {
  for (const ibmfair::fuzz::Target& target : ibmfair::fuzz::targets()) {
    std::cout << target.name << '\t';
    for (const std::string_view kind : target.kinds)
      std::cout << kind << ' ';
    for (const std::filesystem::path& folder : ibmfair::fuzz::seed_folders(target))
      std::cout << '\t' << folder.string();
    std::cout << '\n';
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--target=";
  for (const char* word : std::span(*argv, static_cast<std::size_t>(*argc))) {
    const std::string_view text = word;
    if (text == "--list") {
      list_targets();
      std::exit(EXIT_SUCCESS);
    }
    if (text.starts_with(option)) {
      chosen = &ibmfair::fuzz::find_target(text.substr(option.size()));
    }
  }
  if (chosen == nullptr) {
    std::cerr << "fuzz: which target? --target=NAME; --list names them\n";
    std::exit(EXIT_FAILURE);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // An exception that leaves this function ends the process, and the input is saved.
  chosen->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
