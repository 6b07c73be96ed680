#include "CADChildProcess.h"

#include "CADLibrary.h"
#include "SurfaceBytes.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <new>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace nurbs
{
namespace
{
/// What the child sends: a kind, the size of what follows, and that.
enum class MessageKind : unsigned char
{
  Progress,
  Result
};
constexpr size_t HeaderSize = 1 + sizeof(std::uint64_t);

void PackNamed(Packer& packer, const NamedSurface& named)
{
  packer.PutText(named.Name);
  PackSurface(packer, named.Surface);
}

/// False if the bytes make no sense, or the surface is not valid.
bool UnpackNamed(Unpacker& unpacker, NamedSurface& named)
{
  named.Name = unpacker.TakeText();
  named.Surface = UnpackSurface(unpacker);
  return unpacker.Good && FindDefect(named.Surface).empty();
}

void PackCurve(Packer& packer, const FileCurve& curve)
{
  packer.PutText(curve.Name);
  packer.Put(curve.Tolerance);
  packer.Put(curve.Curve.Degree);
  packer.PutAll(curve.Curve.Knots);
  packer.PutAll(curve.Curve.Points);
}

/// False if the bytes make no sense, or the curve is not valid.
bool UnpackCurve(Unpacker& unpacker, FileCurve& curve)
{
  curve.Name = unpacker.TakeText();
  curve.Tolerance = unpacker.Take<double>();
  curve.Curve.Degree = unpacker.Take<int>();
  unpacker.TakeAll(curve.Curve.Knots);
  unpacker.TakeAll(curve.Curve.Points);
  return unpacker.Good && std::isfinite(curve.Tolerance) &&
    FindDefect(Extrude(curve.Curve, Vec3::UnitZ(), 0.0, 1.0).Surface).empty();
}

/// What a reader of CAD files returns: success, one line of text, and the things read.
template <typename Thing>
std::string PackResult(bool success, const std::string& error, const std::vector<Thing>& things,
  void (*pack)(Packer&, const Thing&))
{
  Packer packer;
  packer.Put<unsigned char>(success);
  packer.PutText(error);
  packer.Put<std::uint64_t>(things.size());
  for (const Thing& thing : things)
  {
    pack(packer, thing);
  }
  return packer.Bytes;
}

template <typename Thing>
bool UnpackResult(const std::string& bytes, bool& success, std::string& error,
  std::vector<Thing>& things, bool (*unpack)(Unpacker&, Thing&))
{
  Unpacker unpacker(bytes);
  success = unpacker.Take<unsigned char>() != 0;
  error = unpacker.TakeText();
  things.resize(unpacker.TakeCount(8));
  for (Thing& thing : things)
  {
    if (!unpack(unpacker, thing))
    {
      return false;
    }
  }
  return unpacker.Good;
}

bool WriteAll(int file, const char* data, size_t size)
{
  while (size > 0)
  {
    const ssize_t written = write(file, data, size);
    if (written < 0 && errno != EINTR)
    {
      return false;
    }
    data += std::max<ssize_t>(0, written);
    size -= static_cast<size_t>(std::max<ssize_t>(0, written));
  }
  return true;
}

bool Send(int file, MessageKind kind, const std::string& body)
{
  Packer packer;
  packer.Put(static_cast<unsigned char>(kind));
  packer.Put<std::uint64_t>(body.size());
  return WriteAll(file, packer.Bytes.data(), packer.Bytes.size()) &&
    WriteAll(file, body.data(), body.size());
}

/// Size of the file, in megabytes.
double Megabytes(const std::string& path)
{
  struct stat status;
  return stat(path.c_str(), &status) == 0 ? 1e-6 * static_cast<double>(status.st_size) : 0.0;
}

/// Processor time allowed unless another is asked for, in seconds.
double TimeLimit(const std::string& path)
{
  return 10.0 + 100.0 * Megabytes(path);
}

/// Ten times that by the clock: the machine may be busy, but a child may also wait for ever. No
/// more than so many seconds, which the clock can still count.
constexpr double Patience = 10.0;
constexpr double MostPatience = 1e9;

/// Memory that the child may take beyond what ParaView has, in megabytes: a wrong count in a
/// file must not take all that the machine has.
double MemoryLimit(const std::string& path)
{
  return 2000.0 + 200.0 * Megabytes(path);
}

void LimitMemory(double megabytes)
{
  long pages = 0;
  if (std::ifstream("/proc/self/statm") >> pages)
  {
    const double now = static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE));
    const rlim_t bytes = static_cast<rlim_t>(now + 1e6 * megabytes);
    const rlimit memory{ bytes, bytes };
    setrlimit(RLIMIT_AS, &memory);
  }
}

