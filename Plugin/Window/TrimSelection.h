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
  int TrimPort = 0; ///< its output that can be trimmed next: the trimmed grid or the offcut

  bool IsComplete() const { return this->Mesh.Source && this->Surface.Source; }
};

/**
 * The trim, or the mesh and the surface, that are selected in the Pipeline Browser. With a trim
 * alone, the mesh and the surface are its inputs; with a trim and a surface, the mesh is what the
 * trim left, or its offcut, if that is selected.
 */
TrimSelection FindTrimSelection();

/// The third output of a trim.
constexpr int OffcutPort = 2;

/// Is this a Trim Hexahedral Grid?
bool IsTrim(vtkSMProxy* proxy);

/// Has the server that is connected the plugin's filters? They are not there if only the client has
/// loaded the plugin.
bool HasServerPlugin();

/// What the mesh of this source was made of, directly or by way of other filters.
std::vector<vtkSMSourceProxy*> SourcesBefore(vtkSMSourceProxy* source);

/// The trims whose result is the mesh of this source, directly or by way of other filters.
std::vector<vtkSMSourceProxy*> TrimsBefore(vtkSMSourceProxy* source);

/// Has the proxy the values that its panel shows?
bool IsApplied(vtkSMProxy* proxy);

#endif
