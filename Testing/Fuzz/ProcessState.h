/**
 * @file ProcessState.h
 * @brief What a process must not gather while it reads one file after the other, and a watch
 * that ends it when one takes too long.
 */
#ifndef ProcessState_h
#define ProcessState_h

#include <string>

namespace fuzz
{
/// Open file descriptors of this process.
int OpenFiles();

/// True if no child, running or ended, is left.
bool HasNoChildren();

/// Resident memory, megabytes.
double ResidentMegabytes();

/// Seconds of wall clock since some moment.
double Now();

/// True once SIGTERM or SIGINT has come: a long series then prints what it has.
bool IsStopped();

/**
 * Ends the process with status 3 and a line that names `what` if it is not called again, or
 * disarmed, within so many seconds; a crash until then names it too.
 */
void Watch(const std::string& what, unsigned seconds);
void Unwatch();
}

#endif
