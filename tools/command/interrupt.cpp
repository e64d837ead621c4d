#include "interrupt.h"

#include <csignal>

namespace {

volatile std::sig_atomic_t flag = 0;

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

void onInterrupt(int) {
  flag = 1;
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
}

bool interrupted() {
  return flag != 0;
}
