/**
 * @file PagePool.h
 * @brief Keeps the memory of outputs that were freed for those of the next run.
 *
 * To hand over memory that was never in use takes the kernel longer than most of what is done with
 * it, and a trim that is repeated needs about as much as the outputs before had, which go.
 */
#ifndef PagePool_h
#define PagePool_h

#include <cstddef>
#include <mutex>
#include <vector>

namespace nurbs
{

/// Mappings that nobody uses. It keeps some only while there are users of it. All threads.
class PagePool
{
public:
  /// The one of the process, which lives as long as that.
  static PagePool& Get();

  /// A mapping of so many bytes, holding anything, from one about as large; null: there is none.
  void* Take(std::size_t size);

  /// Takes a mapping over; false: the caller has to free it.
  bool Keep(void* memory, std::size_t size);

  /// Gives all that is kept back to the kernel.
  void Empty();

  void Join();
  void Leave();
  /// Gives back what no run had a use for lately.
  void EndRun();

private:
  struct Block
  {
    void* Memory;
    std::size_t Size;
    int Age; ///< in runs
  };

  /// Unmaps those for which isKept(block) is false.
  template <typename IsKept>
  void Drop(const IsKept& isKept);

  std::mutex Lock;
  std::vector<Block> Blocks;
  int Users = 0;
};

/// Memory that holds anything, for what is written to throughout, if possible from the pool. Throws
/// if there is none.
void* TakePages(std::size_t bytes);
/// The same, filled with zeros.
void* TakeZeroPages(std::size_t bytes);
/// Frees what one of the two gave for so many bytes.
void GivePages(void* memory, std::size_t bytes);

/// Something that runs again and again. While it exists, what it frees is kept for it.
class PageUser
{
public:
  PageUser() { PagePool::Get().Join(); }
  ~PageUser() { PagePool::Get().Leave(); }
  PageUser(const PageUser&) = delete;
  void operator=(const PageUser&) = delete;

  /// To be called after each run.
  void EndRun() const { PagePool::Get().EndRun(); }
};

}

#endif