/// Status of a child that could not have the memory for its result.
constexpr int OutOfMemory = 3;

/// What the child does, given the readers and whom to tell of its progress: reads the file and
/// packs the result.
using ChildWork = std::function<std::string(const CADReaders&, const ReadProgress&)>;

/// The child: silent, with the system's own reaction to crashes, never returns.
[[noreturn]] void RunChild(int file, const std::string& path, double timeLimit,
  const CADReaders& readers, const ChildWork& work)
{
  for (int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGXCPU })
  {
    std::signal(signal, SIG_DFL);
  }
  // Nobody is left to read what comes if ParaView ends.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  const rlim_t seconds = static_cast<rlim_t>(std::ceil(timeLimit));
  const rlimit time{ seconds, seconds + 1 };
  setrlimit(RLIMIT_CPU, &time);
  LimitMemory(MemoryLimit(path));
  const int nothing = open("/dev/null", O_RDWR);
  for (int stream : { 0, 1, 2 })
  {
    dup2(nothing, stream);
  }
  auto progress = [file](double share)
  {
    Packer packer;
    packer.Put(share);
    return Send(file, MessageKind::Progress, packer.Bytes);
  };
  // Not exit(), and no exception to whatever is above: the parent's destructors are not the child's
  // to run.
  try
  {
    Send(file, MessageKind::Result, work(readers, progress));
    _exit(0);
  }
  catch (const std::bad_alloc&)
  {
    _exit(OutOfMemory);
  }
  catch (...)
  {
    std::abort();
  }
}

using Clock = std::chrono::steady_clock;

/// The parent's end of the pipe and the child behind it.
class Child
{
public:
  /// `seconds` by the clock, after which it is ended.
  Child(pid_t process, int file, double seconds)
    : Process(process)
    , File(file)
    , End(Clock::now() +
        std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds)))
  {
  }
  ~Child()
  {
    close(this->File);
    if (this->Process > 0)
    {
      kill(this->Process, SIGKILL);
      this->Wait(0);
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for the result and hands progress on; false if stopped or the child ended without.
  bool Receive(std::string& result, const ReadProgress& progress)
  {
    std::string bytes;
    double share = 0.0;
    while (true)
    {
      // Another process started meanwhile may hold the pipe open: look at the child too. Before
      // the pipe is looked at, so that all that an ended child has sent is read.
      const bool ended = this->Wait(WNOHANG);
      pollfd ready{ this->File, POLLIN, 0 };
      const int count = poll(&ready, 1, ended ? 0 : 100);
      const bool over = count == 0 ? ended : count > 0 && !this->ReadSome(bytes);
      while (this->TakeMessage(bytes, share, result))
      {
        if (!result.empty())
        {
          return true;
        }
      }
      this->Stopped = progress && !progress(share);
      if (this->Stopped || over)
      {
        return false;
      }
      if (!ended && Clock::now() > this->End)
      {
        this->Late = true;
        kill(this->Process, SIGKILL);
        return false;
      }
    }
  }

  /// How the child ended and what to do, for the message.
  std::string Describe()
  {
    const std::string advice = "; export it again from the CAD program";
    this->Wait(0);
    if (WIFEXITED(this->Status) && WEXITSTATUS(this->Status) == OutOfMemory)
    {
      return "takes more memory to read than it may: export less of the model, or coarser surfaces";
    }
    if (!WIFSIGNALED(this->Status))
    {
      return "could not be read: the reading process ended early" + advice;
    }
    const int signal = WTERMSIG(this->Status);
    if (signal == SIGXCPU || this->Late)
    {
      return "takes too long to read" + advice;
    }
    // Not by this process.
    if (signal == SIGKILL)
    {
      return "could not be read: the system ended the reading process, as it does when memory runs "
             "out; free memory and try again";
    }
    return std::string("makes OpenCASCADE crash (") + strsignal(signal) + ")" + advice;
  }
  bool Stopped = false;

private:
  bool ReadSome(std::string& bytes)
  {
    char buffer[65536];
    const ssize_t count = read(this->File, buffer, sizeof(buffer));
    if (count > 0)
    {
      bytes.append(buffer, static_cast<size_t>(count));
    }
    return count > 0 || (count < 0 && errno == EINTR);
  }

  /// Takes one whole message off the front; false if there is none yet.
  bool TakeMessage(std::string& bytes, double& share, std::string& result)
  {
    if (bytes.size() < HeaderSize)
    {
      return false;
    }
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + 1, sizeof(size));
    if (bytes.size() - HeaderSize < size)
    {
      return false;
    }
    const auto kind = static_cast<MessageKind>(bytes[0]);
    const std::string body = bytes.substr(HeaderSize, static_cast<size_t>(size));
    bytes.erase(0, HeaderSize + body.size());
    if (kind == MessageKind::Result)
    {
      result = body;
    }
    else
    {
      Unpacker unpacker(body);
      share = unpacker.Take<double>();
    }
    return true;
  }

  /// True if the child has ended, or ended before.
  bool Wait(int options)
  {
    pid_t ended = 0;
    while (this->Process > 0 && (ended = waitpid(this->Process, &this->Status, options)) < 0 &&
      errno == EINTR)
    {
    }
    if (ended != 0)
    {
      this->Process = 0;
    }
    return this->Process == 0;
  }

  pid_t Process;
  int File;
  Clock::time_point End;
  bool Late = false; ///< ended because of its time by the clock
  int Status = 0;
};

