#include "CellMeasure.h"

#include "Jacobian.h"

#include <cmath>

// Several variants, of which the one for the processor is taken when the library is loaded, which
// sanitizers are not ready for. All of them round alike: see Stages.cmake.
#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&       \
  !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
#define NURBSTRIM_FOR_EACH_PROCESSOR __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define NURBSTRIM_FOR_EACH_PROCESSOR
#endif

namespace trim
{
namespace
{

constexpr int Cells = CellRow::Cells;
static_assert(Cells == 2 * CellsPerBox, "lanes are added by halves of a row");

struct Coordinates
{
  double X, Y, Z;

  friend EIGEN_ALWAYS_INLINE Coordinates operator-(const Coordinates& a, const Coordinates& b)
  {
    return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
  }
  friend EIGEN_ALWAYS_INLINE Coordinates operator+(const Coordinates& a, const Coordinates& b)
  {
    return { a.X + b.X, a.Y + b.Y, a.Z + b.Z };
  }
};

EIGEN_ALWAYS_INLINE double Determinant(
  const Coordinates& a, const Coordinates& b, const Coordinates& c)
{
  return (a.Y * b.Z - a.Z * b.Y) * c.X + (a.Z * b.X - a.X * b.Z) * c.Y +
    (a.X * b.Y - a.Y * b.X) * c.Z;
}

/// Coordinate by coordinate, so that those of neighbours are side by side.
struct Places
{
  double At[3][4][Cells + 1];
};

EIGEN_ALWAYS_INLINE void FindPlaces(const RowPoints& points, Places& places)
{
  for (int i = 0; i < 4; ++i)
  {
    const double* const line = points.Lines[i];
    for (int s = 0; s <= Cells; ++s)
    {
      places.At[0][i][s] = line[3 * s];
      places.At[1][i][s] = line[3 * s + 1];
      places.At[2][i][s] = line[3 * s + 2];
    }
  }
}

/// Where the nodes of a cell are in its row: the line, and how far behind the cell's place.
struct NodePlace
{
  int Line, Behind;
};
constexpr std::array<NodePlace, 8> PlacesOf(const RowAxis& axis)
{
  std::array<NodePlace, 8> places{};
  for (int i = 0; i < 4; ++i)
  {
    places[axis.Begin[i]] = { i, 0 };
    places[axis.End[i]] = { i, 1 };
  }
  return places;
}

EIGEN_ALWAYS_INLINE double Less(double a, double b)
{
  return b < a ? b : a;
}
EIGEN_ALWAYS_INLINE double Greater(double a, double b)
{
  return a < b ? b : a;
}

EIGEN_ALWAYS_INLINE double VolumeOfCorners(const Coordinates (&p)[8])
{
  return HexahedronVolume(p,
    [](const Coordinates& a, const Coordinates& b, const Coordinates& c)
    { return Determinant(a, b, c); });
}

template <int Axis>
EIGEN_ALWAYS_INLINE double VolumeAt(const Places& points, int c)
{
  constexpr std::array<NodePlace, 8> places = PlacesOf(RowAxes[Axis]);
  Coordinates p[8];
  for (int k = 0; k < 8; ++k)
  {
    const int at = c + places[k].Behind;
    const int line = places[k].Line;
    p[k] = { points.At[0][line][at], points.At[1][line][at], points.At[2][line][at] };
  }
  return VolumeOfCorners(p);
}

template <int Axis>
EIGEN_ALWAYS_INLINE void FindVolumes(const Places& points, double* volumes, CellSizes& sizes)
{
  double found[Cells];
  for (int c = 0; c < Cells; ++c)
  {
    found[c] = VolumeAt<Axis>(points, c);
  }
  for (int c = 0; c < Cells; ++c)
  {
    volumes[c] = std::abs(found[c]);
  }
  for (int c = 0; c < CellsPerBox; ++c)
  {
    sizes.Sum[c] += found[c] + found[c + CellsPerBox];
    sizes.LeastVolume[c] = Less(sizes.LeastVolume[c], Less(found[c], found[c + CellsPerBox]));
  }
}

/// Least and largest coordinates of the four nodes at each place of the row.
struct Faces
{
  double Low[3][Cells + 1], High[3][Cells + 1];
};

EIGEN_ALWAYS_INLINE void FindFaces(const Places& points, Faces& faces)
{
  for (int k = 0; k < 3; ++k)
  {
    const auto& at = points.At[k];
    for (int s = 0; s <= Cells; ++s)
    {
      faces.Low[k][s] = Less(Less(at[0][s], at[1][s]), Less(at[2][s], at[3][s]));
      faces.High[k][s] = Greater(Greater(at[0][s], at[1][s]), Greater(at[2][s], at[3][s]));
    }
  }
}

/// Of half a row.
EIGEN_ALWAYS_INLINE void FindBox(const Faces& faces, int first, CellBounds& box)
{
  for (int k = 0; k < 3; ++k)
  {
    box.Low[k] = faces.Low[k][first];
    box.High[k] = faces.High[k][first];
  }
  for (int s = first + 1; s <= first + CellsPerBox; ++s)
  {
    for (int k = 0; k < 3; ++k)
    {
      box.Low[k] = Less(box.Low[k], faces.Low[k][s]);
      box.High[k] = Greater(box.High[k], faces.High[k][s]);
    }
  }
}

/// Of as many cells as there are lanes, or twice as many.
template <int Count>
EIGEN_ALWAYS_INLINE void TakeLargest(const double (&values)[Count], CellSizes::Lanes& largest)
{
  for (int c = 0; c < CellsPerBox; ++c)
  {
    largest[c] = Greater(largest[c], Greater(values[c], values[c + Count - CellsPerBox]));
  }
}

/// @param sides of the cells' boxes.
template <int Count>
EIGEN_ALWAYS_INLINE void TakeSizes(const double (&sides)[3][Count], CellSizes& sizes)
{
  double squared[Count];
  for (int c = 0; c < Count; ++c)
  {
    squared[c] = sides[0][c] * sides[0][c] + sides[1][c] * sides[1][c] + sides[2][c] * sides[2][c];
  }
  for (int k = 0; k < 3; ++k)
  {
    TakeLargest(sides[k], sizes.Sides[k]);
  }
  TakeLargest(squared, sizes.Diagonal);
}

EIGEN_ALWAYS_INLINE void FindSizes(const Faces& faces, CellSizes& sizes)
{
  double sides[3][Cells];
  for (int k = 0; k < 3; ++k)
  {
    for (int c = 0; c < Cells; ++c)
    {
      sides[k][c] = Greater(faces.High[k][c], faces.High[k][c + 1]) -
        Less(faces.Low[k][c], faces.Low[k][c + 1]);
    }
  }
  TakeSizes(sides, sizes);
}

EIGEN_ALWAYS_INLINE void FindVolumes(
  const CellCorners& corners, double (&volumes)[CellsPerBox], CellSizes& sizes)
{
  for (int c = 0; c < CellsPerBox; ++c)
  {
    Coordinates p[8];
    for (int i = 0; i < 8; ++i)
    {
      p[i] = { corners.At[0][i][c], corners.At[1][i][c], corners.At[2][i][c] };
    }
    const double volume = VolumeOfCorners(p);
    volumes[c] = std::abs(volume);
    sizes.Sum[c] += volume;
    sizes.LeastVolume[c] = Less(sizes.LeastVolume[c], volume);
  }
}

/// The box of all cells and the sides of each one's.
EIGEN_ALWAYS_INLINE void FindBoxes(
  const CellCorners& corners, CellBounds& box, double (&sides)[3][CellsPerBox])
{
  for (int k = 0; k < 3; ++k)
  {
    const auto& at = corners.At[k];
    double low[CellsPerBox], high[CellsPerBox];
    for (int c = 0; c < CellsPerBox; ++c)
    {
      low[c] = Less(Less(Less(at[0][c], at[1][c]), Less(at[2][c], at[3][c])),
        Less(Less(at[4][c], at[5][c]), Less(at[6][c], at[7][c])));
      high[c] = Greater(Greater(Greater(at[0][c], at[1][c]), Greater(at[2][c], at[3][c])),
        Greater(Greater(at[4][c], at[5][c]), Greater(at[6][c], at[7][c])));
      sides[k][c] = high[c] - low[c];
    }
    box.Low[k] = low[0];
    box.High[k] = high[0];
    for (int c = 1; c < CellsPerBox; ++c)
    {
      box.Low[k] = Less(box.Low[k], low[c]);
      box.High[k] = Greater(box.High[k], high[c]);
    }
  }
}

}

NURBSTRIM_FOR_EACH_PROCESSOR
void MeasureRow(const RowPoints& points, int axis, double* volumes,
  CellBounds (&boxes)[Cells / CellsPerBox], CellSizes& sizes)
{
  Places places;
  FindPlaces(points, places);
  switch (axis)
  {
    case 0:
      FindVolumes<0>(places, volumes, sizes);
      break;
    case 1:
      FindVolumes<1>(places, volumes, sizes);
      break;
    default:
      FindVolumes<2>(places, volumes, sizes);
      break;
  }
  Faces faces;
  FindFaces(places, faces);
  FindSizes(faces, sizes);
  for (int half = 0; half < Cells / CellsPerBox; ++half)
  {
    FindBox(faces, half * CellsPerBox, boxes[half]);
  }
}

NURBSTRIM_FOR_EACH_PROCESSOR
void MeasureCells(
  const CellCorners& corners, double (&volumes)[CellsPerBox], CellBounds& box, CellSizes& sizes)
{
  FindVolumes(corners, volumes, sizes);
  double sides[3][CellsPerBox];
  FindBoxes(corners, box, sides);
  TakeSizes(sides, sizes);
}

}
