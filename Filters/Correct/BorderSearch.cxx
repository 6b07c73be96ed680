#include "BorderSearch.h"

#include "NodeConstraint.h"

namespace trim
{
namespace
{

/// Parameters by which a place may lie beyond the edges of a facet.
constexpr double BorderSlack = 1e-4;

}

bool LiesOn(const FacetSearch& facet, const Vec3& place, double distance)
{
  Vec3 on;
  return facet.FindInside(place, BorderSlack, on) && (on - place).norm() <= distance;
}

std::vector<int> BorderAround(const Band& band, const std::vector<int>& faces)
{
  return SideAround(band, faces, [&band](int, int other) { return band.Faces[other].Exterior; });
}

bool BorderSearch::Has(const Vec3& place, double distance)
{
  for (std::size_t i = 0; i < this->Around.size() || this->Widen(); ++i)
  {
    if (i == this->Facets.size())
    {
      this->Facets.reserve(this->Around.size()); // as facets are long to be moved
      this->Facets.emplace_back(Facet(this->TheBand, this->TheBand.Faces[this->Around[i]]));
    }
    if (LiesOn(this->Facets[i], place, distance))
    {
      return true;
    }
  }
  return false;
}

bool BorderSearch::Widen()
{
  if (this->Rings == 0)
  {
    return false;
  }
  --this->Rings;
  const std::size_t before = this->Around.size();
  this->Around = BorderAround(this->TheBand, this->Around);
  return this->Around.size() > before;
}

}
