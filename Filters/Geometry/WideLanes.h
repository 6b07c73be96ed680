/**
 * @file WideLanes.h
 * @brief Registers twice as wide as every processor of the architecture has, where the one at hand
 * has such.
 */
#ifndef WideLanes_h
#define WideLanes_h

#include <type_traits>

// Sanitizers are not ready for variants of a function.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) &&                             \
  !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define NURBSTRIM_WIDE_LANES
#endif

namespace nurbs
{
#ifdef NURBSTRIM_WIDE_LANES

namespace detail
{
template <typename Action>
__attribute__((target("avx2"), flatten)) void CallWide(const Action& action)
{
  action(std::true_type());
}
}

/**
 * Calls action(std::true_type()), compiled with all that it calls for a processor with such
 * registers, or on others action(std::false_type()). Both round alike, as neither multiplies and
 * adds in one step.
 */
template <typename Action>
inline void WithWideLanes(const Action& action)
{
  static const bool isWide = __builtin_cpu_supports("avx2");
  isWide ? detail::CallWide(action) : action(std::false_type());
}

#else

template <typename Action>
inline void WithWideLanes(const Action& action)
{
  action(std::false_type());
}

#endif
}

#endif
