#include "commands/signals.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <initializer_list>
#include <string_view>

#include <poll.h>
#include <unistd.h>

#include "commands/crash_message.h"
#include "commands/terminal_line.h"
#include "ibmfair/io/temporary_file.h"

namespace ibmfair::commands {

namespace {

std::atomic<bool> end_is_postponed{false};
std::atomic<int> postponed_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

/// Writes to standard error only if this does not block, so that a full pipe cannot delay the end
/// of the process; the caller still gets the exit code.
void tell(std::string_view text) {
  pollfd listener{STDERR_FILENO, POLLOUT, 0};
  if (poll(&listener, 1, 0) == 1) {
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size());
  }
}

extern "C" void end_on_request(int signal_number) {
  const int error = errno;
  if (end_is_postponed.exchange(false)) {
    postponed_signal = signal_number;
    clear_terminal_line();
    tell("ibmfair: interrupted; finishing this step (interrupt once more to end at once)\n");
    errno = error;
    return;
  }
  remove_temporary_files();
  end_terminal_line();
  tell("ibmfair: interrupted\n");
  _exit(128 + signal_number);
}

/// Prints the message, and then lets the signal have its default effect: SA_RESETHAND has removed
/// this handler, and the raised signal is blocked until this function returns.
extern "C" void print_crash(int signal_number) {
  remove_temporary_files();
  end_terminal_line();
  tell(crash_message(signal_number));
  raise(signal_number);
}

void handle(int signal_number, void (*handler)(int), int flags) {
  struct sigaction before {};
  sigaction(signal_number, nullptr, &before);
  if (before.sa_handler != SIG_DFL) {
    return;  // ignored (nohup, background job), or handled by a sanitizer
  }
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = flags;
  sigaction(signal_number, &action, nullptr);
}

/// Installs the crash handlers on a separate stack, because a stack overflow can be the crash.
void handle_crashes_on_another_stack() {
  alignas(16) static char memory[1 << 16];
  stack_t stack{};
  stack.ss_sp = memory;
  stack.ss_size = sizeof memory;
  sigaltstack(&stack, nullptr);
  for (const int signal_number : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
    handle(signal_number, print_crash, static_cast<int>(SA_RESETHAND) | SA_ONSTACK);
  }
}

}  // namespace

void handle_signals() {
  handle(SIGPIPE, SIG_IGN, 0);
  handle(SIGXFSZ, SIG_IGN, 0);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    handle(signal_number, end_on_request, SA_RESTART);
  }
  handle_crashes_on_another_stack();
}

PostponedEnd::PostponedEnd() {
  end_is_postponed = true;
}

PostponedEnd::~PostponedEnd() {
  end_is_postponed = false;
}

int PostponedEnd::signal_number() {
  return postponed_signal;
}

}  // namespace ibmfair::commands
