#include "interrupt.h"

#include <csignal>

namespace {

volatile std::sig_atomic_t flag = 0;

void onInterrupt(int) {
  flag = 1;
}

}  // namespace

void catchInterrupt() {
  struct sigaction action = {};
  action.sa_handler = onInterrupt;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
}

bool interrupted() {
  return flag != 0;
}
