/**
 * @file Expect.h
 * @brief What a test program expects, and how often it was wrong.
 */
#ifndef Expect_h
#define Expect_h

#include <cstdio>
#include <string>

namespace judge
{

/// Failures of the test program so far.
inline int Wrong = 0;

inline void Expect(bool condition, const std::string& what)
{
  if (!condition)
  {
    std::printf("FAIL %s\n", what.c_str());
    ++Wrong;
  }
}

}

#endif
