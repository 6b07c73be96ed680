/**
 * @file Random.h
 * @brief Random numbers that are the same for one seed and number, whatever ran before.
 */
#ifndef Random_h
#define Random_h

#include <cstddef>
#include <random>
#include <vector>

namespace fuzz
{
class Random
{
public:
  Random(unsigned seed, unsigned number)
  {
    std::seed_seq sequence{ seed, number };
    this->Engine.seed(sequence);
  }
  /// 0 .. count - 1; 0 if there is nothing to choose from.
  std::size_t Below(std::size_t count) { return count > 0 ? this->Engine() % count : 0; }
  bool OneIn(std::size_t count) { return this->Below(count) == 0; }
  double Between(double low, double high)
  {
    return low + (high - low) * this->Engine() / 0xffffffffu;
  }
  template <typename T>
  const T& Pick(const std::vector<T>& from)
  {
    return from[this->Below(from.size())];
  }

private:
  std::mt19937 Engine;
};
}

#endif
