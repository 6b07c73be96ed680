#include "OpenSeams.h"

#include "BoxTree.h"
#include "Facet.h"
#include "MeshBlocks.h"
#include "Runs.h"
#include "SortUnique.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// How far beside each other faces may lie, of their size: places are rounded.
constexpr double Closeness = 1e-6;
/// Faces that lie on each other look in opposite directions, but for what they are warped.
constexpr double OppositeCosine = -0.7;

/// A face that no other element shares.
struct Side
{
  FacetSearch Search;
  int Element;
  Vec3 Low, High, Middle;

  double Size() const { return (this->High - this->Low).norm(); }
};

/// Whether a face may be one of a seam.
bool IsOpen(const Band& band, const BandFace& face)
{
  // What lies on a face of ring 0 is no farther than in the next ring.
  return face.Exterior && face.Element[0] >= 0 && band.Elements[face.Element[0]].Ring <= 1;
}

bool IsOnSkin(const TrimBand& near, const BandFace& face)
{
  const int element = face.Element[0];
  const int axis = near.SheetAxis[element];
  return axis >= 0 && TopologyOf(near.Mesh.Elements[element].Count).FaceAxis[face.Slot[0]] == axis;
}

Side ToSide(const Band& band, const BandFace& face)
{
  const Vec3& first = band.Point[face.Node[0]];
  Side side{ FacetSearch(Facet(band, face)), face.Element[0], first, first, Vec3::Zero() };
  for (const int node : face)
  {
    const Vec3& corner = band.Point[node];
    side.Low = side.Low.cwiseMin(corner);
    side.High = side.High.cwiseMax(corner);
    side.Middle += corner / face.Count;
  }
  return side;
}

std::vector<Side> OpenSides(const TrimBand& near)
{
  const Band& band = near.Mesh;
  std::vector<Side> sides;
  for (const BandFace& face : band.Faces)
  {
    if (IsOpen(band, face) && !IsOnSkin(near, face))
    {
      sides.push_back(ToSide(band, face));
    }
  }
  return sides;
}

/// Whether the middle of a face lies on another: faces that share nodes only meet at their borders.
bool LiesOn(const Side& side, const Side& other)
{
  Vec3 on;
  return other.Search.FindInside(side.Middle, 0.0, on) &&
    (on - side.Middle).norm() <= Closeness * other.Size();
}

bool LieOnEachOther(const Side& a, const Side& b)
{
  return LiesOn(a, b) || LiesOn(b, a);
}

bool MayTouch(const Side& a, const Side& b)
{
  const double close = Closeness * (a.Size() + b.Size());
  return ((a.Low - b.High).array() <= close).all() && ((b.Low - a.High).array() <= close).all();
}

/// About the middle of all sides in single precision, with room for its rounding.
std::vector<Eigen::AlignedBox3f> BoxSides(const std::vector<Side>& sides)
{
  Box3 whole;
  for (const Side& side : sides)
  {
    whole.extend(Box3(side.Low, side.High));
  }
  const Vec3 middle = whole.center();
  const double rounding = std::numeric_limits<float>::epsilon() * whole.diagonal().norm();
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Side& side : sides)
  {
    const Box3 box = Grown({ side.Low - middle, side.High - middle },
      Vec3::Constant(rounding + Closeness * side.Size()));
    boxes.emplace_back(box.min().cast<float>(), box.max().cast<float>());
  }
  return boxes;
}

/// Elements with sides that lie on others, wherever these are.
std::vector<int> FindAmongSides(const std::vector<Side>& sides)
{
  constexpr Id length = 256; // of a run of sides
  if (sides.empty())
  {
    return {};
  }
  const std::vector<Eigen::AlignedBox3f> boxes = BoxSides(sides);
  std::vector<int> order(sides.size());
  std::iota(order.begin(), order.end(), 0);
  const std::vector<nurbs::TreeNode> tree = nurbs::BuildTree(order, boxes);
  const Id count = static_cast<Id>(sides.size());
  std::vector<std::vector<int>> found(NumberOfRuns(count, length));
  ForRuns(count, length,
    [&](Id run, Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        nurbs::ForItemsMeeting(tree, boxes[i],
          [&](int place)
          {
            const int j = order[place];
            if (j < i && MayTouch(sides[i], sides[j]) && LieOnEachOther(sides[i], sides[j]))
            {
              found[run].insert(found[run].end(), { sides[i].Element, sides[j].Element });
            }
            return true;
          });
      }
    });
  return Joined(found);
}

/// Whether each corner of a face is where the other one has a corner.
bool HaveSameCorners(const Band& band, const BandFace& a, const BandFace& b)
{
  const double close = Closeness * (band.Point[a.Node[2]] - band.Point[a.Node[0]]).norm();
  return a.Count == b.Count &&
    std::all_of(a.begin(), a.end(),
      [&](int n)
      {
        return std::any_of(b.begin(), b.end(),
          [&](int m) { return (band.Point[n] - band.Point[m]).norm() <= close; });
      });
}

/// A face at a node that may be one of a seam.
struct OpenFace
{
  const BandFace* Face;
  Vec3 Normal;
  bool OnSkin;
};

void ListOpenFaces(const TrimBand& near, int node, std::vector<OpenFace>& open)
{
  const Band& band = near.Mesh;
  open.clear();
  for (const int f : band.FacesOfNode(node))
  {
    const BandFace& face = band.Faces[f];
    if (IsOpen(band, face))
    {
      open.push_back({ &face, Facet(band, face).MeanNormal(), IsOnSkin(near, face) });
    }
  }
}

bool HangBySkin(const Band& band, const OpenFace& a, const OpenFace& b)
{
  return (a.OnSkin || b.OnSkin) && a.Normal.dot(b.Normal) < OppositeCosine &&
    !HaveSameCorners(band, *a.Face, *b.Face) &&
    LieOnEachOther(ToSide(band, *a.Face), ToSide(band, *b.Face));
}

/**
 * Elements at which others hang by a skin: sheets may lie on each other, and where nodes of both
 * are the same they are glued there or it is a fold, if all the others are double; a node that lies
 * between those of the other sheet was left behind by a refinement.
 */
std::vector<int> FindHangingOnSkin(const TrimBand& near)
{
  constexpr Id length = 1024; // of a run of nodes
  const Band& band = near.Mesh;
  const Id count = static_cast<Id>(band.Point.size());
  std::vector<std::vector<int>> found(NumberOfRuns(count, length));
  ForRuns(count, length,
    [&](Id run, Id begin, Id end)
    {
      std::vector<OpenFace> open;
      for (Id node = begin; node < end; ++node)
      {
        ListOpenFaces(near, static_cast<int>(node), open);
        for (auto a = open.begin(); a != open.end(); ++a)
        {
          for (auto b = open.begin(); b != a; ++b)
          {
            if (HangBySkin(band, *a, *b))
            {
              found[run].insert(found[run].end(), { a->Face->Element[0], b->Face->Element[0] });
            }
          }
        }
      }
    });
  return Joined(found);
}

}

std::vector<int> FindOpenSeams(const TrimBand& near)
{
  std::vector<int> elements = FindHangingOnSkin(near);
  const std::vector<int> others = FindAmongSides(OpenSides(near));
  elements.insert(elements.end(), others.begin(), others.end());
  SortUnique(elements);
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                   [&near](int e) { return near.Mesh.Elements[e].Ring != 0; }),
    elements.end());
  return elements;
}

}
