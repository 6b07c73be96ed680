#include "Columns.h"

#include "ConcurrentSets.h"
#include "DisjointSets.h"
#include "ElementChain.h"
#include "LocalThickness.h"
#include "Runs.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace trim
{
namespace
{

/// Less than this share of a part is no sheet of its own.
constexpr double SmallestSheet = 0.1;
/// A part is made of sheets if at least this share of its elements has a thickness.
constexpr double SheetShare = 0.7;
/// How many elements of a part are sampled at most to measure the chains.
constexpr int Samples = 200;
/// Shifts that differ by less, in elements, are the same: rounding must not decide.
constexpr double ShiftRounding = 1e-6;

int Slot(int element, int axis)
{
  return 3 * element + axis;
}

/// The axes along the first two edges of a quadrilateral in one of its elements; -1: none.
std::array<int, 2> AxesAlong(const BandElement& element, int slot, const BandFace& face)
{
  const int first = AxisOfEdge(element, face.Node[0], face.Node[1]);
  // The axes of a hexahedron are those of the two edges and that which the face ends.
  const int second = element.Count == 8 && first >= 0
    ? 3 - HexahedronTopology.FaceAxis[slot] - first
    : AxisOfEdge(element, face.Node[1], face.Node[2]);
  return { first, second };
}

/// Joins the axes that two elements share through a common face.
void UniteAxes(const Band& band, const BandFace& face, ConcurrentSets<int>& axes)
{
  const auto& e0 = band.Elements[face.Element[0]];
  const auto& e1 = band.Elements[face.Element[1]];
  const int end0 = TopologyOf(e0.Count).FaceAxis[face.Slot[0]];
  const int end1 = TopologyOf(e1.Count).FaceAxis[face.Slot[1]];
  if (end0 >= 0 && end1 >= 0)
  {
    axes.Unite(Slot(face.Element[0], end0), Slot(face.Element[1], end1));
  }
  // Opposite edges of a quadrilateral are parallel, those of a triangle have no axis.
  if (face.Count < 4)
  {
    return;
  }
  const auto along0 = AxesAlong(e0, face.Slot[0], face);
  const auto along1 = AxesAlong(e1, face.Slot[1], face);
  for (int i = 0; i < 2; ++i)
  {
    if (along0[i] >= 0 && along1[i] >= 0)
    {
      axes.Unite(Slot(face.Element[0], along0[i]), Slot(face.Element[1], along1[i]));
    }
  }
}

/// A class of axes in one part, with its measured chains.
struct Candidate
{
  int Root = -1;
  int Covered = 0; ///< elements with exactly one axis in the class
  int Twice = 0;   ///< elements with two: the class turns back on itself
  double MeanLength = 0;
  double MeanShift = 0; ///< of the cut, from end to end
  double ClosedShare = 0;
};

/// Some elements of a part near the cut, where the rings see whole columns; the halo may not.
std::vector<char> ChooseSamples(const Band& band, const std::vector<int>& part)
{
  std::vector<std::size_t> near; // places in the part
  for (std::size_t i = 0; i < part.size(); ++i)
  {
    if (band.Elements[part[i]].Ring <= 1)
    {
      near.push_back(i);
    }
  }
  std::vector<char> sampled(part.size(), 0);
  const std::size_t stride = (near.size() + Samples - 1) / Samples;
  for (std::size_t i = 0; i < near.size(); i += stride)
  {
    sampled[near[i]] = 1;
  }
  return sampled;
}

/// @param shift may be empty.
std::vector<Candidate> MeasureCandidates(
  const Band& band, const std::vector<int>& part, const AxisShift& shift, ConcurrentSets<int>& axes)
{
  std::map<int, Candidate> candidates;
  std::map<int, int> measured;
  const std::vector<char> sampled = ChooseSamples(band, part);
  for (std::size_t i = 0; i < part.size(); ++i)
  {
    const int e = part[i];
    const int count = TopologyOf(band.Elements[e].Count).NumberOfAxes;
    std::array<int, 3> roots{ -1, -1, -1 };
    for (int axis = 0; axis < count; ++axis)
    {
      roots[axis] = axes.Find(Slot(e, axis));
    }
    for (int axis = 0; axis < count; ++axis)
    {
      auto& candidate = candidates[roots[axis]];
      candidate.Root = roots[axis];
      const bool twice = std::count(roots.begin(), roots.end(), roots[axis]) > 1;
      ++(twice ? candidate.Twice : candidate.Covered);
      if (sampled[i])
      {
        const Chain chain = MeasureChain(band, e, axis);
        ++measured[roots[axis]];
        candidate.MeanLength += chain.Length;
        candidate.MeanShift += shift ? chain.Count * shift(e, axis) : 0.0;
        candidate.ClosedShare += chain.Closed ? 1.0 : 0.0;
      }
    }
  }
  std::vector<Candidate> list;
  for (auto& item : candidates)
  {
    const int n = measured[item.first];
    if (n > 0)
    {
      item.second.MeanLength /= n;
      item.second.MeanShift /= n;
      item.second.ClosedShare /= n;
      list.push_back(item.second);
    }
  }
  return list;
}

/// Root of the thickness axis of one part, or -1.
int ChooseThickness(std::vector<Candidate> candidates, int partSize)
{
  std::sort(candidates.begin(), candidates.end(),
    [](const Candidate& a, const Candidate& b) { return a.MeanLength < b.MeanLength; });
  for (std::size_t i = 0; i < candidates.size(); ++i)
  {
    const auto& candidate = candidates[i];
    if (candidate.Covered != partSize || candidate.Twice > 0)
    {
      continue;
    }
    // An open chain is longer than what the band shows of it.
    const bool shortest = std::all_of(candidates.begin(), candidates.end(),
      [&](const Candidate& o)
      {
        return o.Root == candidate.Root || o.MeanLength > ThicknessRatio * candidate.MeanLength ||
          (o.ClosedShare < 0.5 && o.MeanLength > candidate.MeanLength);
      });
    return shortest && candidate.ClosedShare > 0.5 ? candidate.Root : -1;
  }
  return -1;
}

/// The node next to the first one of an element, along an axis of a class: tells axes apart by
/// place.
int NextAlong(const Band& band, int e, int root, ConcurrentSets<int>& axes)
{
  const auto& element = band.Elements[e];
  const auto& topology = TopologyOf(element.Count);
  const int first = *std::min_element(element.begin(), element.end());
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const int a = element.Node[topology.Edges[i].First];
    const int b = element.Node[topology.Edges[i].Second];
    if ((a == first || b == first) && topology.Edges[i].Axis >= 0 &&
      axes.Find(Slot(e, topology.Edges[i].Axis)) == root)
    {
      return a == first ? b : a;
    }
  }
  return -1;
}

/// Root of the axis along which the cut of a part wanders least, or -1.
int ChooseBySteadiness(const Band& band, const std::vector<int>& part, const AxisShift& shift,
  double largest, ConcurrentSets<int>& axes)
{
  auto candidates = MeasureCandidates(band, part, shift, axes);
  const auto next = [&](const Candidate& c) { return NextAlong(band, part.front(), c.Root, axes); };
  std::sort(candidates.begin(), candidates.end(),
    [&](const Candidate& a, const Candidate& b) { return next(a) < next(b); });
  int best = -1;
  for (const auto& candidate : candidates)
  {
    if (candidate.Covered == static_cast<int>(part.size()) && candidate.ClosedShare == 1.0 &&
      candidate.MeanShift < largest + (best < 0 ? ShiftRounding : -ShiftRounding))
    {
      largest = candidate.MeanShift;
      best = candidate.Root;
    }
  }
  return best;
}

/// Axes that are the same all through a part of the band, and the parts.
struct AxisClasses
{
  explicit AxisClasses(const Band& band)
    : Axes(3 * band.NumberOfElements())
  {
    const int count = band.NumberOfElements();
    ConcurrentSets<int> joined(count);
    ForAll(
      static_cast<int>(band.Faces.size()),
      [&](int f)
      {
        const auto& face = band.Faces[f];
        if (face.Element[1] >= 0)
        {
          UniteAxes(band, face, this->Axes);
          joined.Unite(face.Element[0], face.Element[1]);
        }
      },
      LightGrain);
    std::vector<int> partOfRoot(count, -1);
    for (int e = 0; e < count; ++e)
    {
      int& part = partOfRoot[joined.Find(e)];
      if (part < 0)
      {
        part = static_cast<int>(this->Parts.size());
        this->Parts.emplace_back();
      }
      this->Parts[part].push_back(e);
    }
  }

  /// The axis of a class for all elements of a part; root -1: none.
  void SetAxis(const Band& band, const std::vector<int>& part, int root, Columns& columns)
  {
    for (const int e : part)
    {
      const int count = TopologyOf(band.Elements[e].Count).NumberOfAxes;
      for (int axis = 0; axis < count && root >= 0; ++axis)
      {
        if (this->Axes.Find(Slot(e, axis)) == root)
        {
          columns.Axis[e] = static_cast<signed char>(axis);
        }
      }
    }
  }

  /// Whether most elements of a part have a thickness, along axes of several classes.
  bool AreSheets(const std::vector<int>& part, const Columns& columns)
  {
    std::map<int, int> ofClass;
    int found = 0;
    for (const int e : part)
    {
      if (columns.HasThickness(e))
      {
        ++found;
        ++ofClass[this->Axes.Find(Slot(e, columns.Axis[e]))];
      }
    }
    const double size = static_cast<double>(part.size());
    const auto sheets = std::count_if(ofClass.begin(), ofClass.end(),
      [size](const auto& c) { return c.second > SmallestSheet * size; });
    return found > SheetShare * size && sheets > 1;
  }

  /// See Columns::Part.
  std::vector<int> PartOfElements(const Band& band) const
  {
    if (this->Parts.size() < 2)
    {
      return {};
    }
    std::vector<int> partOf(band.NumberOfElements());
    for (std::size_t i = 0; i < this->Parts.size(); ++i)
    {
      for (const int e : this->Parts[i])
      {
        partOf[e] = static_cast<int>(i);
      }
    }
    return partOf;
  }

  ConcurrentSets<int> Axes;
  std::vector<std::vector<int>> Parts; ///< by their first elements
};

/// No element has an axis; the groups are to be built.
/// @param part see Columns::Part.
Columns WithoutAxes(const Band& band, std::vector<int> part)
{
  Columns columns;
  columns.Part = std::move(part);
  columns.Axis.assign(band.NumberOfElements(), -1);
  return columns;
}

void BuildGroups(const Band& band, Columns& columns)
{
  nurbs::DisjointSets<int> elements(band.NumberOfElements());
  nurbs::DisjointSets<int> nodes(band.NumberOfNodes());
  for (std::size_t f = 0; f < band.Faces.size(); ++f)
  {
    const auto& face = band.Faces[f];
    if (face.Element[1] >= 0 && columns.IsLayerFace(band, static_cast<int>(f)))
    {
      elements.Unite(face.Element[0], face.Element[1]);
    }
  }
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    const auto& topology = TopologyOf(element.Count);
    for (int i = 0; i < topology.NumberOfEdges && columns.Axis[e] >= 0; ++i)
    {
      if (topology.Edges[i].Axis == columns.Axis[e])
      {
        nodes.Unite(element.Node[topology.Edges[i].First], element.Node[topology.Edges[i].Second]);
      }
    }
  }
  columns.Column.resize(band.NumberOfElements());
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    columns.Column[e] = elements.Find(e);
  }
  columns.Pillar.resize(band.NumberOfNodes());
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    columns.Pillar[n] = nodes.Find(n);
  }
}

