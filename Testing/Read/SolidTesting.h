/**
 * @file SolidTesting.h
 * @brief What the tests of random solids share: whether OpenCASCADE can write and read one, and
 * whether a file's surface has the points on the sides on which the solid has them.
 */
#ifndef SolidTesting_h
#define SolidTesting_h

#include "NurbsSurface.h"

#include <string>
#include <vector>

class TopoDS_Shape;
struct ReadResult;

/// Lets no translator print.
void SilenceTranslators();

/// Bodies as one shape, not united.
TopoDS_Shape Together(const std::vector<TopoDS_Shape>& bodies);

void WriteStep(const TopoDS_Shape& shape, const std::string& path);

/// @param withBodies else as faces that are of no body.
void WriteIges(const TopoDS_Shape& shape, const std::string& path, bool withBodies);

/// Whether the one warning of a reader is that bodies could not be joined.
bool TellsOfUnjoined(const ReadResult& read);

/// Whether a shape is one that OpenCASCADE itself reads as it wrote it.
/// @param path of the STEP file that it writes.
/// @param read the shape of the file.
bool IsSound(const TopoDS_Shape& shape, const std::string& path, TopoDS_Shape& read);

/// Checks that each point is on the side of the surface read on which the solids have it.
void CheckSides(const std::string& name, const std::string& path, const TopoDS_Shape& shape,
  const std::vector<nurbs::Vec3>& points);

/// Whether the surface read is where the solids of a shape, taken together, have their boundary: of
/// places all over it the side of the normal is in none of them, the other in one.
/// @param share of the places that may be elsewhere.
bool IsBoundary(
  const std::string& name, const std::string& path, const TopoDS_Shape& shape, double share = 0.0);

/// Checks that the surfaces of two files are as far from each point.
void CheckSameDistances(const std::string& name, const std::string& path, const std::string& other,
  const std::vector<nurbs::Vec3>& points);

double AreaOf(const TopoDS_Shape& shape);

/// The length of the box from corner to corner.
double SizeOf(const TopoDS_Shape& shape, nurbs::Vec3& low, nurbs::Vec3& high);

#endif
