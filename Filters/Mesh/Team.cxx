#include "Team.h"

#include "PagePool.h"
#include "PageVector.h"
#include "Runs.h"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// Of this thread.
thread_local Team* Own = nullptr;
thread_local bool InLoop = false;

}

/// Those beside the caller: as many as were asked for, or as the system gives. A pool of asio's own
/// throws where that is none, and waits for ever where it is some.
class Team::Others
{
public:
  explicit Others(int most)
    : Context(most)
    , Open(Context.get_executor())
  {
    this->Threads.reserve(most);
    try
    {
      for (int i = 0; i < most; ++i)
      {
        this->Threads.emplace_back([this] { this->Context.run(); });
      }
    }
    catch (const std::system_error&)
    {
      // Who is there does the work.
    }
  }
  ~Others()
  {
    this->Open.reset();
    for (std::thread& thread : this->Threads)
    {
      thread.join();
    }
  }
  Others(const Others&) = delete;
  void operator=(const Others&) = delete;

  template <typename Task>
  void Ask(Task&& task)
  {
    boost::asio::post(this->Context, std::forward<Task>(task));
  }

private:
  boost::asio::io_context Context;
  boost::asio::executor_work_guard<boost::asio::io_context::executor_type> Open;
  std::vector<std::thread> Threads;
};

/// This thread's part in a loop.
class Team::Member
{
public:
  explicit Member(Team* team)
    : Before(Own)
  {
    Own = team;
    InLoop = true;
  }
  ~Member()
  {
    Own = this->Before;
    InLoop = false;
  }
  Member(const Member&) = delete;
  void operator=(const Member&) = delete;

private:
  Team* Before;
};

/// A loop; whoever comes when it is closed has nothing to do with it.
struct Team::Loop
{
  /// Pieces of the range for one thread; when it has done them it helps the others. Far from each
  /// other two threads seldom ask the kernel for the same page of memory, which both would clear.
  struct alignas(nurbs::CacheLine) Part
  {
    std::atomic<Id> Next{ 0 };
    Id End = 0;
  };

  const Action& Call;                ///< not to be used when closed
  const std::function<void()>& Look; ///< the caller's
  const Id First, Last, Grain;
  std::vector<Part> Parts;
  std::mutex Lock;
  std::condition_variable Left;
  int Entered = 1, Inside = 0; ///< threads, with the caller; those beside it
  bool Closed = false;
  std::exception_ptr Failure;

  Loop(
    Id first, Id last, Id grain, int threads, const Action& call, const std::function<void()>& look)
    : Call(call)
    , Look(look)
    , First(first)
    , Last(last)
    , Grain(grain)
    , Parts(threads)
  {
    const Id pieces = NumberOfRuns(last - first, grain);
    for (int i = 0; i < threads; ++i)
    {
      this->Parts[i].Next = pieces * i / threads;
      this->Parts[i].End = pieces * (i + 1) / threads;
    }
  }

  /// Of a thread, the `place`th in the loop.
  void Work(Team* team, int place)
  {
    const Member member(team);
    try
    {
      for (std::size_t i = 0; i < this->Parts.size(); ++i)
      {
        this->WorkOn(this->Parts[(place + i) % this->Parts.size()], place == 0 && this->Look);
      }
    }
    catch (...)
    {
      for (Part& part : this->Parts)
      {
        part.Next = part.End;
      }
      const std::lock_guard<std::mutex> locked(this->Lock);
      if (!this->Failure)
      {
        this->Failure = std::current_exception();
      }
    }
  }
  void WorkOn(Part& part, bool looks)
  {
    for (Id piece; (piece = part.Next.fetch_add(1)) < part.End;)
    {
      if (looks)
      {
        this->Look();
      }
      const Id begin = this->First + piece * this->Grain;
      this->Call(begin, std::min(this->Last, begin + this->Grain));
    }
  }

  /// For those beside the caller.
  void Join(Team* team)
  {
    int place = 0;
    {
      const std::lock_guard<std::mutex> locked(this->Lock);
      if (this->Closed)
      {
        return;
      }
      place = this->Entered++;
      ++this->Inside;
    }
    this->Work(team, place);
    const std::lock_guard<std::mutex> locked(this->Lock);
    --this->Inside;
    this->Left.notify_one();
  }

  /// Nobody is in it any more.
  void Close()
  {
    std::unique_lock<std::mutex> locked(this->Lock);
    this->Closed = true;
    const auto empty = [this] { return this->Inside == 0; };
    while (this->Look && !this->Left.wait_for(locked, std::chrono::milliseconds(50), empty))
    {
      locked.unlock();
      this->Look();
      locked.lock();
    }
    this->Left.wait(locked, empty);
  }

  /// Closes a loop also where no more threads can be asked.
  struct Closing
  {
    Loop& Own;
    ~Closing() { this->Own.Close(); }
  };
};

namespace
{

/// By the calling thread's team, if it has one.
void FillZeros(void* memory, std::size_t bytes)
{
  auto* const begin = static_cast<char*>(memory);
  const auto fill = [begin](Id first, Id last) { std::memset(begin + first, 0, last - first); };
  constexpr Id Grain = 1 << 19; // less takes no longer than to call the others
  Team* const team = Team::Current();
  team ? team->For(0, static_cast<Id>(bytes), Grain, fill) : fill(0, static_cast<Id>(bytes));
}

}

Team::Team(int threads)
  : Size(threads)
{
  nurbs::SetZeroFill(&FillZeros);
  if (threads > 1 && !Own)
  {
    this->Pool = std::make_unique<Others>(threads - 1);
    Own = this;
  }
}

Team::~Team()
{
  if (this->Pool)
  {
    Own = nullptr;
  }
}

int Team::SizeForBackend()
{
  const bool starts =
    std::string(vtkSMPTools::GetBackend()) == "STDThread" && !vtkSMPTools::IsParallelScope();
  return starts ? vtkSMPTools::GetEstimatedNumberOfThreads() : 1;
}

Team* Team::Current()
{
  return Own;
}

void Team::For(Id first, Id last, Id grain, const Action& action)
{
  const Id count = last - first;
  if (count <= 0)
  {
    return;
  }
  const Id piece = grain > 0 ? grain : std::max<Id>(1, count / (4 * this->Size));
  if (this->Look && std::this_thread::get_id() == this->Caller)
  {
    this->Look();
  }
  if (InLoop || piece >= count)
  {
    action(first, last);
    return;
  }
  const auto threads = static_cast<int>(std::min<Id>(this->Size, NumberOfRuns(count, piece)));
  const auto loop = std::make_shared<Loop>(first, last, piece, threads, action, this->Look);
  {
    const Loop::Closing closing{ *loop };
    for (int i = 1; i < threads; ++i)
    {
      this->Pool->Ask([loop, this] { loop->Join(this); });
    }
    loop->Work(this, 0);
  }
  if (loop->Failure)
  {
    std::rethrow_exception(loop->Failure);
  }
}

int ThreadsForLoops()
{
  if (Own)
  {
    return InLoop ? 1 : Own->Size;
  }
  return vtkSMPTools::IsParallelScope() ? 1 : vtkSMPTools::GetEstimatedNumberOfThreads();
}

}
