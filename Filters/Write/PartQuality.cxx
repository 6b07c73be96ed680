#include "PartQuality.h"

#include "ArrayNames.h"
#include "Jacobian.h"
#include "OrderlessSum.h"
#include "Team.h"

#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace trim
{

BandShapes ShapesOfKept(const TrimResult& result)
{
  if (!result.Near)
  {
    return {};
  }
  const TrimBand& near = *result.Near;
  const auto shapeOf = [&near](int e)
  { return near.Trimmed.Kept[e] ? FinalShape(near.Mesh, near.Trimmed, e) : FinalElement(); };
  return { near.Mesh.NumberOfElements(), shapeOf, [](int e) { return e; },
    &near.Trimmed.NodeMoves };
}

BandShapes ShapesOfOffcut(const TrimResult& result)
{
  if (!result.Near)
  {
    return {};
  }
  const TrimBand& near = *result.Near;
  const auto shapeOf = [&near](int i) -> FinalElement
  {
    const OffcutElement& element = near.Rest.Elements[i];
    return { element.Count, element.Node, PointsOf(near.Rest, element),
      IsTouched(near.Mesh, near.Rest, element) };
  };
  const auto elementOf = [&near](int i) { return near.Rest.Elements[i].Element; };
  return { static_cast<int>(near.Rest.Elements.size()), shapeOf, elementOf, &near.Rest.NodeMoves };
}

void AddScaledJacobians(const HexMesh& mesh, const GridPart& part, const BandShapes& shapes,
  bool allElements, vtkUnstructuredGrid* output)
{
  const Id count = part.Cells.size();
  const auto scaled = MakeArray<vtkFloatArray>(names::ScaledJacobian, count);
  float* values = scaled->GetPointer(0);
  ParallelFor(0, count, 10000,
    [&](Id begin, Id end)
    {
      std::fill(values + begin, values + end, std::numeric_limits<float>::quiet_NaN());
      for (Id i = begin; i < end && allElements; ++i)
      {
        if (part.InBand[i] < 0)
        {
          ElementPoints points;
          const int size = PointsOfCell(mesh, part.Cells[i], points);
          values[i] = static_cast<float>(ScaledJacobian(points, size));
        }
      }
      part.ForInBand(begin, end,
        [&](Id i)
        {
          const FinalElement element = shapes.ShapeOf(part.InBand[i]);
          if (element.Touched || allElements)
          {
            values[i] = static_cast<float>(ScaledJacobian(element.Points, element.Count));
          }
        });
    });
  output->GetCellData()->AddArray(scaled);
}

double VolumeOfPart(
  const MeshBlocks& blocks, const GridPart& part, const BandShapes& shapes, const Ranks& ranks)
{
  // Volumes of the elements at the cut; those of all others are known with the mesh.
  std::vector<double> inBand(shapes.Count, 0.0);
  ForAll(shapes.Count,
    [&](int i)
    {
      const FinalElement element = shapes.ShapeOf(i);
      inBand[i] = element.Count > 0 ? std::abs(VolumeOf(element.Points, element.Count)) : 0.0;
    });
  const auto volumeOf = [&](Id i)
  { return part.InBand[i] >= 0 ? inBand[part.InBand[i]] : blocks.Volumes[part.Cells[i]]; };
  // The Jacobian is nowhere more than half the diagonal cubed, over a cube of eight.
  double bound = std::pow(blocks.LargestDiagonal, 3);
  for (const double volume : inBand)
  {
    bound = std::max(bound, volume);
  }
  return OrderlessSum(part.Cells.size(), volumeOf, bound, ranks);
}

namespace
{

/// An element with a moved node.
struct MovedElement
{
  double Scaled;
  JacobianRange Range;
};

std::optional<MovedElement> MeasureIfMoved(const FinalElement& element, const Moves& moves)
{
  const bool moved = std::any_of(element.begin(), element.end(),
    [&moves](int n) { return moves.Applied[n] != Correction::None; });
  return moved ? std::optional<MovedElement>({ ScaledJacobian(element.Points, element.Count),
                   MeasureJacobian(element.Points, element.Count) })
               : std::nullopt;
}

}

void SummariseTouched(const BandShapes& shapes, Summary& summary)
{
  std::vector<std::optional<MovedElement>> elements(shapes.Count);
  ForAll(shapes.Count,
    [&](int i) { elements[i] = MeasureIfMoved(shapes.ShapeOf(i), *shapes.NodeMoves); });
  for (const auto& element : elements)
  {
    if (element)
    {
      const JacobianRange& range = element->Range;
      ++summary.TouchedElements;
      summary.MinimumScaledJacobian = std::fmin(summary.MinimumScaledJacobian, element->Scaled);
      summary.CertifiedElements += range.Bezier > 0.0;
      summary.MinimumIntegrationPointJacobian =
        std::fmin(summary.MinimumIntegrationPointJacobian, range.IntegrationPoint / range.Mean);
    }
  }
}

}
