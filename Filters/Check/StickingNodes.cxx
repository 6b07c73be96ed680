#include "StickingNodes.h"

#include "BandPlace.h"
#include "NodeMover.h"
#include "Runs.h"

#include <algorithm>
#include <vector>

namespace trim
{

bool SticksOut(const TrimBand& near, const nurbs::TrimmingSurface& surface, double precision)
{
  const Band& band = near.Mesh;
  const NodeMover mover(band, near.Structure, surface, precision);
  const Moves& moves = near.Trimmed.NodeMoves;
  const std::vector<int> users = CountUsers(band, near.Trimmed);
  std::vector<char> outside(band.NumberOfNodes(), 0);
  ForAll(band.NumberOfNodes(),
    [&](int n)
    {
      outside[n] = users[n] > 0 && moves.Applied[n] != Correction::None &&
        LiesOutside(band, n, moves.Position[n]) &&
        mover.FreedomOf(n).Constraint.Kind == ConstraintKind::Free;
    });
  return std::any_of(outside.begin(), outside.end(), [](char own) { return own != 0; });
}

}
