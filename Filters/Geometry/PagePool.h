/**
 * @file PagePool.h
 * @brief Keeps memory that was freed, of outputs and of long arrays at work, for the next run.
 *
 * To hand over memory that was never in use takes the kernel longer than most of what is done with
 * it, on a virtual machine several times as long where the host took it back in between; and a
 * trim that is repeated needs about as much as the one before had, whose outputs go.
 */
#ifndef PagePool_h
#define PagePool_h

#include <cstddef>
#include <mutex>
#include <vector>

namespace nurbs
{

/// What memory was for.
enum class PageUse
{
  Output, ///< all of it is kept
  Work    ///< at 10M elements more than the outputs, one after the other: only the last is kept
};

/// Mappings that nobody uses. It keeps some only while there are users of it. All threads.
class PagePool
{
public:
  /// The one of the process, which lives as long as that.
  static PagePool& Get();

  /// A mapping of so many bytes, holding anything, from one about as large; null: there is none.
  void* Take(std::size_t size);

  /// Takes a mapping over; false: the caller has to free it.
  bool Keep(void* memory, std::size_t size, PageUse use);

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
    PageUse Use;
    int Age; ///< in runs
  };

  /// Unmaps those for which isKept(block) is false; the last that came are asked first.
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
/// How memory from the pool is filled with zeros: by std::memset, unless somebody has threads.
void SetZeroFill(void (*fill)(void* memory, std::size_t bytes));
/// Frees what one of the two gave for so many bytes.
void GivePages(void* memory, std::size_t bytes, PageUse use);

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