/// @param root of the axis chosen for a part, -1: none.
void TellChosen(const Band& band, const std::vector<int>& part, int root, Columns& columns)
{
  if (root < 0)
  {
    return;
  }
  columns.ChosenByCut.resize(band.NumberOfNodes(), 0);
  for (const int e : part)
  {
    const auto& element = band.Elements[e];
    std::for_each(
      element.begin(), element.end(), [&columns](int n) { columns.ChosenByCut[n] = 1; });
  }
}

/// Whether an edge of an element across its thickness joins two nodes of one pillar.
bool HasBranchingPillar(const Band& band, const Columns& columns, int e)
{
  const auto& element = band.Elements[e];
  const auto& topology = TopologyOf(element.Count);
  return std::any_of(topology.Edges.begin(), topology.Edges.begin() + topology.NumberOfEdges,
    [&](const EdgeNodes& edge)
    {
      return edge.Axis != columns.Axis[e] &&
        columns.Pillar[element.Node[edge.First]] == columns.Pillar[element.Node[edge.Second]];
    });
}

/// Parts that have nodes in common, but no faces, may have different axes. Where pillars of one
/// would go on along the axis of another it has to do without columns.
void BuildPlainGroups(
  const Band& band, const std::vector<std::vector<int>>& parts, Columns& columns)
{
  for (bool changed = true; changed;)
  {
    BuildGroups(band, columns);
    changed = false;
    for (const auto& part : parts)
    {
      if (std::any_of(part.begin(), part.end(),
            [&](int e) { return columns.HasThickness(e) && HasBranchingPillar(band, columns, e); }))
      {
        std::for_each(part.begin(), part.end(), [&](int e) { columns.Axis[e] = -1; });
        changed = true;
      }
    }
  }
}

