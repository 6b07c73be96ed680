#include "Meshes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>

namespace judge
{
namespace
{

using Tetrahedron = std::array<Vec3, 4>;

class Divider
{
public:
  void Divide(const Tetrahedron& corners)
  {
    for (const auto& [a, b, c, d] :
      { std::array<int, 4>{ 0, 1, 2, 3 }, { 1, 0, 3, 2 }, { 2, 3, 0, 1 }, { 3, 2, 1, 0 } })
    {
      const auto node = [&, this](std::initializer_list<int> of)
      {
        Vec3 mean = Vec3::Zero();
        for (const int i : of)
        {
          mean += corners[i] / static_cast<double>(of.size());
        }
        return this->NodeAt(mean);
      };
      this->Raw.Add(8,
        { node({ a }), node({ a, b }), node({ a, b, c }), node({ a, c }), node({ a, d }),
          node({ a, b, d }), node({ a, b, c, d }), node({ a, c, d }) });
    }
  }

  RawMesh Raw;

private:
  Id NodeAt(const Vec3& place)
  {
    // All places are multiples of a twelfth.
    const std::array<long, 3> key{ std::lround(12 * place[0]), std::lround(12 * place[1]),
      std::lround(12 * place[2]) };
    const auto [known, isNew] = this->Nodes.emplace(key, this->Raw.Points.size());
    if (isNew)
    {
      this->Raw.Points.push_back(place);
    }
    return known->second;
  }

  std::map<std::array<long, 3>, Id> Nodes;
};

/// Along the edges of a cube from one corner to the opposite one, in this order of the axes.
Tetrahedron Along(const Vec3& from, const std::array<int, 3>& axes)
{
  Tetrahedron corners{ from, from, from, from };
  for (int i = 0; i < 3; ++i)
  {
    corners[i + 1] = corners[i] + Vec3::Unit(axes[i]);
  }
  const Vec3 a = corners[1] - from, b = corners[2] - from, c = corners[3] - from;
  if (a.dot(b.cross(c)) < 0)
  {
    std::swap(corners[1], corners[2]);
  }
  return corners;
}

}

Mesh DividedTetrahedra(int n, double bulge, const MeshOptions& options)
{
  Divider divider;
  for (int cube = 0; cube < n * n * n; ++cube)
  {
    std::array<int, 3> axes{ 0, 1, 2 };
    do
    {
      divider.Divide(Along(Vec3(cube % n, cube / n % n, cube / n / n), axes));
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  for (Vec3& point : divider.Raw.Points)
  {
    const Vec3 at = 2.0 / n * point - Vec3::Ones(); // from -1 to 1
    const Vec3 inside = Vec3::Ones() - at.cwiseProduct(at);
    for (int i = 0; i < 3; ++i)
    {
      point[i] += bulge * at[i] * inside[(i + 1) % 3] * inside[(i + 2) % 3];
    }
  }
  Mesh mesh = Finish("divided", divider.Raw, BoxOf(divider.Raw, 0.5), options);
  mesh.Sheet = false;
  mesh.Flat = bulge == 0;
  mesh.Box.LayerThickness = 0;
  return mesh;
}

}
