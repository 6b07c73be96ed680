#include "Exterior.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace judge
{
namespace
{
using Edge = std::pair<Id, Id>;

Edge EdgeOf(const Facet& facet, int i)
{
  const Id a = facet.Node[i], b = facet.Node[(i + 1) % facet.Size()];
  return a < b ? Edge(a, b) : Edge(b, a);
}

std::map<Edge, std::vector<Id>> FacetsOfEdges(const std::vector<Facet>& facets)
{
  std::map<Edge, std::vector<Id>> facetsOfEdge;
  for (Id f = 0; f < static_cast<Id>(facets.size()); ++f)
  {
    for (int i = 0; i < facets[f].Size(); ++i)
    {
      facetsOfEdge[EdgeOf(facets[f], i)].push_back(f);
    }
  }
  return facetsOfEdge;
}

Vec3 NormalOf(const Facet& facet, const std::vector<Vec3>& points)
{
  const Vec3& p0 = points[facet.Node[0]];
  const Vec3 a = points[facet.Node[2]] - p0;
  const Vec3 normal = facet.Size() == 4 ? a.cross(points[facet.Node[3]] - points[facet.Node[1]])
                                        : Vec3((points[facet.Node[1]] - p0).cross(a));
  return normal.normalized();
}

double DistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 n = (b - a).cross(c - a);
  const double area2 = n.squaredNorm();
  if (area2 > 0)
  {
    const double u = n.dot((c - b).cross(p - b)), v = n.dot((a - c).cross(p - c)),
                 w = n.dot((b - a).cross(p - a));
    if (u >= 0 && v >= 0 && w >= 0)
    {
      return std::abs(n.dot(p - a)) / std::sqrt(area2);
    }
  }
  return std::min(
    { DistanceToSegment(p, a, b), DistanceToSegment(p, b, c), DistanceToSegment(p, c, a) });
}

// Newton's method with clamping from several starts: the patch is small and nearly flat.
double DistanceToBilinear(
  const Vec3& p, const Vec3& p00, const Vec3& p10, const Vec3& p11, const Vec3& p01)
{
  const Vec3 twist = p11 - p10 - p01 + p00;
  double best = std::min({ DistanceToSegment(p, p00, p10), DistanceToSegment(p, p10, p11),
    DistanceToSegment(p, p11, p01), DistanceToSegment(p, p01, p00) });
  const double size = (p11 - p00).norm() + (p10 - p01).norm();
  if (best > 2 * size)
  {
    return best;
  }
  for (const Vec2& start :
    { Vec2(0.5, 0.5), Vec2(0.1, 0.1), Vec2(0.9, 0.1), Vec2(0.9, 0.9), Vec2(0.1, 0.9) })
  {
    Vec2 x = start;
    for (int it = 0; it < 30; ++it)
    {
      const Vec3 s = p00 + x[0] * (p10 - p00) + x[1] * (p01 - p00) + x[0] * x[1] * twist;
      const Vec3 su = p10 - p00 + x[1] * twist, sv = p01 - p00 + x[0] * twist, d = s - p;
      best = std::min(best, d.norm());
      Eigen::Matrix2d h;
      h << su.dot(su), su.dot(sv) + twist.dot(d), su.dot(sv) + twist.dot(d), sv.dot(sv);
      const Vec2 g(su.dot(d), sv.dot(d));
      const Vec2 next = (x - h.inverse() * g).cwiseMax(Vec2::Zero()).cwiseMin(Vec2::Ones());
      if (!next.allFinite() || (next - x).norm() < 1e-15)
      {
        break;
      }
      x = next;
    }
  }
  return best;
}

/// Distance to a triangle or bilinear quadrilateral.
double DistanceToFacet(const Vec3& p, const Facet& facet, const std::vector<Vec3>& points)
{
  const Vec3 &a = points[facet.Node[0]], &b = points[facet.Node[1]], &c = points[facet.Node[2]];
  if (facet.Size() == 3)
  {
    return DistanceToTriangle(p, a, b, c);
  }
  return DistanceToBilinear(p, a, b, c, points[facet.Node[3]]);
}
}

double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 d = b - a;
  const double length2 = d.squaredNorm();
  const double t = length2 > 0 ? std::clamp(d.dot(p - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * d).norm();
}

