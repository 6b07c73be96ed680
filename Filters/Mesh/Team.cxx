#include "Team.h"

#include <boost/asio/post.hpp>
#include <boost/asio/thread_pool.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>

namespace trim
{
namespace
{

/// Of this thread.
thread_local Team* Own = nullptr;
thread_local bool InLoop = false;

}

/// Those beside the caller.
class Team::Others : public boost::asio::thread_pool
{
public:
  using boost::asio::thread_pool::thread_pool;
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
  const Action& Call; ///< not to be used when closed
  const Id Last, Grain;
  std::atomic<Id> Next;
  std::mutex Lock;
  std::condition_variable Left;
  int Inside = 0; ///< threads beside the caller
  bool Closed = false;
  std::exception_ptr Failure;

  Loop(Id first, Id last, Id grain, const Action& call)
    : Call(call)
    , Last(last)
    , Grain(grain)
    , Next(first)
  {
  }

  void Work(Team* team)
  {
    const Member member(team);
    try
    {
      for (Id begin; (begin = this->Next.fetch_add(this->Grain)) < this->Last;)
      {
        this->Call(begin, std::min(this->Last, begin + this->Grain));
      }
    }
    catch (...)
    {
      this->Next = this->Last;
      const std::lock_guard<std::mutex> locked(this->Lock);
      if (!this->Failure)
      {
        this->Failure = std::current_exception();
      }
    }
  }

  /// For those beside the caller.
  void Join(Team* team)
  {
    {
      const std::lock_guard<std::mutex> locked(this->Lock);
      if (this->Closed)
      {
        return;
      }
      ++this->Inside;
    }
    this->Work(team);
    const std::lock_guard<std::mutex> locked(this->Lock);
    --this->Inside;
    this->Left.notify_one();
  }

  /// Nobody is in it any more.
  void Close()
  {
    std::unique_lock<std::mutex> locked(this->Lock);
    this->Closed = true;
    this->Left.wait(locked, [this] { return this->Inside == 0; });
  }
};

Team::Team(int threads)
  : Size(threads)
{
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
    this->Pool->join();
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
  if (InLoop || piece >= count)
  {
    action(first, last);
    return;
  }
  const auto loop = std::make_shared<Loop>(first, last, piece, action);
  const Id helpers = std::min<Id>(this->Size, (count + piece - 1) / piece) - 1;
  for (Id i = 0; i < helpers; ++i)
  {
    boost::asio::post(*this->Pool, [loop, this] { loop->Join(this); });
  }
  loop->Work(this);
  loop->Close();
  if (loop->Failure)
  {
    std::rethrow_exception(loop->Failure);
  }
}

}
