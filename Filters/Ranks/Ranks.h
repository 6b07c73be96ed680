/**
 * @file Ranks.h
 * @brief What the stages need of the other processes when the grid lies in pieces, one a rank.
 *
 * Every function here but the first three is collective: all ranks call it, in the same order.
 * All ranks get the same answer. This class alone is the one rank of a run without others.
 */
#ifndef Ranks_h
#define Ranks_h

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace trim
{

/// Thrown by all ranks alike where together they have more to gather than one message holds.
struct TooMuchToGather : std::length_error
{
  using std::length_error::length_error;
};

class Ranks
{
public:
  Ranks() = default;
  virtual ~Ranks() = default;
  Ranks(const Ranks&) = delete;
  void operator=(const Ranks&) = delete;

  virtual int Count() const { return 1; }
  virtual int Rank() const { return 0; }
  bool Alone() const { return this->Count() == 1; }

  /// The lists of all ranks, rank by rank. Throws TooMuchToGather.
  template <typename T>
  std::vector<T> Gather(const std::vector<T>& mine) const
  {
    std::vector<std::size_t> ends;
    return this->Gather(mine, ends);
  }

  /// @param[out] ends one past the last item of each rank.
  template <typename T>
  std::vector<T> Gather(const std::vector<T>& mine, std::vector<std::size_t>& ends) const
  {
    static_assert(std::is_trivially_copyable<T>::value, "sent as bytes");
    if (this->Alone())
    {
      ends.assign(1, mine.size());
      return mine;
    }
    std::vector<char> bytes(mine.size() * sizeof(T));
    if (!mine.empty())
    {
      std::memcpy(bytes.data(), mine.data(), bytes.size());
    }
    const std::vector<char> all = this->GatherBytes(bytes, ends);
    for (auto& end : ends)
    {
      end /= sizeof(T);
    }
    std::vector<T> items(all.size() / sizeof(T));
    if (!items.empty())
    {
      std::memcpy(items.data(), all.data(), all.size());
    }
    return items;
  }

  template <typename T>
  T Largest(T mine) const
  {
    return this->Largest(std::array<T, 1>{ mine })[0];
  }

  /// The same for several values in one message.
  template <typename T, std::size_t N>
  std::array<T, N> Largest(const std::array<T, N>& mine) const
  {
    const auto all = this->Gather(std::vector<std::array<T, N>>{ mine });
    std::array<T, N> largest = all.front();
    for (const auto& values : all)
    {
      std::transform(largest.begin(), largest.end(), values.begin(), largest.begin(),
        [](const T& a, const T& b) { return std::max(a, b); });
    }
    return largest;
  }

  template <typename T>
  T Sum(T mine) const
  {
    T sum = T(0);
    for (const T value : this->Gather(std::vector<T>{ mine }))
    {
      sum += value;
    }
    return sum;
  }

  bool Any(bool mine) const { return this->Largest(mine); }

  template <std::size_t N>
  std::array<bool, N> Any(const std::array<bool, N>& mine) const
  {
    return this->Largest(mine);
  }

  /// The text of the first rank that has one; empty if none has.
  std::string FirstText(const std::string& mine) const
  {
    std::vector<std::size_t> ends;
    const auto all = this->Gather(std::vector<char>(mine.begin(), mine.end()), ends);
    const auto first =
      std::find_if(ends.begin(), ends.end(), [](std::size_t end) { return end > 0; });
    return first == ends.end() ? std::string() : std::string(all.data(), *first);
  }

protected:
  /// The bytes of all ranks, rank by rank, and where those of each end.
  virtual std::vector<char> GatherBytes(
    const std::vector<char>& mine, std::vector<std::size_t>& ends) const
  {
    ends.assign(1, mine.size());
    return mine;
  }
};

}

#endif