FacetTable::FacetTable(const Model& model)
{
  std::map<std::array<Id, 4>, Facet> first;
  for (Id e = 0; e < static_cast<Id>(model.Elements.size()); ++e)
  {
    for (const Facet& facet : FacetsOf(model.Elements[e], e))
    {
      const auto key = FacetKey(facet);
      first.emplace(key, facet);
      ++this->Uses[key];
    }
  }
  for (const auto& use : this->Uses)
  {
    if (use.second == 1)
    {
      this->Exterior.push_back(first[use.first]);
    }
    this->OverUsed += use.second > 2;
  }
}

ManifoldDefects FindManifoldDefects(const FacetTable& table)
{
  ManifoldDefects defects;
  auto facetsOfEdge = FacetsOfEdges(table.Exterior);
  std::map<Id, std::vector<Id>> facetsOfPoint;
  for (Id f = 0; f < static_cast<Id>(table.Exterior.size()); ++f)
  {
    const Facet& facet = table.Exterior[f];
    for (int i = 0; i < facet.Size(); ++i)
    {
      facetsOfPoint[facet.Node[i]].push_back(f);
    }
  }
  for (const auto& edge : facetsOfEdge)
  {
    if (edge.second.size() != 2)
    {
      ++defects.Edges;
      defects.Points.insert({ edge.first.first, edge.first.second });
      defects.EdgePoint = defects.EdgePoint < 0 ? edge.first.first : defects.EdgePoint;
    }
  }
  for (const auto& point : facetsOfPoint)
  {
    // Walk from facet to facet over the edges at the point; one fan reaches them all.
    std::set<Id> reached{ point.second[0] };
    std::vector<Id> front{ point.second[0] };
    while (!front.empty())
    {
      const Facet& facet = table.Exterior[front.back()];
      front.pop_back();
      for (int i = 0; i < facet.Size(); ++i)
      {
        const Edge edge = EdgeOf(facet, i);
        if (edge.first != point.first && edge.second != point.first)
        {
          continue;
        }
        for (Id other : facetsOfEdge[edge])
        {
          if (reached.insert(other).second)
          {
            front.push_back(other);
          }
        }
      }
    }
    if (reached.size() != point.second.size())
    {
      ++defects.Vertices;
      defects.Points.insert(point.first);
      defects.VertexPoint = defects.VertexPoint < 0 ? point.first : defects.VertexPoint;
    }
  }
  return defects;
}

Exterior::Exterior(const Model& model)
  : Mesh(model)
  , Table(model)
{
  this->FindRidges();
  this->FindPlaces();
  this->FindPatches();
  this->FillBins();
}

void Exterior::FindPatches()
{
  std::set<Edge> ridges;
  for (const Ridge& ridge : this->Ridges)
  {
    if (ridge.Sure)
    {
      ridges.emplace(ridge.A, ridge.B);
    }
  }
  auto facetsOfEdge = FacetsOfEdges(this->Table.Exterior);
  const auto count = static_cast<Id>(this->Table.Exterior.size());
  this->FacetPatch.assign(count, -1);
  this->PointPatch.assign(this->Mesh.Points.size(), -1);
  int patches = 0;
  for (Id first = 0; first < count; ++first)
  {
    std::vector<Id> front;
    if (this->FacetPatch[first] < 0)
    {
      this->FacetPatch[first] = patches++;
      front.push_back(first);
    }
    while (!front.empty())
    {
      const Id f = front.back();
      const Facet& facet = this->Table.Exterior[f];
      front.pop_back();
      for (int i = 0; i < facet.Size(); ++i)
      {
        this->PointPatch[facet.Node[i]] = this->FacetPatch[f];
        const Edge edge = EdgeOf(facet, i);
        for (Id other : facetsOfEdge[edge])
        {
          if (this->FacetPatch[other] < 0 && ridges.count(edge) == 0)
          {
            this->FacetPatch[other] = this->FacetPatch[f];
            front.push_back(other);
          }
        }
      }
    }
  }
}

void Exterior::FindRidges()
{
  for (const auto& edge : FacetsOfEdges(this->Table.Exterior))
  {
    double angle = 180;
    if (edge.second.size() == 2)
    {
      const Vec3 a = NormalOf(this->Table.Exterior[edge.second[0]], this->Mesh.Points);
      const Vec3 b = NormalOf(this->Table.Exterior[edge.second[1]], this->Mesh.Points);
      angle = std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / std::acos(-1.0);
    }
    if (angle > MaybeAngle)
    {
      this->Ridges.push_back({ edge.first.first, edge.first.second, angle > SureAngle });
    }
  }
}

