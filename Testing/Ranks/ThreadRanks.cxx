#include "ThreadRanks.h"

#include <vtkAbstractArray.h>
#include <vtkCommunicator.h>
#include <vtkDummyController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <tuple>

namespace judge
{
namespace
{
/// Messages under way between all ranks, by sender, receiver and tag.
struct Post
{
  std::mutex Lock;
  std::condition_variable Arrived;
  std::map<std::tuple<int, int, int>, std::deque<std::vector<char>>> Boxes;
};

class ThreadCommunicator : public vtkCommunicator
{
public:
  static ThreadCommunicator* New();
  vtkTypeMacro(ThreadCommunicator, vtkCommunicator);

  void Join(std::shared_ptr<Post> post, int rank, int count)
  {
    this->Mail = std::move(post);
    this->MaximumNumberOfProcesses = count;
    this->NumberOfProcesses = count;
    this->LocalProcessId = rank;
  }

  int SendVoidArray(const void* data, vtkIdType length, int type, int remote, int tag) override
  {
    const auto* bytes = static_cast<const char*>(data);
    const vtkIdType size = length * vtkAbstractArray::GetDataTypeSize(type);
    const std::lock_guard<std::mutex> guard(this->Mail->Lock);
    this->Mail->Boxes[{ this->LocalProcessId, remote, tag }].emplace_back(bytes, bytes + size);
    this->Mail->Arrived.notify_all();
    return 1;
  }

  int ReceiveVoidArray(void* data, vtkIdType length, int type, int remote, int tag) override
  {
    std::unique_lock<std::mutex> guard(this->Mail->Lock);
    auto& box = this->Mail->Boxes[{ remote, this->LocalProcessId, tag }];
    this->Mail->Arrived.wait(guard, [&box] { return !box.empty(); });
    const std::vector<char> message = std::move(box.front());
    box.pop_front();
    const std::size_t room = length * vtkAbstractArray::GetDataTypeSize(type);
    if (!message.empty())
    {
      std::memcpy(data, message.data(), std::min(room, message.size()));
    }
    this->Count = static_cast<vtkIdType>(message.size()) / vtkAbstractArray::GetDataTypeSize(type);
    return 1;
  }

private:
  std::shared_ptr<Post> Mail;
};
vtkStandardNewMacro(ThreadCommunicator);
}

std::vector<vtkSmartPointer<vtkMultiProcessController>> MakeThreadRanks(int count)
{
  const auto post = std::make_shared<Post>();
  std::vector<vtkSmartPointer<vtkMultiProcessController>> controllers;
  for (int rank = 0; rank < count; ++rank)
  {
    vtkNew<ThreadCommunicator> communicator;
    communicator->Join(post, rank, count);
    vtkNew<vtkDummyController> controller;
    controller->SetCommunicator(communicator);
    controllers.emplace_back(controller);
  }
  return controllers;
}

void RunRanks(int count, const std::function<void(int)>& work)
{
  std::vector<std::thread> threads;
  for (int rank = 1; rank < count; ++rank)
  {
    threads.emplace_back(work, rank);
  }
  work(0);
  for (auto& thread : threads)
  {
    thread.join();
  }
}
}
