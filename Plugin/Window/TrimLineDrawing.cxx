#include "TrimLineDrawing.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqPipelineSource.h"
#include "pqProxyModifiedStateUndoElement.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"

#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSmartPointer.h"

#include <array>
#include <vector>

namespace
{
constexpr int PointCount = 5;
/// How far the line begins and ends beyond the mesh, as a share of its longest extent.
constexpr double Beyond = 0.05;

/// x y z of each point, by the bounds of the mesh.
std::vector<double> PlacePoints(const double bounds[6])
{
  std::array<double, 3> extent;
  int longest = 0, least = 0;
  for (int i = 0; i < 3; ++i)
  {
    extent[i] = bounds[2 * i + 1] - bounds[2 * i];
    longest = extent[i] > extent[longest] ? i : longest;
    least = extent[i] < extent[least] ? i : least;
  }
  std::vector<double> points;
  for (int k = 0; k < PointCount; ++k)
  {
    const double share = (1.0 + 2.0 * Beyond) * k / (PointCount - 1) - Beyond;
    for (int i = 0; i < 3; ++i)
    {
      const double middle = bounds[2 * i] + 0.5 * extent[i];
      const double across = i == least ? bounds[2 * i + 1] : middle;
      points.push_back(i == longest ? bounds[2 * i] + share * extent[i] : across);
    }
  }
  return points;
}

/// The panel asks for Apply; so it does when the source comes back by Redo.
void AskForApply(pqPipelineSource* source)
{
  source->setModifiedState(pqProxy::UNINITIALIZED);
  vtkNew<pqProxyModifiedStateUndoElement> element;
  element->SetSession(source->getServer()->session());
  element->MadeUninitialized(source);
  ADD_UNDO_ELEM(element);
}
}

//------------------------------------------------------------------------------
SelectedOutput TrimLineDrawing::FindMesh()
{
  const TrimSelection selection = FindTrimSelection();
  return selection.Trim ? SelectedOutput{ selection.Trim, selection.TrimPort } : selection.Mesh;
}

//------------------------------------------------------------------------------
void TrimLineDrawing::Start(const SelectedOutput& mesh)
{
  vtkSMSessionProxyManager* manager = mesh.Source->GetSessionProxyManager();
  const auto line =
    vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("sources", "TrimLineSource"));
  if (!line)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->PreInitializeProxy(line);
  vtkSMPropertyHelper(line, "Sheet").Set(mesh.Source, static_cast<unsigned int>(mesh.Port));
  const std::vector<double> points =
    PlacePoints(mesh.Source->GetDataInformation(mesh.Port)->GetBounds());
  vtkSMPropertyHelper(line, "Points").Set(points.data(), static_cast<unsigned int>(points.size()));
  controller->PostInitializeProxy(line);
  line->UpdateVTKObjects();
  controller->RegisterPipelineProxy(line);
  auto* source =
    pqApplicationCore::instance()->getServerManagerModel()->findItem<pqPipelineSource*>(
      line.GetPointer());
  if (source)
  {
    AskForApply(source);
    pqActiveObjects::instance().setActiveSource(source);
  }
}