void Exterior::FindPlaces()
{
  this->Places.assign(this->Mesh.Points.size(), Place::Inside);
  for (const Facet& facet : this->Table.Exterior)
  {
    for (int i = 0; i < facet.Size(); ++i)
    {
      this->Places[facet.Node[i]] = Place::Face;
    }
  }
  std::map<Id, std::vector<const Ridge*>> ridgesOfPoint;
  for (const Ridge& ridge : this->Ridges)
  {
    ridgesOfPoint[ridge.A].push_back(&ridge);
    ridgesOfPoint[ridge.B].push_back(&ridge);
  }
  for (const auto& entry : ridgesOfPoint)
  {
    Place& place = this->Places[entry.first];
    const auto sure = std::count_if(
      entry.second.begin(), entry.second.end(), [](const Ridge* r) { return r->Sure; });
    if (sure != static_cast<std::ptrdiff_t>(entry.second.size()))
    {
      place = Place::Doubtful;
      continue;
    }
    place = sure == 2 ? Place::Ridge : Place::Corner;
    if (sure == 2)
    {
      Vec3 direction[2];
      for (int i = 0; i < 2; ++i)
      {
        const Ridge* r = entry.second[i];
        const Id other = r->A == entry.first ? r->B : r->A;
        direction[i] = (this->Mesh.Points[other] - this->Mesh.Points[entry.first]).normalized();
      }
      const double turn =
        std::acos(std::clamp(-direction[0].dot(direction[1]), -1.0, 1.0)) * 180 / std::acos(-1.0);
      place = turn > SureAngle ? Place::Corner : turn > MaybeAngle ? Place::Doubtful : Place::Ridge;
    }
  }
}

Id Exterior::BinOf(const Vec3& p, int dx, int dy, int dz) const
{
  const Vec3 q = (p - this->Low) / this->BinSize;
  const Id x = static_cast<Id>(std::floor(q[0])) + dx, y = static_cast<Id>(std::floor(q[1])) + dy,
           z = static_cast<Id>(std::floor(q[2])) + dz;
  return (x * 2097152 + y) * 2097152 + z;
}

void Exterior::FillBins()
{
  // The bin is as large as the largest facet: then 27 bins hold all that is near a point.
  double size = 0;
  this->Low = this->Mesh.Points.empty() ? Vec3::Zero() : this->Mesh.Points[0];
  for (const Facet& facet : this->Table.Exterior)
  {
    for (int i = 0; i < facet.Size(); ++i)
    {
      this->Low = this->Low.cwiseMin(this->Mesh.Points[facet.Node[i]]);
      size = std::max(
        size, (this->Mesh.Points[facet.Node[i]] - this->Mesh.Points[facet.Node[0]]).norm());
    }
  }
  this->BinSize = std::max(size, 1e-300);
  for (Id f = 0; f < static_cast<Id>(this->Table.Exterior.size()); ++f)
  {
    const Facet& facet = this->Table.Exterior[f];
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < facet.Size(); ++i)
    {
      middle += this->Mesh.Points[facet.Node[i]] / facet.Size();
    }
    this->FacetBins[this->BinOf(middle, 0, 0, 0)].push_back(f);
  }
  for (Id r = 0; r < static_cast<Id>(this->Ridges.size()); ++r)
  {
    const Vec3 middle =
      0.5 * (this->Mesh.Points[this->Ridges[r].A] + this->Mesh.Points[this->Ridges[r].B]);
    this->RidgeBins[this->BinOf(middle, 0, 0, 0)].push_back(r);
  }
}

double Exterior::Distance(const Vec3& p, int patch) const
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 27; ++i)
  {
    const auto bin = this->FacetBins.find(this->BinOf(p, i % 3 - 1, (i / 3) % 3 - 1, i / 9 - 1));
    if (bin == this->FacetBins.end())
    {
      continue;
    }
    for (Id f : bin->second)
    {
      if (patch >= 0 && this->FacetPatch[f] != patch)
      {
        continue;
      }
      best = std::min(best, DistanceToFacet(p, this->Table.Exterior[f], this->Mesh.Points));
      if (best == 0)
      {
        return 0;
      }
    }
  }
  return best;
}

double Exterior::RidgeDistance(const Vec3& p) const
{
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 27; ++i)
  {
    const auto bin = this->RidgeBins.find(this->BinOf(p, i % 3 - 1, (i / 3) % 3 - 1, i / 9 - 1));
    if (bin == this->RidgeBins.end())
    {
      continue;
    }
    for (Id r : bin->second)
    {
      best = std::min(best,
        DistanceToSegment(
          p, this->Mesh.Points[this->Ridges[r].A], this->Mesh.Points[this->Ridges[r].B]));
    }
  }
  return best;
}

}
