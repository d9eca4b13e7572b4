// What the program says to a person: always on standard error, standard output is for data.
#pragma once

#include <cstdint>
#include <string_view>

namespace ibmfair::commands {

class Console {
 public:
  enum class Level : std::uint8_t {
    quiet,   ///< errors only
    normal,  ///< warnings and notes, too
    verbose  ///< details, too
  };

  /// Colours are used on a terminal, or where CLICOLOR_FORCE is set and not 0, and never where
  /// NO_COLOR is set or TERM is "dumb".
  Console();

  void set_level(Level level) { level_ = level; }
  Level level() const { return level_; }

  /// Whether standard error is a terminal: progress is shown only there.
  bool on_terminal() const { return terminal_; }

  // Each says one line, whatever names of files hold: see commands/printable.h.
  void error(std::string_view text) const;    ///< `ibmfair: error: text`
  void warning(std::string_view text) const;  ///< `ibmfair: warning: text`
  void detail(std::string_view text) const;   ///< `ibmfair: text`, with -v only
  /// `ibmfair: text`, and below it the lines of a table that are printable as they are.
  void note(std::string_view text, std::string_view table = {}) const;

 private:
  void say(std::string_view label, std::string_view colour, std::string_view text,
           std::string_view table = {}) const;

  Level level_ = Level::normal;
  bool terminal_;
  bool coloured_;
};

/// Writes data to standard output. Throws CannotWrite, also where standard output is closed or its
/// reader is gone.
void write_standard_output(std::string_view bytes);

}  // namespace ibmfair::commands
