#include "ProcessState.h"

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fuzz
{
namespace
{
char Watched[200];
volatile std::sig_atomic_t StopAsked = 0;

/// Says what was being done when a signal came. Only what a signal handler may call.
void Report(const char* text)
{
  const bool written = write(2, text, std::strlen(text)) > 0 &&
    write(2, Watched, std::strlen(Watched)) > 0 && write(2, "\n", 1) > 0;
  if (!written)
  {
    _exit(4);
  }
}

void OnAlarm(int)
{
  Report("FAIL takes too long: ");
  _exit(3);
}

void OnCrash(int signal)
{
  Report("FAIL crash: ");
  std::signal(signal, SIG_DFL);
  raise(signal);
}
}

int OpenFiles()
{
  int count = 0;
  DIR* directory = opendir("/proc/self/fd");
  while (directory && readdir(directory))
  {
    ++count;
  }
  if (directory)
  {
    closedir(directory);
  }
  return count;
}

bool HasNoChildren()
{
  return waitpid(-1, nullptr, WNOHANG) < 0;
}

bool IsStopped()
{
  static const bool ready = []
  {
    for (const int signal : { SIGTERM, SIGINT })
    {
      std::signal(signal, [](int) { StopAsked = 1; });
    }
    return true;
  }();
  return ready && StopAsked != 0;
}

double ResidentMegabytes()
{
  long size = 0;
  long resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

double Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Watch(const std::string& what, unsigned seconds)
{
  std::strncpy(Watched, what.c_str(), sizeof(Watched) - 1);
  std::signal(SIGALRM, OnAlarm);
#ifndef __SANITIZE_ADDRESS__
  for (const int signal : { SIGSEGV, SIGABRT, SIGFPE, SIGBUS })
  {
    std::signal(signal, OnCrash);
  }
#endif
  alarm(seconds);
}

void Unwatch()
{
  alarm(0);
}
}
