// Messages to the user. They go to standard error; standard output is for data.
#pragma once

#include <cstdint>
#include <string_view>

namespace ibmfair::commands {

struct ProgressState;

enum class MessageKind : std::uint8_t { error, warning, note, detail };

/// Takes messages and progress in place of the terminal.
class Listener {
 public:
  virtual ~Listener() = default;
  virtual void message(MessageKind kind, std::string_view text) = 0;
  virtual void progress(const ProgressState& state) = 0;
};

class Console {
 public:
  enum class Level : std::uint8_t {
    quiet,   ///< errors only
    normal,  ///< also warnings and notes
    verbose  ///< also details
  };

  /// Colours are used on a terminal, or if CLICOLOR_FORCE is set and not 0; they are never used if
  /// NO_COLOR is set or TERM is "dumb".
  Console();

  /// Prints nothing: everything goes to the listener, which must outlive this object.
  explicit Console(Listener& listener) : listener_(&listener) {}

  void set_level(Level level) { level_ = level; }
  Level level() const { return level_; }

  /// Whether standard error is a terminal: progress is shown only there.
  bool on_terminal() const { return terminal_; }

  /// Null for a console that prints.
  Listener* listener() const { return listener_; }

  // Each function prints one line; line breaks and control characters in the text, for example from
  // file names, are escaped (commands/printable.h).
  void error(std::string_view text) const;    ///< `ibmfair: error: text`
  void warning(std::string_view text) const;  ///< `ibmfair: warning: text`
  void detail(std::string_view text) const;   ///< `ibmfair: text`, only with -v
  /// `ibmfair: text`, and below it the lines of `table`, which must be printable.
  void note(std::string_view text, std::string_view table = {}) const;

 private:
  void say(MessageKind kind, std::string_view text, std::string_view table = {}) const;

  Level level_ = Level::normal;
  bool terminal_ = false;
  bool coloured_ = false;
  Listener* listener_ = nullptr;
};

/// Writes data to standard output. Throws CannotWrite, also if standard output is closed or its
/// reader has ended.
void write_standard_output(std::string_view bytes);

}  // namespace ibmfair::commands
