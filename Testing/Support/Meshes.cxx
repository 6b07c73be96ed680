#include "Meshes.h"

#include "Plan.h"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <random>
#include <stdexcept>

namespace judge
{
namespace
{
// One of the 24 ways (wedge: 6) to number the same element.
void Turn(Element& element, std::mt19937& random)
{
  static const int hex[2][8] = { { 1, 2, 3, 0, 5, 6, 7, 4 }, { 4, 5, 1, 0, 7, 6, 2, 3 } };
  static const int wedge[2][8] = { { 1, 2, 0, 4, 5, 3, 6, 7 }, { 3, 5, 4, 0, 2, 1, 6, 7 } };
  for (unsigned n = random() % 7; n > 0; --n)
  {
    const int* turn = (element.Size == 8 ? hex : wedge)[random() % 2];
    const Element old = element;
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] = old.Node[turn[i]];
    }
  }
}

RawMesh Permute(const RawMesh& raw, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<Id> order(raw.Points.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), random);
  RawMesh out;
  out.Points.resize(raw.Points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    out.Points[order[i]] = raw.Points[i];
  }
  out.Elements = raw.Elements;
  std::shuffle(out.Elements.begin(), out.Elements.end(), random);
  for (Element& element : out.Elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] = order[element.Node[i]];
    }
    Turn(element, random);
  }
  return out;
}

vtkSmartPointer<vtkUnstructuredGrid> ToGrid(const RawMesh& input, const MeshOptions& options)
{
  const RawMesh raw = options.Permuted ? Permute(input, options.Seed) : input;
  vtkNew<vtkPoints> points;
  points->SetDataType(options.Float ? VTK_FLOAT : VTK_DOUBLE);
  for (const Vec3& p : raw.Points)
  {
    const Vec3 q = options.Scale * p + options.Shift;
    points->InsertNextPoint(q.data());
  }
  vtkNew<vtkCellArray> cells;
  options.Short ? cells->Use32BitStorage() : cells->Use64BitStorage();
  vtkNew<vtkUnsignedCharArray> types;
  for (const Element& element : raw.Elements)
  {
    cells->InsertNextCell(element.Size);
    for (int i = 0; i < element.Size; ++i)
    {
      cells->InsertCellPoint(element.Node[i]);
    }
    types->InsertNextValue(element.Size == 8 ? VTK_HEXAHEDRON : VTK_WEDGE);
  }
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  grid->SetCells(types, cells);
  if (options.Data)
  {
    AddData(grid, options.Seed);
  }
  return grid;
}

}

Mesh Finish(const std::string& name, const RawMesh& raw, Frame frame, const MeshOptions& options)
{
  Mesh mesh;
  mesh.Name = name;
  mesh.Grid = ToGrid(raw, options);
  frame.Centre = options.Scale * frame.Centre + options.Shift;
  frame.HalfX *= options.Scale;
  frame.HalfY *= options.Scale;
  frame.HalfZ *= options.Scale;
  frame.ElementSize *= options.Scale;
  frame.LayerThickness *= options.Scale;
  mesh.Box = frame;
  return mesh;
}

Frame BoxOf(const RawMesh& raw, double elementSize)
{
  Vec3 low = raw.Points[0], high = low;
  for (const Vec3& p : raw.Points)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Frame frame;
  frame.Centre = (low + high) / 2;
  frame.HalfX = (high[0] - low[0]) / 2;
  frame.HalfY = (high[1] - low[1]) / 2;
  frame.HalfZ = (high[2] - low[2]) / 2;
  frame.ElementSize = elementSize;
  return frame;
}

namespace
{
Mesh FromPlan(const std::string& name, const Plan& plan, int nz, double thickness, const Fold& fold,
  const MeshOptions& options)
{
  const RawMesh raw = Extrude(plan, nz, thickness, fold);
  Frame frame = BoxOf(raw, 1);
  frame.LayerThickness = thickness / nz;
  return Finish(name, raw, frame, options);
}
}

void RawMesh::Add(int size, std::initializer_list<Id> nodes)
{
  Element element;
  element.Size = size;
  std::copy(nodes.begin(), nodes.end(), element.Node.begin());
  this->Elements.push_back(element);
}