/// What each owner has, ascending.
Band::Lists ItemsOf(const std::vector<int>& owner)
{
  const int count = static_cast<int>(owner.size());
  return BuildLists(count,
    [&](auto&& add)
    {
      for (int i = 0; i < count; ++i)
      {
        add(owner[i], i);
      }
    });
}

}

Band::Lists Columns::Elements() const
{
  return ItemsOf(this->Column);
}

Band::Lists Columns::Nodes() const
{
  return ItemsOf(this->Pillar);
}

bool Columns::Complete(const Band& band, int ring) const
{
  std::vector<char> open(band.NumberOfElements(), 0);
  for (std::size_t f = 0; f < band.Faces.size(); ++f)
  {
    const auto& face = band.Faces[f];
    if (face.Element[1] < 0 && !face.Exterior && this->IsLayerFace(band, static_cast<int>(f)))
    {
      open[this->Column[face.Element[0]]] = 1;
    }
  }
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (band.Elements[e].Ring <= ring && open[this->Column[e]])
    {
      return false;
    }
  }
  return true;
}

Columns FindColumns(const Band& band)
{
  AxisClasses classes(band);
  Columns columns = WithoutAxes(band, classes.PartOfElements(band));
  for (const auto& part : classes.Parts)
  {
    const int root = ChooseThickness(
      MeasureCandidates(band, part, {}, classes.Axes), static_cast<int>(part.size()));
    classes.SetAxis(band, part, root, columns);
  }
  BuildPlainGroups(band, classes.Parts, columns);
  return columns;
}

Columns FindJoinedSheets(const Band& band)
{
  AxisClasses classes(band);
  Columns columns = WithoutAxes(band, classes.PartOfElements(band));
  for (const auto& part : classes.Parts)
  {
    FindLocalThickness(band, part, columns.Axis);
    if (!classes.AreSheets(part, columns))
    {
      return NoColumns(band, std::move(columns.Part));
    }
  }
  BuildPlainGroups(band, classes.Parts, columns);
  return columns;
}

void ChooseColumns(const Band& band, const AxisShift& shift, double largest, Columns& columns)
{
  AxisClasses classes(band);
  for (const auto& part : classes.Parts)
  {
    if (!columns.HasThickness(part.front()))
    {
      const int root = ChooseBySteadiness(band, part, shift, largest, classes.Axes);
      classes.SetAxis(band, part, root, columns);
      TellChosen(band, part, root, columns);
    }
  }
  BuildPlainGroups(band, classes.Parts, columns);
}

Columns NoColumns(const Band& band, std::vector<int> part)
{
  Columns columns = WithoutAxes(band, std::move(part));
  BuildGroups(band, columns);
  return columns;
}

}