/// Forks a child for the work, with `seconds` of processor time (0: by the size of the file), and
/// reads what it makes as things.
template <typename Thing>
bool ReadInChild(const std::string& path, double seconds, const ChildWork& work,
  bool (*unpack)(Unpacker&, Thing&), std::vector<Thing>& things, std::string& error,
  const ReadProgress& progress)
{
  things.clear();
  error.clear();
  const std::string file = "CAD file \"" + path + "\" ";
  // Here, not in the child: it is done once then.
  const CADReaders* readers = LoadCADReaders(error);
  if (!readers)
  {
    error = file + "could not be read: " + error + "; build or install the plugin again";
    return false;
  }
  const double timeLimit = seconds > 0.0 ? seconds : TimeLimit(path);
  int ends[2] = { -1, -1 };
  const bool piped = pipe2(ends, O_CLOEXEC) == 0;
  const pid_t process = piped ? fork() : -1;
  if (process < 0)
  {
    error = file + "could not be read: no process can be started (" + std::strerror(errno) +
      "); free memory or processes and try again";
    for (int end : ends)
    {
      piped ? close(end) : 0;
    }
    return false;
  }
  if (process == 0)
  {
    close(ends[0]);
    RunChild(ends[1], path, timeLimit, *readers, work);
  }
  close(ends[1]);
  Child child(process, ends[0], std::min(Patience * timeLimit, MostPatience));
  std::string result;
  bool success = false;
  if (child.Receive(result, progress) && UnpackResult(result, success, error, things, unpack))
  {
    return success;
  }
  things.clear();
  error = child.Stopped ? std::string() : file + child.Describe();
  return false;
}
}

//------------------------------------------------------------------------------
bool ReadCADFileInChild(const std::string& path, double unitInMillimetres, bool joinBodies,
  std::vector<NamedSurface>& surfaces, std::string& error, double seconds,
  const ReadProgress& progress)
{
  double last = 0.0;
  const ReadProgress watched = [&](double share)
  {
    last = share;
    return !progress || progress(share);
  };
  const auto read = [&](bool join)
  {
    const ChildWork work = [&](const CADReaders& readers, const ReadProgress& report)
    {
      std::vector<NamedSurface> found;
      std::string text;
      const bool success = readers.ReadFile(path, unitInMillimetres, join, found, text, report);
      return PackResult(success, text, found, PackNamed);
    };
    return ReadInChild(path, seconds, work, UnpackNamed, surfaces, error, watched);
  };
  if (read(joinBodies))
  {
    return true;
  }
  const bool joining = joinBodies && last >= JoiningBegins && last < JoiningEnds;
  if (!joining || error.empty() || !read(false))
  {
    return false;
  }
  AddRemark(path,
    "its bodies could not be joined in the time and memory allowed: join those that touch in the "
    "CAD program, or raise TimeLimit",
    error);
  return true;
}

//------------------------------------------------------------------------------
bool ReadCADCurvesInChild(const std::string& path, double unitInMillimetres,
  std::vector<FileCurve>& curves, std::string& error, const ReadProgress& progress)
{
  const ChildWork work = [&](const CADReaders& readers, const ReadProgress& report)
  {
    std::vector<FileCurve> found;
    std::string text;
    const bool success = readers.ReadCurves(path, unitInMillimetres, found, text, report);
    return PackResult(success, text, found, PackCurve);
  };
  return ReadInChild(path, 0.0, work, UnpackCurve, curves, error, progress);
}
}