Mesh Sheet(int nx, int ny, int nz, const Vec3& element, const MeshOptions& options)
{
  Plan plan = GridPlan(nx, ny, element[0], element[1]);
  plan.Perturb(options.Perturbed * std::min(element[0], element[1]), options.Seed);
  Mesh mesh = FromPlan("sheet", plan, nz, nz * element[2], Flat(), options);
  mesh.Box.ElementSize = options.Scale * std::max(element[0], element[1]);
  mesh.Regular = !options.Permuted && options.Perturbed == 0;
  mesh.Nx = nx;
  mesh.Ny = ny;
  mesh.Nz = nz;
  return mesh;
}

Mesh Sheets(int nx, int ny, int nz, double layer, const std::vector<Vec3>& shifts)
{
  const RawMesh one = Extrude(GridPlan(nx, ny, 1, 1), nz, nz * layer, Flat());
  RawMesh raw;
  for (const Vec3& shift : shifts)
  {
    const auto before = static_cast<Id>(raw.Points.size());
    for (const Vec3& point : one.Points)
    {
      raw.Points.push_back(point + shift);
    }
    for (Element element : one.Elements)
    {
      for (Id& node : element.Node)
      {
        node += before;
      }
      raw.Elements.push_back(element);
    }
  }
  Frame frame = BoxOf(raw, 1);
  frame.LayerThickness = layer;
  MeshOptions plain;
  plain.Data = false;
  return Finish("sheets", raw, frame, plain);
}

Mesh TwoSheets(int nx, int ny, int nz, double layer, const Vec3& shift)
{
  return Sheets(nx, ny, nz, layer, { Vec3::Zero(), shift });
}

Mesh Block(int nx, int ny, int nz, const MeshOptions& options)
{
  Mesh mesh = FromPlan("block", GridPlan(nx, ny, 1, 1), nz, nz, Flat(), options);
  mesh.Sheet = false;
  mesh.Box.LayerThickness = 0;
  return mesh;
}

Mesh LShape(int n, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(n, n, 1, 1);
  plan.Keep([n](const Vec2& c) { return c[0] < 0.45 * n || c[1] < 0.45 * n; });
  return FromPlan("lshape", plan, nz, 0.4 * nz, Flat(), options);
}

Mesh PlateWithHole(int n, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(n, n, 1, 1);
  plan.Keep(
    [n](const Vec2& c) { return (c - 0.4 * n * Vec2::Ones()).cwiseAbs().maxCoeff() > 0.16 * n; });
  return FromPlan("hole", plan, nz, 0.4 * nz, Flat(), options);
}

Mesh Islands(int n, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(3 * n + 2, n, 1, 1);
  plan.Keep([n](const Vec2& c) { return std::fmod(c[0], n + 1) < n; });
  return FromPlan("islands", plan, nz, 0.4 * nz, Flat(), options);
}

Mesh SheetWithWedges(int nx, int ny, int nz, const MeshOptions& options)
{
  Plan plan = GridPlan(nx, ny, 1, 1);
  plan.SplitSome(0.25, options.Seed);
  return FromPlan("wedges", plan, nz, 0.4 * nz, Flat(), options);
}

Mesh Irregular(int n, int nz, const MeshOptions& options)
{
  return FromPlan("irregular", TriangleQuadPlan(n, options.Seed), nz, 0.4 * nz, Flat(), options);
}

Mesh Blank(int n, int rings, int nz, const MeshOptions& options)
{
  Mesh mesh = FromPlan("blank", BlankPlan(n, rings), nz, 0.4 * nz, Flat(), options);
  mesh.BorderTurn = M_PI / (2 * n);
  return mesh;
}

Mesh Channel(int n, int nz, const MeshOptions& options)
{
  // Bottom, bend, wall, bend, flange; radii of two elements.
  const Walk walk({ { 4, 0 }, { M_PI, 0.5 }, { 5, 0 }, { M_PI, -0.5 }, { 4, 0 } });
  const double half = walk.Length();
  const int along = 2 * static_cast<int>(std::lround(half));
  Plan plan = GridPlan(along, n, 2 * half / along, 1);
  const Fold fold = [walk, half](const Vec2& p, double z)
  {
    const Vec3 at = walk.At(std::abs(p[0] - half), z);
    return Vec3(p[0] < half ? -at[0] : at[0], p[1], at[2]);
  };
  Mesh mesh = FromPlan("channel", plan, nz, 0.4 * nz, fold, options);
  mesh.Flat = false;
  return mesh;
}

