#include "interrupt.h"

#include <csignal>

namespace {

volatile std::sig_atomic_t received = 0;  // signal received; 0: none

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

void onInterrupt(int signal) {
  received = signal;
}

void handleWith(void (*handler)(int)) {
  struct sigaction action = {}, before = {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  for (const int signal : signals) {
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

}  // namespace

void catchInterrupt() {
  handleWith(onInterrupt);
}

void releaseInterrupt() {
  handleWith(SIG_DFL);
  if (received != 0) std::raise(received);
}

bool interrupted() {
  return received != 0;
}
