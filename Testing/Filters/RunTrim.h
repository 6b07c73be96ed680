/**
 * @file RunTrim.h
 * @brief Runs the filter on one trial and hears what it says.
 */
#ifndef RunTrim_h
#define RunTrim_h

#include "Checks.h"

class vtkTrimHexahedralGrid;

namespace judge
{
struct Outcome
{
  Trial Case;
  vtkSmartPointer<vtkUnstructuredGrid> Offcut; ///< port 2
  std::vector<std::string> Errors, Warnings;   ///< whatever reached VTK's output window
  bool Clean() const { return this->Errors.empty(); }
};

/// Catches errors and warnings instead of printing them, for as long as it lives.
class Listener
{
public:
  Listener();
  ~Listener();
  std::vector<std::string> Errors() const;
  std::vector<std::string> Warnings() const;

private:
  struct Window;
  Window* Own;
};

void SetOptions(vtkTrimHexahedralGrid* filter, const TrimOptions& options);

/// One run with a fresh filter; outputs are detached from it.
Outcome RunTrim(const Mesh& mesh, const Surface& surface, const TrimOptions& options);

/// An entry of the summary in a grid's field data.
double Number(vtkUnstructuredGrid* grid, const char* name);

/// The number that the warning with this phrase begins with; 0 without such a warning.
int CountWarned(const Outcome& outcome, const std::string& phrase);

/// Nodes of a trimmed grid that were left off the surface.
int CountLeft(vtkUnstructuredGrid* trimmed);

/// The rungs of the validity ladder that the summary counts, as "name=count ..."; empty: none.
std::string Rescues(vtkUnstructuredGrid* trimmed);

/// Runs, judges everything, and reports errors as failures too.
Outcome RunAndJudge(
  const Mesh& mesh, const Surface& surface, const TrimOptions& options, Report& report);

/**
 * The trim and its counterpart with InvertSide, each judged, then both together.
 * @return the lowest scaled Jacobian of the elements that either touched; NaN: there are none.
 */
double JudgeBothSides(
  const Mesh& mesh, const Surface& surface, TrimOptions options, Report& report);

}

#endif
