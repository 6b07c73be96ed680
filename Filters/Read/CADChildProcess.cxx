#include "CADChildProcess.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <type_traits>

#include <fcntl.h>
#include <poll.h>
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

/// Values one after the other, as they lie in memory: both ends are the same program.
class Packer
{
public:
  template <typename T>
  void Put(const T& value)
  {
    static_assert(std::is_arithmetic<T>::value, "plain values only");
    this->PutBytes(&value, sizeof(T));
  }
  void PutText(const std::string& text)
  {
    this->Put<std::uint64_t>(text.size());
    this->PutBytes(text.data(), text.size());
  }
  /// A vector of values or of fixed-size Eigen vectors of doubles.
  template <typename T>
  void PutAll(const std::vector<T>& values)
  {
    this->Put<std::uint64_t>(values.size());
    this->PutBytes(values.data(), values.size() * sizeof(T));
  }
  std::string Bytes;

private:
  void PutBytes(const void* data, size_t size)
  {
    if (size > 0)
    {
      this->Bytes.append(static_cast<const char*>(data), size);
    }
  }
};

/// The reverse of Packer. A child that runs wild may send anything: sizes are checked.
class Unpacker
{
public:
  explicit Unpacker(const std::string& bytes)
    : Bytes(bytes)
  {
  }
  template <typename T>
  T Take()
  {
    T value = T();
    this->TakeBytes(&value, sizeof(T));
    return value;
  }
  std::string TakeText()
  {
    std::string text(this->TakeCount(1), '\0');
    this->TakeBytes(&text[0], text.size());
    return text;
  }
  template <typename T>
  void TakeAll(std::vector<T>& values)
  {
    values.resize(this->TakeCount(sizeof(T)));
    this->TakeBytes(values.data(), values.size() * sizeof(T));
  }
  /// A number of things of at least `size` bytes each, which have to be there.
  size_t TakeCount(size_t size)
  {
    const std::uint64_t count = this->Take<std::uint64_t>();
    this->Good = this->Good && count <= (this->Bytes.size() - this->At) / size;
    return this->Good ? static_cast<size_t>(count) : 0;
  }
  bool Good = true;

private:
  void TakeBytes(void* data, size_t size)
  {
    this->Good = this->Good && size <= this->Bytes.size() - this->At;
    if (this->Good && size > 0)
    {
      std::memcpy(data, this->Bytes.data() + this->At, size);
      this->At += size;
    }
  }
  const std::string& Bytes;
  size_t At = 0;
};

std::string PackResult(
  bool success, const std::string& error, const std::vector<NamedSurface>& surfaces)
{
  Packer packer;
  packer.Put<unsigned char>(success);
  packer.PutText(error);
  packer.Put<std::uint64_t>(surfaces.size());
  for (const NamedSurface& named : surfaces)
  {
    const NurbsSurface& surface = named.Surface;
    packer.PutText(named.Name);
    for (int value : { surface.DegreeU, surface.DegreeV, surface.CountU, surface.CountV })
    {
      packer.Put(value);
    }
    packer.PutAll(surface.KnotsU);
    packer.PutAll(surface.KnotsV);
    packer.PutAll(surface.ControlPoints);
    packer.Put<std::uint64_t>(surface.TrimLoops.size());
    for (const std::vector<Vec2>& loop : surface.TrimLoops)
    {
      packer.PutAll(loop);
    }
  }
  return packer.Bytes;
}

