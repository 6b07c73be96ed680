#include "Partitions.h"

#include <vtkDataArray.h>
#include <vtkUnstructuredGrid.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace judge
{
namespace
{
/// A grid whose cells are given to ranks.
class Partition
{
public:
  Partition(
    const Frame& box, vtkUnstructuredGrid* grid, vtkDataArray* statuses, int ranks, Dice& dice)
    : Box(box)
    , Grid(grid)
    , Statuses(statuses)
    , Ranks(ranks)
    , Random(dice)
    , Rank(grid->GetNumberOfCells(), 0)
  {
  }

  std::vector<int> Draw(const std::string& name)
  {
    using Method = void (Partition::*)();
    static const std::map<std::string, Method> methods{ { "slabs", &Partition::Slabs },
      { "checkerboard", &Partition::Checkerboard }, { "columns", &Partition::Columns },
      { "voronoi", &Partition::Voronoi } };
    const auto found = methods.find(name);
    if (found != methods.end())
    {
      (this->*found->second)();
    }
    else if (name == "singles" || name == "few")
    {
      this->SomeThatAreCut(name == "few" ? 5 : 1);
    }
    else
    {
      this->SetAll([&](vtkIdType c) { return this->ByStatus(name, c); });
    }
    return this->Rank;
  }

private:
  template <typename RankOf>
  void SetAll(const RankOf& rankOf)
  {
    for (vtkIdType c = 0; c < this->Grid->GetNumberOfCells(); ++c)
    {
      this->Rank[c] = rankOf(c);
    }
  }

  int Any() { return this->Random.Below(this->Ranks); }

  Vec3 LocalOf(vtkIdType c) const
  {
    return this->Box.Axes.transpose() * (CentreOf(this->Grid, c) - this->Box.Centre);
  }

  bool IsCut(vtkIdType c) { return this->StatusOf(c) == 2; }

  int StatusOf(vtkIdType c)
  {
    return this->Statuses ? static_cast<int>(this->Statuses->GetComponent(c, 0))
                          : this->Random.Below(3);
  }

  int ByStatus(const std::string& name, vtkIdType c)
  {
    if (name == "sides")
    {
      return std::min(this->Ranks - 1, this->StatusOf(c));
    }
    if (name == "cut")
    {
      return this->IsCut(c) ? this->Any() : 0;
    }
    return name == "last" ? this->Ranks - 1 : this->Any();
  }

  void Slabs()
  {
    const Vec3 axis =
      Vec3(this->Random.Any() - 0.5, this->Random.Any() - 0.5, this->Random.Any() - 0.5);
    const vtkIdType count = this->Grid->GetNumberOfCells();
    std::vector<std::pair<double, vtkIdType>> places;
    for (vtkIdType c = 0; c < count; ++c)
    {
      places.emplace_back(this->LocalOf(c).dot(axis), c);
    }
    std::sort(places.begin(), places.end());
    for (vtkIdType i = 0; i < count; ++i)
    {
      this->Rank[places[i].second] = static_cast<int>(i * this->Ranks / count);
    }
  }

  void Checkerboard()
  {
    const double size = this->Box.ElementSize;
    const double layer = this->Box.LayerThickness > 0 ? this->Box.LayerThickness : size;
    this->SetAll(
      [&](vtkIdType c)
      {
        const Vec3 p = this->LocalOf(c);
        const long sum = std::lround(std::floor(p[0] / size)) +
          std::lround(std::floor(p[1] / size)) + std::lround(std::floor(p[2] / layer));
        return static_cast<int>(((sum % this->Ranks) + this->Ranks) % this->Ranks);
      });
  }

  void Columns()
  {
    std::map<std::pair<long, long>, int> rankOf;
    this->SetAll(
      [&](vtkIdType c)
      {
        const Vec3 p = this->LocalOf(c) / this->Box.ElementSize;
        const auto column =
          std::make_pair(std::lround(std::floor(p[0])), std::lround(std::floor(p[1])));
        return rankOf.emplace(column, this->Any()).first->second;
      });
  }

  void Voronoi()
  {
    std::vector<Vec3> seeds;
    for (int i = 0; i < 3 * this->Ranks; ++i)
    {
      const auto count = static_cast<int>(this->Grid->GetNumberOfCells());
      seeds.push_back(CentreOf(this->Grid, this->Random.Below(count)));
    }
    this->SetAll(
      [&](vtkIdType c)
      {
        const Vec3 p = CentreOf(this->Grid, c);
        const auto nearest = std::min_element(seeds.begin(), seeds.end(),
          [&p](const Vec3& a, const Vec3& b) { return (a - p).norm() < (b - p).norm(); });
        return static_cast<int>(nearest - seeds.begin()) % this->Ranks;
      });
  }

  /// So many on each rank but the first, which has the others.
  void SomeThatAreCut(int each)
  {
    std::vector<vtkIdType> cut;
    for (vtkIdType c = 0; c < this->Grid->GetNumberOfCells(); ++c)
    {
      if (this->IsCut(c))
      {
        cut.push_back(c);
      }
    }
    const auto count = static_cast<int>(this->Grid->GetNumberOfCells());
    for (int r = 1; r < this->Ranks; ++r)
    {
      for (int i = 0; i < each; ++i)
      {
        this->Rank[cut.empty() ? this->Random.Below(count) : this->Random.Pick(cut)] = r;
      }
    }
  }

  const Frame& Box;
  vtkUnstructuredGrid* Grid;
  vtkDataArray* Statuses;
  int Ranks;
  Dice& Random;
  std::vector<int> Rank;
};
}

//------------------------------------------------------------------------------
const std::vector<std::string>& RandomPartitions()
{
  static const std::vector<std::string> names{ "slabs", "scattered", "checkerboard", "voronoi",
    "singles", "few", "sides", "cut", "last", "columns" };
  return names;
}

//------------------------------------------------------------------------------
std::vector<int> DrawPartition(const std::string& name, const Mesh& mesh, vtkUnstructuredGrid* grid,
  vtkDataArray* statuses, int ranks, Dice& dice)
{
  return Partition(mesh.Box, grid, statuses, ranks, dice).Draw(name);
}
}
