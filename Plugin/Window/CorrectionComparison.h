/**
 * @file CorrectionComparison.h
 * @brief Four linked views: the mesh before a trim, and after it with correction types I, II, III.
 */
#ifndef CorrectionComparison_h
#define CorrectionComparison_h

struct TrimSelection;
class vtkSMProxy;
class vtkSMViewProxy;

namespace CorrectionComparison
{
/**
 * Adds three trims of the mesh by the surface, one of each correction type and otherwise with the
 * settings of the selected trim, and a layout of four views with titles and legends: the statuses
 * of the whole mesh, and the three results, each with the surface [Fig. 5 of the paper]. The views
 * share one camera, at first that of the active view.
 */
void Show(const TrimSelection& selection);

/// Shows the legend of the array that a representation is coloured by.
void ShowLegend(vtkSMProxy* representation, vtkSMViewProxy* view);
}

#endif
