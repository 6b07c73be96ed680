/**
 * @file ReadTesting.h
 * @brief What the tests of Filters/Read share: checks, captured errors, faces read back.
 */
#ifndef ReadTesting_h
#define ReadTesting_h

#include "NurbsSurface.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <iostream>
#include <string>
#include <vector>

class vtkMultiBlockDataSet;
class vtkObject;
class vtkPolyData;
class vtkPolyDataAlgorithm;

/// Checks that have failed so far; the exit status of a test.
extern int Failures;

#define CHECK(condition, message)                                                                  \
  do                                                                                               \
  {                                                                                                \
    if (!(condition))                                                                              \
    {                                                                                              \
      ++Failures;                                                                                  \
      std::cerr << __FILE__ << ":" << __LINE__ << ": " << #condition << " fails: " << message      \
                << "\n";                                                                           \
    }                                                                                              \
  } while (false)

/// Catches the errors and warnings of a VTK object, which are then not printed.
class ErrorCapture : public vtkCommand
{
public:
  static ErrorCapture* New() { return new ErrorCapture; }
  void Watch(vtkObject* object);
  void Execute(vtkObject* caller, unsigned long event, void* data) override;

  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};

/**
 * Checks that a source, valid at first, gives one error and nothing else once it is spoiled.
 *
 * @param part what the error has to say.
 */
void CheckRefusal(
  vtkPolyDataAlgorithm* source, const std::string& part, const std::function<void()>& spoil);

/// What vtkCADSurfaceReader makes of a file.
struct ReadResult
{
  vtkSmartPointer<vtkMultiBlockDataSet> Output;
  std::vector<nurbs::NurbsSurface> Surfaces;
  std::vector<std::string> Names;
  std::vector<std::string> Errors;
  std::vector<std::string> Warnings;
};
/// `timeLimit`: processor seconds, 0: the reader's own.
ReadResult ReadFile(const std::string& path, int lengthUnit = 0, double timeLimit = 0.0);

/// Reads and checks that there are so many faces, without errors and warnings.
ReadResult ReadFaces(const std::string& path, size_t faces, int lengthUnit = 0);

/// Is (u, v) on the surface, that is inside its trim loops, by the even-odd rule?
bool IsInside(const nurbs::NurbsSurface& surface, double u, double v);

/// S_u x S_v, of length one.
nurbs::Vec3 UnitNormal(const nurbs::NurbsSurface& surface, double u, double v);

/// Area inside the trim loops, by the midpoint rule on a grid of n x n places.
double Area(const nurbs::NurbsSurface& surface, int n = 400);

/// A path in the directory of this test run.
std::string OutputPath(const std::string& name);

void WriteText(const std::string& path, const std::string& text);
std::string ReadText(const std::string& path);

#endif
