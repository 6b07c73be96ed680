/**
 * @file LineTesting.h
 * @brief What the tests of curve files share: the lines that vtkTrimLineSource makes of a file.
 */
#ifndef LineTesting_h
#define LineTesting_h

#include "NurbsSurface.h"

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkTrimLineSource;

struct LineResult
{
  vtkSmartPointer<vtkDataObject> Output;
  std::vector<nurbs::NurbsSurface> Surfaces;
  std::vector<std::string> Errors, Warnings;
};

using Adjust = std::function<void(vtkTrimLineSource*)>;

/// Swept along z, if `adjust` does not say otherwise.
LineResult ReadLines(const std::string& path, const Adjust& adjust = Adjust());

/// Reads without errors and warnings, and checks the number of lines.
LineResult ReadGood(const std::string& path, size_t lines, const Adjust& adjust = Adjust());

/// Places on the line itself, the middle of the sweep, ends included.
std::vector<nurbs::Vec3> Places(const nurbs::NurbsSurface& surface, int count = 200);

/// Largest value of a function that vanishes on the line.
double LargestResidual(
  const nurbs::NurbsSurface& surface, const std::function<double(const nurbs::Vec3&)>& form);

#endif
