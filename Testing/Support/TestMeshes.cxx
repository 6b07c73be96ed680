/**
 * @file TestMeshes.cxx
 * @brief The tests' own input grids are what they claim: valid elements, closed manifold
 * exterior, sheets with a recognisable thickness.
 */
#include "Exterior.h"
#include "Meshes.h"

#include <algorithm>
#include <cstdio>

using namespace judge;

int main()
{
  int wrong = 0;
  for (const std::string& name : AllMeshNames())
  {
    const Mesh mesh = MakeMesh(name);
    const Model model(mesh.Grid);
    double least = 1e300;
    for (Id e = 0; e < static_cast<Id>(model.Elements.size()); ++e)
    {
      const auto corners = model.Corners(e);
      const auto bezier = BezierJacobians(corners, model.Elements[e].Size);
      least = std::min(least,
        *std::min_element(bezier.begin(), bezier.end()) /
          std::abs(VolumeOf(corners, model.Elements[e].Size)));
    }
    const Exterior border(model);
    const ManifoldDefects defects = FindManifoldDefects(border.Facets());
    int places[5] = { 0, 0, 0, 0, 0 };
    for (Id p = 0; p < static_cast<Id>(model.Points.size()); ++p)
    {
      ++places[static_cast<int>(border.PlaceOf(p))];
    }
    std::printf("%-10s %6zu points %6zu elements, least Bezier %.3f, places inside %d face %d "
                "ridge %d corner %d doubtful %d\n",
      name.c_str(), model.Points.size(), model.Elements.size(), least, places[0], places[1],
      places[2], places[3], places[4]);
    if (model.BadCell >= 0 || !(least > 0) || defects.Edges + defects.Vertices > 0)
    {
      std::printf("FAIL %s: not a valid mesh (%d edges, %d vertices)\n", name.c_str(),
        defects.Edges, defects.Vertices);
      ++wrong;
    }
    if (name == "sheet2" && (places[0] != 19 * 15 || places[3] != 8 || places[2] != 140))
    {
      std::printf("FAIL sheet2: its ridges and corners are not found\n");
      ++wrong;
    }
    if (mesh.Sheet && mesh.Box.LayerThickness <= 0)
    {
      std::printf("FAIL %s: has no thickness\n", name.c_str());
      ++wrong;
    }
  }
  return wrong > 0;
}