namespace
{
Fold Revolve(const Walk& walk)
{
  return [walk](const Vec2& p, double z)
  {
    const double r = p.norm();
    const Vec3 at = walk.At(r, z);
    const Vec2 direction = r > 0 ? Vec2(p / r) : Vec2(Vec2::Zero());
    return Vec3(at[0] * direction[0], at[0] * direction[1], at[2]);
  };
}
}

Mesh Dome(int n, int nz, const MeshOptions& options)
{
  const Plan plan = BlankPlan(n, n);
  const Walk walk({ { plan.Radius(), 1 / plan.Radius() } });
  Mesh mesh = FromPlan("dome", plan, nz, 0.4 * nz, Revolve(walk), options);
  mesh.Flat = false;
  return mesh;
}

Mesh Cup(int n, int nz, const MeshOptions& options)
{
  const Plan plan = BlankPlan(n, 3 * n / 2);
  const double rest = plan.Radius() - 2 * M_PI;
  const Walk walk(
    { { 0.5 * rest, 0 }, { M_PI, 0.5 }, { 0.3 * rest, 0 }, { M_PI, -0.5 }, { 0.2 * rest + 1, 0 } });
  Mesh mesh = FromPlan("cup", plan, nz, 0.4 * nz, Revolve(walk), options);
  mesh.Flat = false;
  return mesh;
}

Mesh PatchedSheet(int nx, int ny, int nz, const MeshOptions& options)
{
  const auto number = [&](Id i, Id j, Id k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  const auto isThere = [&](int i, int k) { return k < nz || 2 * i < nx; };
  RawMesh raw;
  std::vector<Id> own((nx + 1) * (ny + 1) * (2 * nz + 1), -1);
  for (int k = 0; k <= 2 * nz; ++k)
  {
    for (int j = 0; j <= ny; ++j)
    {
      for (int i = 0; i <= nx; ++i)
      {
        if (isThere(i, k - 1) || isThere(i - 1, k - 1) || k == 0)
        {
          own[number(i, j, k)] = static_cast<Id>(raw.Points.size());
          raw.Points.emplace_back(i, j, 0.4 * k);
        }
      }
    }
  }
  for (int k = 0; k < 2 * nz; ++k)
  {
    for (int j = 0; j < ny; ++j)
    {
      for (int i = 0; i < nx && isThere(i, k); ++i)
      {
        const auto at = [&](int di, int dj, int dk) { return own[number(i + di, j + dj, k + dk)]; };
        raw.Add(8,
          { at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), at(0, 0, 1), at(1, 0, 1),
            at(1, 1, 1), at(0, 1, 1) });
      }
    }
  }
  Frame frame = BoxOf(raw, 1);
  frame.LayerThickness = 0.4;
  return Finish("patched", raw, frame, options);
}

Mesh Segment(int nr, int nz, double angle, const MeshOptions& options)
{
  RawMesh raw;
  // Of each level the node on the axis, then two to a radius.
  const Id level = 1 + 2 * nr;
  for (int k = 0; k <= nz; ++k)
  {
    raw.Points.emplace_back(0, 0, k);
    for (int i = 1; i <= nr; ++i)
    {
      raw.Points.emplace_back(i, 0, k);
      raw.Points.emplace_back(i * std::cos(angle), i * std::sin(angle), k);
    }
  }
  for (Id k = 0; k < nz; ++k)
  {
    const Id a = k * level, b = a + level;
    raw.Add(6, { a, a + 1, a + 2, b, b + 1, b + 2 });
    for (Id i = 1; i < nr; ++i)
    {
      const Id r = 2 * i - 1;
      raw.Add(
        8, { a + r, a + r + 2, a + r + 3, a + r + 1, b + r, b + r + 2, b + r + 3, b + r + 1 });
    }
  }
  Mesh mesh = Finish("segment", raw, BoxOf(raw, 1), options);
  mesh.Sheet = false;
  return mesh;
}