/// False if the bytes make no sense, or a surface is not valid.
bool UnpackResult(
  const std::string& bytes, bool& success, std::string& error, std::vector<NamedSurface>& surfaces)
{
  Unpacker unpacker(bytes);
  success = unpacker.Take<unsigned char>() != 0;
  error = unpacker.TakeText();
  surfaces.resize(unpacker.TakeCount(8));
  for (NamedSurface& named : surfaces)
  {
    NurbsSurface& surface = named.Surface;
    named.Name = unpacker.TakeText();
    for (int* value : { &surface.DegreeU, &surface.DegreeV, &surface.CountU, &surface.CountV })
    {
      *value = unpacker.Take<int>();
    }
    unpacker.TakeAll(surface.KnotsU);
    unpacker.TakeAll(surface.KnotsV);
    unpacker.TakeAll(surface.ControlPoints);
    surface.TrimLoops.resize(unpacker.TakeCount(8));
    for (std::vector<Vec2>& loop : surface.TrimLoops)
    {
      unpacker.TakeAll(loop);
    }
    if (!unpacker.Good || !FindDefect(surface).empty())
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

/// Processor time allowed, in seconds.
rlim_t TimeLimit(const std::string& path)
{
  struct stat status;
  const bool known = stat(path.c_str(), &status) == 0;
  return 120 + (known ? static_cast<rlim_t>(60 * (status.st_size / 1000000)) : 0);
}

/// The child: silent, with the system's own reaction to crashes, never returns.
[[noreturn]] void RunChild(int file, const std::string& path, double unitInMillimetres)
{
  for (int signal : { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTERM, SIGINT, SIGXCPU })
  {
    std::signal(signal, SIG_DFL);
  }
  const rlimit noCore{ 0, 0 };
  setrlimit(RLIMIT_CORE, &noCore);
  const rlim_t seconds = TimeLimit(path);
  const rlimit time{ seconds, seconds + 1 };
  setrlimit(RLIMIT_CPU, &time);
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
  std::vector<NamedSurface> surfaces;
  std::string error;
  const bool success = ReadCADFile(path, unitInMillimetres, surfaces, error, progress);
  Send(file, MessageKind::Result, PackResult(success, error, surfaces));
  // Not exit(): the parent's destructors are not the child's to run.
  _exit(0);
}

/// The parent's end of the pipe and the child behind it.
class Child
{
public:
  Child(pid_t process, int file)
    : Process(process)
    , File(file)
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
      pollfd ready{ this->File, POLLIN, 0 };
      const int count = poll(&ready, 1, 100);
      // Another process started meanwhile may hold the pipe open: look at the child too.
      const bool ended = count == 0 && this->Wait(WNOHANG);
      if (count > 0 && !this->ReadSome(bytes))
      {
        return false;
      }
      while (this->TakeMessage(bytes, share, result))
      {
        if (!result.empty())
        {
          return true;
        }
      }
      this->Stopped = progress && !progress(share);
      if (this->Stopped || ended)
      {
        return false;
      }
    }
  }

  /// How the child ended, for the message.
  std::string Describe()
  {
    this->Wait(0);
    std::ostringstream text;
    if (WIFSIGNALED(this->Status) &&
      (WTERMSIG(this->Status) == SIGXCPU || WTERMSIG(this->Status) == SIGKILL))
    {
      text << "takes too long to read";
    }
    else if (WIFSIGNALED(this->Status))
    {
      text << "makes OpenCASCADE crash (" << strsignal(WTERMSIG(this->Status)) << ")";
    }
    else
    {
      text << "could not be read: the reading process ended early";
    }
    return text.str();
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
  int Status = 0;
};
}

//------------------------------------------------------------------------------
bool ReadCADFileInChild(const std::string& path, double unitInMillimetres,
  std::vector<NamedSurface>& surfaces, std::string& error, const ReadProgress& progress)
{
  surfaces.clear();
  error.clear();
  const std::string file = "CAD file \"" + path + "\" ";
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
    RunChild(ends[1], path, unitInMillimetres);
  }
  close(ends[1]);
  Child child(process, ends[0]);
  std::string result;
  bool success = false;
  if (child.Receive(result, progress) && UnpackResult(result, success, error, surfaces))
  {
    return success;
  }
  surfaces.clear();
  error = child.Stopped ? std::string()
                        : file + child.Describe() + "; export it again from the CAD program";
  return false;
}
}
