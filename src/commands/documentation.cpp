#include "commands/documentation.h"

#include <CLI/CLI.hpp>

namespace ibmfair::commands {

Documentation& documentation_of(CLI::App& app) {
  return dynamic_cast<DocumentedApp&>(app).documentation;
}

const Documentation& documentation_of(const CLI::App& app) {
  return dynamic_cast<const DocumentedApp&>(app).documentation;
}

OptionNote& note_of(CLI::App& app, const CLI::Option& option) {
  return documentation_of(app).notes[option.get_name(true, true)];
}

void begin_group(CLI::App& app, const std::string& name) {
  app.option_defaults()->group(name);
}

}  // namespace ibmfair::commands
