#include "bench/interrupt.hpp"

#include <csignal>
#include <thread>

#include <seam/whole_file.hpp>

namespace seam {

namespace {

bool is_ignored(int signal) {
  struct sigaction action {};
  sigaction(signal, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

void wait_and_clear_up(sigset_t signals) {
  int signal = 0;
  sigwait(&signals, &signal);
  PartFile::discard_all();
  std::raise(signal);
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

}  // namespace

void clear_up_when_interrupted() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    if (!is_ignored(signal)) sigaddset(&signals, signal);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread(wait_and_clear_up, signals).detach();
}

}  // namespace seam
