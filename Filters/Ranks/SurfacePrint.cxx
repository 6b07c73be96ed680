#include "SurfacePrint.h"

#include <cstring>

namespace trim
{
namespace
{

/// Fowler, Noll and Vo's hash (FNV-1a), word by word.
class Print
{
public:
  void Add(std::uint64_t word) { this->Value = (this->Value ^ word) * 0x100000001b3ull; }
  void Add(const double* values, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      std::uint64_t word;
      std::memcpy(&word, values + i, sizeof(word));
      // The multiplication carries upwards only: fold the high half in.
      this->Add(word ^ (word >> 32));
    }
  }
  std::uint64_t Value = 0xcbf29ce484222325ull;
};

}

std::uint64_t PrintOf(const std::vector<nurbs::NurbsSurface>& faces)
{
  Print print;
  for (const auto& face : faces)
  {
    for (const int number : { face.DegreeU, face.DegreeV, face.CountU, face.CountV })
    {
      print.Add(static_cast<std::uint64_t>(number));
    }
    print.Add(face.KnotsU.data(), face.KnotsU.size());
    print.Add(face.KnotsV.data(), face.KnotsV.size());
    for (const auto& point : face.ControlPoints)
    {
      print.Add(point.data(), 4);
    }
    for (const auto& loop : face.TrimLoops)
    {
      print.Add(loop.size());
      for (const auto& corner : loop)
      {
        print.Add(corner.data(), 2);
      }
    }
  }
  return print.Value;
}

}
