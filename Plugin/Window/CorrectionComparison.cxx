#include "CorrectionComparison.h"

#include "QuietWindow.h"
#include "TrimSelection.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include "vtkAlgorithm.h"
#include "vtkNew.h"
#include "vtkSMCameraLink.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewLayoutProxy.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <string>

namespace
{
constexpr int Types = 3;
constexpr int Views = Types + 1;
const std::array<const char*, Views> Titles = { "Before", "Type I: elements eliminated",
  "Type II: nodes projected", "Type III: nodes slid along edges" };

using Controller = vtkSMParaViewPipelineControllerWithRendering;

/// The pipeline's panel need not ask for Apply: all is set.
void MarkApplied(vtkSMProxy* proxy)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  if (auto* item = model->findItem<pqProxy*>(proxy))
  {
    item->setModifiedState(pqProxy::UNMODIFIED);
  }
}

void SetInput(vtkSMProxy* proxy, const char* name, const SelectedOutput& output)
{
  vtkSMPropertyHelper(proxy, name).Set(output.Source, output.Port);
}

vtkSMSourceProxy* AddTrim(Controller* controller, const TrimSelection& selection, int type)
{
  vtkSMSessionProxyManager* manager = selection.Mesh.Source->GetSessionProxyManager();
  auto trim = vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("filters", "TrimHexahedralGrid"));
  controller->PreInitializeProxy(trim);
  SetInput(trim, "Input", selection.Mesh);
  SetInput(trim, "TrimmingSurface", selection.Surface);
  controller->PostInitializeProxy(trim);
  {
    const std::string name =
      manager->GetUniqueProxyName("sources", ("Type" + std::string(type, 'I')).c_str(), false);
    controller->RegisterPipelineProxy(trim, name.c_str());
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", trim);
  if (selection.Trim)
  {
    trim->Copy(
      selection.Trim, "vtkSMInputProperty", vtkSMProxy::COPY_PROXY_PROPERTY_VALUES_BY_REFERENCE);
  }
  vtkSMPropertyHelper(trim, "CorrectionType").Set(type);
  trim->UpdateVTKObjects();
  MarkApplied(trim);
  return vtkSMSourceProxy::SafeDownCast(trim);
}

bool WasAborted(vtkSMSourceProxy* trim)
{
  auto* algorithm = vtkAlgorithm::SafeDownCast(trim->GetClientSideObject());
  return algorithm && algorithm->GetAbortExecute();
}

vtkSMRenderViewProxy* AddView(Controller* controller, vtkSMViewLayoutProxy* layout, int location)
{
  vtkSMSessionProxyManager* manager = layout->GetSessionProxyManager();
  auto view = vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("views", "RenderView"));
  controller->InitializeProxy(view);
  controller->RegisterViewProxy(view);
  auto* renderView = vtkSMRenderViewProxy::SafeDownCast(view);
  controller->AssignViewToLayout(renderView, layout, location);
  return renderView;
}

void AddTitle(Controller* controller, vtkSMViewProxy* view, const char* text)
{
  vtkSMSessionProxyManager* manager = view->GetSessionProxyManager();
  auto title = vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("sources", "TextSource"));
  controller->InitializeProxy(title);
  vtkSMPropertyHelper(title, "Text").Set(text);
  title->UpdateVTKObjects();
  controller->RegisterPipelineProxy(title, "Title");
  MarkApplied(title);
  vtkSMProxy* shown = controller->Show(vtkSMSourceProxy::SafeDownCast(title), 0, view);
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", shown);
  vtkSMPropertyHelper(shown, "WindowLocation").Set("Upper Center");
  shown->UpdateVTKObjects();
}

