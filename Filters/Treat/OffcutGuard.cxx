#include "OffcutGuard.h"

#include <algorithm>

namespace trim
{

OffcutGuard::OffcutGuard(
  const Band& band, const BandQuality& quality, const TrimmedBand& kept, Offcut& offcut)
  : TheBand(band)
  , Quality(quality)
  , Kept(kept)
  , Rest(offcut)
  , Users(CountUsers(band, kept))
{
}

bool OffcutGuard::Stands(int node) const
{
  const auto elements = this->TheBand.ElementsOfNode(node);
  return std::all_of(elements.begin(), elements.end(),
    [this](int e)
    {
      auto part = std::lower_bound(this->Rest.Elements.begin(), this->Rest.Elements.end(), e,
        [](const OffcutElement& element, int of) { return element.Element < of; });
      bool stands = true;
      for (; stands && part != this->Rest.Elements.end() && part->Element == e; ++part)
      {
        stands = this->Stands(*part);
      }
      return stands;
    });
}

bool OffcutGuard::Stands(const OffcutElement& element) const
{
  const ElementPoints before = PointsOf(this->Rest, element);
  ElementPoints now = before;
  for (int i = 0; i < element.Count; ++i)
  {
    const int node = element.Node[i];
    now[i] = this->Users[node] > 0 ? this->Kept.NodeMoves.Position[node] : now[i];
  }
  return !this->Quality.Spoils(element.Element, now, element.Count) &&
    (!this->Quality.FallsBelowFloor(element.Element, now, element.Count) ||
      ScaledJacobian(now, element.Count) >= ScaledJacobian(before, element.Count));
}

void OffcutGuard::Follow()
{
  const Moves& moves = this->Kept.NodeMoves;
  for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
  {
    if (this->Users[n] > 0)
    {
      this->Rest.NodeMoves.Position[n] = moves.Position[n];
      this->Rest.NodeMoves.Applied[n] = moves.Applied[n];
      this->Rest.NodeMoves.Left[n] = moves.Left[n];
    }
  }
}

}