Mesh ReadMesh(const std::string& path)
{
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  Mesh mesh;
  mesh.Name = path;
  mesh.Grid = reader->GetOutput();
  const Model model(mesh.Grid);
  if (model.Elements.empty() || model.BadCell >= 0)
  {
    throw std::invalid_argument(path + " is no grid of hexahedra and wedges");
  }
  double longest = 0;
  for (Id e = 0; e < static_cast<Id>(model.Elements.size()); ++e)
  {
    for (const Facet& facet : FacetsOf(model.Elements[e], e))
    {
      for (int i = 0; i < facet.Size(); ++i)
      {
        const Id next = facet.Node[(i + 1) % facet.Size()];
        longest = std::max(longest, (model.Points[next] - model.Points[facet.Node[i]]).norm());
      }
    }
  }
  RawMesh raw;
  raw.Points = model.Points;
  Frame& frame = mesh.Box = BoxOf(raw, longest);
  const Vec3 half(frame.HalfX, frame.HalfY, frame.HalfZ);
  Eigen::Index z = 0;
  half.minCoeff(&z);
  const Eigen::Index x = (z + 1) % 3, y = (z + 2) % 3;
  frame.Axes << Vec3::Unit(x), Vec3::Unit(y), Vec3::Unit(z);
  frame.HalfX = half[x];
  frame.HalfY = half[y];
  frame.HalfZ = half[z];
  mesh.Flat = mesh.Sheet = false;
  AddData(mesh.Grid, 1);
  return mesh;
}

namespace
{
template <typename Set>
MeshOptions With(const Set& set)
{
  MeshOptions options;
  set(options);
  return options;
}

const Vec3 UsualElement(1, 1, 0.4);

struct NamedMesh
{
  const char* Name;
  Mesh (*Make)();
};

const NamedMesh NamedMeshes[] = {
  { "sheet1", [] { return Sheet(20, 16, 1, UsualElement); } },
  { "sheet2", [] { return Sheet(20, 16, 2, UsualElement); } },
  { "sheet3", [] { return Sheet(16, 20, 3, Vec3(1, 1, 0.3)); } },
  { "sheet10", [] { return Sheet(14, 12, 10, Vec3(1, 1, 0.1)); } },
  { "permuted",
    []
    { return Sheet(20, 16, 2, UsualElement, With([](MeshOptions& o) { o.Permuted = true; })); } },
  { "float",
    [] {
      return Sheet(20, 16, 2, Vec3(1.1, 0.9, 0.37), With([](MeshOptions& o) { o.Float = true; }));
    } },
  { "short",
    []
    {
      return Sheet(
        16, 16, 2, UsualElement, With([](MeshOptions& o) { o.Short = o.Permuted = true; }));
    } },
  { "perturbed",
    []
    { return Sheet(20, 16, 2, UsualElement, With([](MeshOptions& o) { o.Perturbed = 0.2; })); } },
  { "irregular", [] { return Irregular(8, 2); } },
  { "block", [] { return Block(11, 10, 9); } },
  { "lshape", [] { return LShape(20, 2); } },
  { "hole", [] { return PlateWithHole(20, 2); } },
  { "islands", [] { return Islands(9, 2); } },
  { "wedges", [] { return SheetWithWedges(20, 16, 2); } },
  { "blank", [] { return Blank(10, 6, 2); } },
  { "channel", [] { return Channel(18, 2); } },
  { "dome", [] { return Dome(8, 2); } },
  { "cup", [] { return Cup(10, 2); } },
  { "stretched", [] { return Sheet(10, 40, 1, Vec3(20, 1, 0.2)); } },
  { "far",
    []
    {
      return Sheet(
        20, 16, 2, UsualElement, With([](MeshOptions& o) { o.Shift = Vec3(1e6, -1e6, 1e6); }));
    } },
  { "metres",
    [] { return Sheet(20, 16, 2, UsualElement, With([](MeshOptions& o) { o.Scale = 1e-3; })); } },
};
}

std::vector<std::string> MeshNames()
{
  std::vector<std::string> names;
  for (const NamedMesh& mesh : NamedMeshes)
  {
    names.emplace_back(mesh.Name);
  }
  return names;
}

Mesh MakeMesh(const std::string& name)
{
  const auto named = std::find_if(std::begin(NamedMeshes), std::end(NamedMeshes),
    [&name](const NamedMesh& mesh) { return name == mesh.Name; });
  Mesh mesh = named == std::end(NamedMeshes) ? MakePart(name) : named->Make();
  mesh.Name = name;
  return mesh;
}

}