/// The surface, translucent, in a colour that no status has.
void AddSurface(Controller* controller, vtkSMViewProxy* view, const SelectedOutput& surface)
{
  vtkSMProxy* shown = controller->Show(surface.Source, surface.Port, view);
  if (!vtkSMPVRepresentationProxy::SafeDownCast(shown))
  {
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", shown);
  const double red[3] = { 0.84, 0.19, 0.15 };
  vtkSMPVRepresentationProxy::SetScalarColoring(shown, nullptr, 0);
  vtkSMPropertyHelper(shown, "AmbientColor").Set(red, 3);
  vtkSMPropertyHelper(shown, "DiffuseColor").Set(red, 3);
  vtkSMPropertyHelper(shown, "Opacity").Set(0.4);
  shown->UpdateVTKObjects();
}

/// Moving any of the views moves all.
void LinkCameras(const std::array<vtkSMRenderViewProxy*, Views>& views)
{
  vtkNew<vtkSMCameraLink> link;
  for (vtkSMRenderViewProxy* view : views)
  {
    link->AddLinkedProxy(view, vtkSMLink::INPUT);
    link->AddLinkedProxy(view, vtkSMLink::OUTPUT);
  }
  vtkSMSessionProxyManager* manager = views[0]->GetSessionProxyManager();
  std::string name = "CorrectionTypes";
  for (int i = 2; manager->GetRegisteredLink(name.c_str()); ++i)
  {
    name = "CorrectionTypes" + std::to_string(i);
  }
  manager->RegisterLink(name.c_str(), link);

  // A script has links of pairs only.
  for (int i = 0; i < Views; ++i)
  {
    for (int j = i + 1; j < Views; ++j)
    {
      SM_SCOPED_TRACE(CallFunction)
        .arg("AddCameraLink")
        .arg(views[i])
        .arg(views[j])
        .arg((name + std::to_string(i) + std::to_string(j)).c_str());
    }
  }
}

/// The place that the user is looking at, or else the whole mesh.
void SetCamera(vtkSMRenderViewProxy* view, vtkSMViewProxy* from)
{
  if (!vtkSMRenderViewProxy::SafeDownCast(from))
  {
    view->ResetCamera();
    return;
  }
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", view);
  for (const char* name : { "CameraPosition", "CameraFocalPoint", "CameraViewUp",
         "CameraParallelScale", "CameraViewAngle", "CameraParallelProjection", "CenterOfRotation" })
  {
    from->UpdatePropertyInformation();
    const std::string information = std::string(name) + "Info";
    vtkSMProperty* source = from->GetProperty(information.c_str());
    view->GetProperty(name)->Copy(source ? source : from->GetProperty(name));
  }
  view->UpdateVTKObjects();
}
}

void CorrectionComparison::ShowLegend(vtkSMProxy* representation, vtkSMViewProxy* view)
{
  if (vtkSMPVRepresentationProxy::SafeDownCast(representation) &&
    vtkSMPVRepresentationProxy::GetUsingScalarColoring(representation))
  {
    vtkSMPVRepresentationProxy::SetScalarBarVisibility(representation, view, true);
  }
}

void CorrectionComparison::Show(const TrimSelection& selection)
{
  pqView* active = pqActiveObjects::instance().activeView();
  vtkSMViewProxy* looking = active ? active->getViewProxy() : nullptr;

  QuietWindow quiet;
  vtkNew<Controller> controller;
  std::array<vtkSMSourceProxy*, Types> trims;
  for (int i = 0; i < Types; ++i)
  {
    trims[i] = AddTrim(controller, selection, i + 1);
    trims[i]->UpdatePipeline(); // while progress is shown
    if (WasAborted(trims[i]))
    {
      std::for_each(trims.begin(), trims.begin() + i + 1,
        [&](vtkSMSourceProxy* trim) { controller->UnRegisterProxy(trim); });
      return;
    }
  }
  quiet.StopDrawing();

  vtkSMSessionProxyManager* manager = trims[0]->GetSessionProxyManager();
  auto layoutProxy = vtkSmartPointer<vtkSMProxy>::Take(manager->NewProxy("misc", "ViewLayout"));
  controller->InitializeProxy(layoutProxy);
  const std::string name = manager->GetUniqueProxyName("layouts", "Correction Types", false);
  controller->RegisterLayoutProxy(layoutProxy, name.c_str());
  auto* layout = vtkSMViewLayoutProxy::SafeDownCast(layoutProxy);
  // Two rows of two. The cells of a split cell i are 2i + 1 and 2i + 2.
  layout->SplitVertical(0, 0.5);
  layout->SplitHorizontal(1, 0.5);
  layout->SplitHorizontal(2, 0.5);

  std::array<vtkSMRenderViewProxy*, Views> views;
  for (int i = 0; i < Views; ++i)
  {
    views[i] = AddView(controller, layout, 3 + i);
    // The statuses are the same whatever the type.
    vtkSMProxy* mesh = i == 0 ? controller->Show(trims[0], 1, views[i])
                              : controller->Show(trims[i - 1], 0, views[i]);
    ShowLegend(mesh, views[i]);
    AddSurface(controller, views[i], selection.Surface);
    AddTitle(controller, views[i], Titles[i]);
  }
  for (vtkSMRenderViewProxy* view : views)
  {
    SetCamera(view, looking);
  }
  LinkCameras(views);
  for (vtkSMRenderViewProxy* view : views)
  {
    view->StillRender();
  }
}
