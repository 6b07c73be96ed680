/**
 * @file TrimSelection.h
 * @brief What the Pipeline Browser's selection means for the actions of the menu NURBSTrim.
 */
#ifndef TrimSelection_h
#define TrimSelection_h

#include <vector>

class vtkSMProxy;
class vtkSMSourceProxy;

/// One output of a source; Source is nullptr if there is none.
struct SelectedOutput
{
  vtkSMSourceProxy* Source = nullptr;
  int Port = 0;
};

/// A mesh, a surface, and the trim that is to lend its settings, if any.
struct TrimSelection
{
  SelectedOutput Mesh;
  SelectedOutput Surface;
  vtkSMSourceProxy* Trim = nullptr;

  bool IsComplete() const { return this->Mesh.Source && this->Surface.Source; }
};

/**
 * The trim, or the mesh and the surface, that are selected in the Pipeline Browser. With a trim
 * alone, the mesh and the surface are its inputs; with a trim and a surface, the mesh is what the
 * trim left.
 */
TrimSelection FindTrimSelection();

/// Is this a Trim Hexahedral Grid?
bool IsTrim(vtkSMProxy* proxy);

/// The trims whose result is the mesh of this one, directly or by way of other filters.
std::vector<vtkSMSourceProxy*> TrimsBefore(vtkSMSourceProxy* trim);

/// Has the proxy the values that its panel shows?
bool IsApplied(vtkSMProxy* proxy);

#endif
