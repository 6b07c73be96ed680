#include "TrimWarnings.h"

#include "ElementsAstray.h"
#include "LostVolume.h"
#include "Place.h"
#include "PlaceText.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <sstream>
#include <string>

namespace trim
{
namespace
{

/// Share of the cut elements' volume that is told of where nodes were left off the surface: most
/// trims that leave none miss less.
constexpr double MissWhereLeft = 0.05;

/// What is told of a finding, behind the number of elements.
template <typename Finding>
struct Text
{
  Finding Value;
  const char* OfOne;  ///< how it goes on behind 1,
  const char* OfMany; ///< and behind others
  const char* What;
};

/// A number with what is said of one, or of many.
std::string Counted(std::size_t number, const char* ofOne, const char* ofMany)
{
  return std::to_string(number) + (number == 1 ? ofOne : ofMany);
}

constexpr Text<Feasibility> FeasibilityTexts[] = {
  { Feasibility::OpenSeam, " element has", " elements have",
    " a face that lies on another without common nodes: there the mesh is open, and "
    "what was one may come apart. Merge the nodes by Clean to Grid, unless it is a slit; of an "
    "element with smaller ones at its side (hanging nodes) divide the neighbours alike." },
  { Feasibility::NotOpened, " element holds", " elements hold",
    " a cut-out, or a part of one, that is smaller than an element and is not "
    "opened: refine the mesh there." },
  { Feasibility::CrossedTwice, " element has", " elements have",
    " an edge or face that the surface crosses more than once, or once with a second cut beside "
    "it that faces the same way, or a place in a strip between two cuts that is too narrow for "
    "elements of its own: what lies between is lost, or stays. Refine the mesh there, straighten "
    "the surface, or leave one of two such cuts." },
  { Feasibility::Narrow, " element lies", " elements lie",
    " at a hole or slot narrower than three elements, which comes out coarse: refine "
    "the mesh there." },
  { Feasibility::Inclined, " element is", " elements are",
    " cut under less than 45 degrees between surface and skin: turn the surface "
    "towards the thickness direction, or look at the elements there." },
  { Feasibility::Curved, " element is", " elements are",
    " cut where the surface has an edge, bends with a radius below two element sizes, "
    "or bends, as the skin may, between nodes that had to go far apart, which the border cuts off: "
    "refine the mesh there or round the surface off." },
};

constexpr Text<Shortfall> ShortfallTexts[] = {
  { Shortfall::CameInvalid, " element at the cut was", " elements at the cut were",
    " inside out or without volume already before the trim: repair "
    "the mesh there." },
  { Shortfall::Invalid, " element at the cut is", " elements at the cut are",
    " distorted beyond repair: refine the mesh there, or try the other "
    "correction type." },
  { Shortfall::BelowFloor, " element at the cut stays", " elements at the cut stay",
    " below MinimumScaledJacobian: refine the mesh there or move the "
    "surface." },
  { Shortfall::LoosePart, " element at the cut is of a small part",
    " elements at the cut are of small parts",
    " that nothing joins to the rest of the trimmed grid, "
    "which an implicit solver cannot hold: take it away (Connectivity shows it), or move the "
    "surface." },
  { Shortfall::ShortEdge, " element at the cut has", " elements at the cut have",
    " an edge with less than a twentieth of its length left, which may "
    "make an explicit solver's time step short: move the surface a little, or refine the mesh "
    "there." },
};

constexpr Text<Shortfall> OffcutTexts[] = {
  { Shortfall::CameInvalid, " element of the offcut was", " elements of the offcut were",
    " inside out or without volume already before the trim: "
    "repair the mesh there." },
  { Shortfall::Invalid, " element of the offcut is", " elements of the offcut are",
    " distorted beyond repair: refine the mesh there, or try the other "
    "correction type." },
  { Shortfall::BelowFloor, " element of the offcut stays", " elements of the offcut stay",
    " below MinimumScaledJacobian: refine the mesh there or move the "
    "surface." },
  { Shortfall::LoosePart, " element of the offcut hangs", " elements of the offcut hang",
    " on the rest of it by an edge or a node alone, which an implicit "
    "solver cannot hold: move the surface, or refine the mesh there." },
};

/// How many there are of a kind, and the first of them by its place: the cells of several pieces
/// have no other order.
struct Count
{
  Id Number = 0;
  Id Cell = -1; ///< in the input; not said of one piece among several
  Place At{};

  void Add(const Count& other)
  {
    const Id both = this->Number + other.Number;
    if (this->Number == 0 || (other.Number > 0 && other.At < this->At))
    {
      *this = other;
    }
    this->Number = both;
  }
};

template <typename Finding>
void Warn(const Count& count, const Text<Finding>& text, std::vector<std::string>& warnings)
{
  if (count.Number > 0)
  {
    const std::string cell =
      count.Cell < 0 ? "" : "(cell " + std::to_string(count.Cell) + " of the input) ";
    warnings.push_back(Counted(count.Number, text.OfOne, text.OfMany) + text.What + " The first " +
      cell + "is at " + nurbs::PlaceText(ToVec3(count.At)) + ".");
  }
}

/// Of the elements of all pieces.
void WarnOfFeasibilities(const HexMesh& mesh, const Piece& piece, TrimResult& result)
{
  for (const auto& text : FeasibilityTexts)
  {
    Count own;
    for (const auto& item : result.Found.Feasibilities)
    {
      if (item.second == text.Value)
      {
        own.Add({ 1, piece.All.Alone() ? piece.InputCell(item.first) : Id(-1),
          ToPlace(mesh.Point(mesh.FirstNode(item.first))) });
      }
    }
    Count all;
    for (const Count& count : piece.All.Gather(std::vector<Count>{ own }))
    {
      all.Add(count);
    }
    Warn(all, text, result.Warnings);
  }
}

/// Of the elements of the band, which all ranks have.
template <typename Texts>
void WarnOfShortfalls(const Piece& piece, const std::vector<std::pair<int, Shortfall>>& list,
  const Texts& texts, TrimResult& result)
{
  for (const auto& text : texts)
  {
    Count count;
    Id besideGraver = 0;
    for (auto item = list.begin(); item != list.end(); ++item)
    {
      if (item->second != text.Value)
      {
        continue;
      }
      besideGraver += item != list.begin() && std::prev(item)->first == item->first ? 1 : 0;
      if (count.Number++ == 0)
      {
        const Band& band = result.Near->Mesh;
        const auto& element = band.Elements[item->first];
        count.Cell = piece.All.Alone() ? piece.InputCell(CellOf(band, item->first)) : Id(-1);
        count.At = ToPlace(band.Point[element.Node[0]]);
      }
    }
    Warn(count, text, result.Warnings);
    if (besideGraver > 0)
    {
      result.Warnings.back() +=
        " Shortfall has what is graver for " + std::to_string(besideGraver) + " of them.";
    }
  }
}

/// Of nodes with their distances, which are not empty.
std::string FarthestText(const Band& band, const std::vector<std::pair<int, float>>& nodes)
{
  const auto farthest = std::max_element(
    nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  std::ostringstream text;
  text << " The farthest, " << farthest->second << " away, is at "
       << nurbs::PlaceText(band.Point[farthest->first]) << ".";
  return text.str();
}

void WarnOfNodesLeft(const BandOptions& options, TrimResult& result)
{
  const auto& left = result.Near->NodesLeft;
  if (left.empty())
  {
    return;
  }
  const auto& axes = result.Near->SheetAxis;
  const bool inBlock = std::any_of(axes.begin(), axes.end(), [](int axis) { return axis < 0; });
  const bool mayInsert = (inBlock || options.InsertLayer) && !options.MayInsert();
  const char* const insert =
    options.ProduceOffcut ? "try InsertLayer without ProduceOffcut, " : "try InsertLayer, ";
  const bool hasFloor = options.Ladder.QualityFloor > 0;
  const auto boundary = ListBoundaryNodes(result.Near->Mesh, result.Near->Trimmed);
  const std::size_t ofBoundary = std::count_if(left.begin(), left.end(),
    [&boundary](const auto& node)
    { return std::binary_search(boundary.begin(), boundary.end(), node.first); });
  const std::string nodes = ofBoundary == left.size()
    ? Counted(left.size(), " node of the new boundary was", " nodes of the new boundary were")
    : Counted(left.size(), " node, ", " nodes, ") + std::to_string(ofBoundary) +
      " of them of the new boundary, " + (left.size() == 1 ? "was" : "were");
  result.Warnings.push_back(nodes + " left off the surface, as elements would be invalid" +
    (hasFloor ? " or short of MinimumScaledJacobian" : "") +
    " otherwise: " + (mayInsert ? insert : "") + "refine the mesh there" +
    (hasFloor ? ", move the surface or ask for less." : " or move the surface.") +
    FarthestText(result.Near->Mesh, left));
}

void WarnOfNodesBeside(TrimResult& result)
{
  const auto& beside = result.Near->NodesBeside;
  if (!beside.empty())
  {
    result.Warnings.push_back(
      Counted(beside.size(), " node of the new boundary stays", " nodes of the new boundary stay") +
      " beside the surface, as Tolerance takes them for on it: ask "
      "for less." +
      FarthestText(result.Near->Mesh, beside));
  }
}

void WarnOfCornersLost(TrimResult& result)
{
  const auto& lost = result.Near->CornersLost;
  if (lost.empty())
  {
    return;
  }
  const double missing = result.Near->Missing;
  std::ostringstream volume;
  volume << std::setprecision(2) << std::abs(missing) << " elements "
         << (missing < 0.0 ? "more" : "less");
  result.Warnings.push_back(Counted(lost.size(), " node", " nodes") +
    " at corners or on the border of the model moved for the trimmed grid alone, or past a "
    "bend of it: there it does not add up to the whole with the offcut (both have the volume of " +
    volume.str() + " together). Refine the mesh there. The first is at " +
    nurbs::PlaceText(result.Near->Mesh.Point[lost.front()]) + ".");
}

/// Elements of the band at which a finding tells already of what is lost or stays. Nodes left tell
/// how far off the border is, not how much it takes or leaves. Collective.
std::vector<int> FindLossTold(const Piece& piece, const TrimResult& result)
{
  const Band& band = result.Near->Mesh;
  std::vector<int> own;
  for (const auto& [cell, value] : result.Found.Feasibilities)
  {
    const bool tells = value != Feasibility::Inclined && value != Feasibility::Curved;
    const int e = tells ? band.FindElement(cell) : -1;
    if (e >= 0)
    {
      own.push_back(e);
    }
  }
  return piece.All.Gather(own);
}

/// A strip or an island may be too little for elements of its own, though others are kept.
void WarnOfLostVolume(const Piece& piece, const BandOptions& options, TrimResult& result)
{
  if (options.Ladder.CorrectionType == Correction::Eliminate)
  {
    return;
  }
  const TrimBand& near = *result.Near;
  const bool leaves = !near.NodesLeft.empty();
  const LostVolume lost = FindLostVolume(
    near, FindLossTold(piece, result), leaves ? MissWhereLeft : ElementsAstray::LargestMiss);
  if (lost.Most >= 0)
  {
    result.Warnings.push_back("The volume of " +
      Counted(std::lround(lost.Elements), " cut element", " cut elements") +
      " is lost, or stays beyond the surface, " +
      (leaves && !lost.IsOfPlaces ? "where nodes were left off it or too little is cut"
                                  : "as it is too little for elements of its own") +
      ": refine the mesh there (EliminatedFraction tells which). The element with most of it is "
      "at " +
      nurbs::PlaceText(near.Mesh.Point[near.Mesh.Elements[lost.Most].Node[0]]) + ".");
  }
}

/// A surface that parts no element, and is not hidden within one either.
/// @return whether it was warned of.
bool WarnIfMissed(const Piece& piece, const std::string& unitsHint, TrimResult& result)
{
  std::array<bool, 3> own{};
  for (auto status = result.ElementStatus.begin();
       status != result.ElementStatus.end() && !own[ElementToTreat]; ++status)
  {
    own[*status] = true; // what comes behind one to treat says nothing
  }
  const auto has = piece.All.Any(own);
  if (has[ElementToTreat] || has[ElementKeep] == has[ElementEliminate] ||
    piece.All.Any(!result.Found.Feasibilities.empty()))
  {
    return false;
  }
  result.Warnings.push_back("The trimming surface " +
    std::string(result.Near ? "touches the grid, but does not part it, so the grid"
                            : "misses the grid, which") +
    " is " + (has[ElementKeep] ? "kept" : "eliminated") +
    " whole: move the surface, or turn the side with InvertSide." + unitsHint);
  return true;
}

/// Parts that the surface does not meet are on one side of it, unless they lie beside its end.
void WarnOfPartsBesideEnd(TrimResult& result)
{
  const auto& parts = result.Nodes.PartsBesideEnd;
  if (!parts.empty())
  {
    result.Warnings.push_back(
      Counted(parts.size(), " part of the grid lies", " parts of the grid lie") +
      " beyond the end of the trimming surface, on both sides of where it "
      "would go on. What lies there is kept or eliminated whole: extend the surface through it, or "
      "trim without it. The first is at " +
      nurbs::PlaceText(ToVec3(parts.front())) + ".");
  }
}

/// @return whether it was warned of.
bool WarnIfNothingIsLeft(const Piece& piece, TrimResult& result)
{
  const bool isLeft =
    piece.All.Any(std::any_of(result.Kept.begin(), result.Kept.end(), [](char k) { return k; }));
  if (!isLeft)
  {
    result.Warnings.push_back(
      "No element is left, as what the surface spares of the grid is too "
      "little for one: refine the mesh, move the surface, or turn the side with InvertSide.");
  }
  return !isLeft;
}

}

void AddWarnings(const HexMesh& mesh, const Piece& piece, const BandOptions& options,
  const std::string& unitsHint, TrimResult& result)
{
  const bool told = WarnIfMissed(piece, unitsHint, result) || WarnIfNothingIsLeft(piece, result);
  if (!told)
  {
    WarnOfPartsBesideEnd(result);
  }
  WarnOfFeasibilities(mesh, piece, result);
  if (result.Near)
  {
    WarnOfShortfalls(piece, result.Near->Shortfalls, ShortfallTexts, result);
    WarnOfShortfalls(piece, result.Near->ShortfallsOfRest, OffcutTexts, result);
    WarnOfCornersLost(result);
    WarnOfNodesLeft(options, result);
    WarnOfNodesBeside(result);
    if (!told)
    {
      WarnOfLostVolume(piece, options, result);
    }
  }
}

}
