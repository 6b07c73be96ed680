#include "TrimActions.h"

#include "ArrayNames.h"
#include "CorrectionComparison.h"
#include "TrimLineDrawing.h"
#include "TrimSelection.h"
#include "TrimSummary.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqDataRepresentation.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqPluginManager.h"
#include "pqServerManagerModel.h"
#include "pqUndoStack.h"
#include "pqView.h"

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"
#include "vtkSMViewProxy.h"

#include <QAction>
#include <QIcon>
#include <QMenu>
#include <QTimer>
#include <QVariant>

#include <algorithm>
#include <vector>

namespace
{
constexpr const char* StatusArray = trim::names::ElementStatus; ///< of the first view
constexpr const char* NotApplied = "Click Apply first: there are values that were not applied yet.";
constexpr const char* NoPlugin = "The server has not loaded the plugin NURBSTrim: Tools > Manage "
                                 "Plugins, Remote Plugins.";
constexpr const char* NoElements = "There are no elements: none was left, or the filter failed, or "
                                   "it was not shown yet (the eye beside it).";

QAction* AddAction(QActionGroup* group, const char* name, const QString& text)
{
  auto* action = new QAction(QIcon(QString(":/NURBSTrim/Icons/%1.svg").arg(name)), text, group);
  action->setObjectName(name);
  return action;
}

/// Enables the action or says what is missing.
void Enable(QAction* action, const QString& help, const QString& missing)
{
  const bool enabled = missing.isEmpty();
  action->setEnabled(enabled);
  action->setToolTip(
    QString("<p><b>%1</b></p><p>%2</p>%3")
      .arg(action->text(), help, enabled ? QString() : QString("<p><i>%1</i></p>").arg(missing)));
  action->setStatusTip(enabled ? help : missing);
}

/// What a line to be drawn wants for; nothing if it can be drawn.
QString MissingForLine()
{
  if (!HasServerPlugin())
  {
    return NoPlugin;
  }
  const SelectedOutput mesh = TrimLineDrawing::FindMesh();
  if (!mesh.Source)
  {
    return "Select the mesh in the Pipeline Browser.";
  }
  if (mesh.Source->GetDataInformation(mesh.Port)->GetNumberOfCells() > 0)
  {
    return {};
  }
  return IsApplied(mesh.Source) ? NoElements : "Click Apply first: there are no elements yet.";
}

bool Is3DView(const pqView* view)
{
  return view && view->getViewProxy()->IsA("vtkSMRenderViewProxy");
}

/// What the statuses want for to be shown.
QString MissingForStatuses(const TrimSelection& selection)
{
  const pqView* view = pqActiveObjects::instance().activeView();
  if (!selection.Trim || !Is3DView(view))
  {
    return "Select a Trim Hexahedral Grid in the Pipeline Browser, and a 3D view.";
  }
  return IsApplied(selection.Trim) ? QString() : NotApplied;
}

/// What the comparison wants for.
QString MissingForComparison(const TrimSelection& selection)
{
  if (!HasServerPlugin())
  {
    return NoPlugin;
  }
  if (!selection.IsComplete())
  {
    return "Select a Trim Hexahedral Grid in the Pipeline Browser, or a mesh and a surface.";
  }
  const bool applied = IsApplied(selection.Mesh.Source) && IsApplied(selection.Surface.Source) &&
    (!selection.Trim || IsApplied(selection.Trim));
  return applied ? QString() : NotApplied;
}

/// A mesh; of a trim, what it left and its statuses.
void Hide(vtkSMParaViewPipelineControllerWithRendering* controller, vtkSMSourceProxy* mesh,
  vtkSMViewProxy* view)
{
  for (int port : { 0, 1 })
  {
    if (controller->GetVisibility(mesh, port, view))
    {
      controller->Hide(mesh, port, view);
    }
  }
}

/// What lies at the same place as this mesh: what it was made of, and the trims that are made of
/// it.
std::vector<vtkSMSourceProxy*> MeshesInSequence(vtkSMSourceProxy* mesh)
{
  std::vector<vtkSMSourceProxy*> meshes = SourcesBefore(mesh);
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    vtkSMSourceProxy* const other = source->getSourceProxy();
    const auto before = IsTrim(other) ? SourcesBefore(other) : std::vector<vtkSMSourceProxy*>();
    if (std::find(before.begin(), before.end(), mesh) != before.end())
    {
      meshes.push_back(other);
    }
  }
  return meshes;
}

/// Records the colours and the legend that a representation has got.
void TraceFirstColors(pqDataRepresentation* shown)
{
  {
    SM_SCOPED_TRACE(SetScalarColoring)
      .arg("display", shown->getProxy())
      .arg("arrayname", StatusArray)
      .arg("attribute_type", vtkDataObject::CELL);
  }
  if (shown->getView())
  {
    CorrectionComparison::ShowLegend(shown->getProxy(), shown->getViewProxy());
  }
}

/// Shows a mesh, or statuses, in place of the others in sequence with it.
void ShowInPlace(const SelectedOutput& shown, pqView* view)
{
  vtkSMViewProxy* const proxy = view->getViewProxy();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  for (vtkSMSourceProxy* other : MeshesInSequence(shown.Source))
  {
    Hide(controller, other, proxy);
  }
  if (IsTrim(shown.Source))
  {
    Hide(controller, shown.Source, proxy);
  }
  CorrectionComparison::ShowLegend(controller->Show(shown.Source, shown.Port, proxy), proxy);
  view->render();
}
}

TrimActions::TrimActions(QObject* parent)
  : QActionGroup(parent)
{
  this->setExclusive(false);

  this->Line = AddAction(this, "DrawTrimLine", "Draw Trim Line");
  QAction* summary = AddAction(this, "ShowSummary", "Show Summary");
  Enable(
    summary, "The numbers of every trim in a table: elements kept and gone, quality, volume.", {});
  this->Statuses = AddAction(this, "ShowStatuses", "Show Statuses");
  this->Comparison = AddAction(this, "CompareCorrectionTypes", "Compare Correction Types");

  QObject::connect(this->Line, &QAction::triggered, this, &TrimActions::DrawTrimLine);
  QObject::connect(summary, &QAction::triggered, this, &TrimActions::ShowSummary);
  QObject::connect(this->Statuses, &QAction::triggered, this, &TrimActions::ToggleStatuses);
  QObject::connect(
    this->Comparison, &QAction::triggered, this, &TrimActions::CompareCorrectionTypes);

  const auto* active = &pqActiveObjects::instance();
  QObject::connect(active, &pqActiveObjects::selectionChanged, this, &TrimActions::UpdateEnabled);
  QObject::connect(active, &pqActiveObjects::dataUpdated, this, &TrimActions::UpdateEnabled);
  QObject::connect(active, QOverload<pqView*>::of(&pqActiveObjects::viewChanged), this,
    &TrimActions::UpdateEnabled);
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  QObject::connect(
    model, &pqServerManagerModel::modifiedStateChanged, this, &TrimActions::UpdateEnabled);
  QObject::connect(
    model, &pqServerManagerModel::modifiedStateChanged, this, &TrimActions::HideTrimsBefore);
  // A server may load the plugin later than the client.
  QObject::connect(pqApplicationCore::instance()->getPluginManager(),
    &pqPluginManager::pluginsUpdated, this, &TrimActions::UpdateEnabled);
  QObject::connect(model, QOverload<pqPipelineSource*>::of(&pqServerManagerModel::dataUpdated),
    this, &TrimActions::ColorFirstElements);
  this->UpdateEnabled();

  // The menu takes the actions later: as soon as they are made or, at the start, with the window.
  QTimer::singleShot(0, this, &TrimActions::ShowHintsInMenu);
  QObject::connect(pqApplicationCore::instance(), &pqApplicationCore::clientEnvironmentDone, this,
    &TrimActions::ShowHintsInMenu);
}

void TrimActions::ShowHintsInMenu()
{
  for (QWidget* widget : this->Line->associatedWidgets())
  {
    if (auto* menu = qobject_cast<QMenu*>(widget))
    {
      menu->setToolTipsVisible(true);
    }
  }
}

void TrimActions::UpdateEnabled()
{
  const TrimSelection selection = FindTrimSelection();
  Enable(this->Line,
    "A line across the mesh, to be dragged in the view: a Trim Line Source with the mesh as its "
    "sheet.",
    MissingForLine());
  Enable(this->Statuses,
    "The whole mesh with the statuses keep, eliminate, to treat, in place of the trimmed one; "
    "once more to return.",
    MissingForStatuses(selection));
  Enable(this->Comparison,
    "The mesh before the trim and after it with the correction types I, II and III, in four "
    "views that turn together.",
    MissingForComparison(selection));
}

void TrimActions::DrawTrimLine()
{
  SCOPED_UNDO_SET("Draw Trim Line");
  const SelectedOutput mesh = TrimLineDrawing::FindMesh();
  pqView* view = pqActiveObjects::instance().activeView();
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  if (Is3DView(view) && !controller->GetVisibility(mesh.Source, mesh.Port, view->getViewProxy()))
  {
    ShowInPlace(mesh, view); // as a mesh that was trimmed before is hidden
  }
  TrimLineDrawing::Start(mesh);
}

void TrimActions::ShowSummary()
{
  TrimSummary::ShowInMainWindow();
}

void TrimActions::ToggleStatuses()
{
  vtkSMSourceProxy* trim = FindTrimSelection().Trim;
  pqView* view = pqActiveObjects::instance().activeView();
  SCOPED_UNDO_SET("Show Statuses");
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  const int shown = controller->GetVisibility(trim, 1, view->getViewProxy()) ? 0 : 1;
  ShowInPlace({ trim, shown }, view);
}

void TrimActions::CompareCorrectionTypes()
{
  this->Comparing = true;
  CorrectionComparison::Show(FindTrimSelection());
  this->Comparing = false;
  // With the views their link would go, on which ParaView clears the stack, even while it works on
  // it: as after its own Add Camera Link there is nothing to undo.
  CLEAR_UNDO_STACK();
}

void TrimActions::HideTrimsBefore(pqServerManagerModelItem* changed)
{
  auto* source = qobject_cast<pqPipelineSource*>(changed);
  if (!source || !IsTrim(source->getProxy()))
  {
    return;
  }
  const char* const isNew = "NURBSTrimIsNew";
  const bool wasNew = source->property(isNew).toBool();
  source->setProperty(isNew, source->modifiedState() == pqProxy::UNINITIALIZED);
  const pqView* view = pqActiveObjects::instance().activeView();
  if (!wasNew || source->modifiedState() != pqProxy::UNMODIFIED || this->Comparing || !view)
  {
    return;
  }
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  for (vtkSMSourceProxy* trim : TrimsBefore(source->getSourceProxy()))
  {
    Hide(controller, trim, view->getViewProxy());
  }
}

void TrimActions::ColorFirstElements(pqPipelineSource* source)
{
  const char* const wants = "NURBSTrimWantsColor";
  const QVariant before = source->property(wants);
  if (!IsTrim(source->getProxy()) || (before.isValid() && !before.toBool()))
  {
    return;
  }
  const vtkPVDataInformation* data = source->getSourceProxy()->GetDataInformation(0);
  const bool hasElements = data->GetArrayInformation(StatusArray, vtkDataObject::CELL) != nullptr;
  source->setProperty(wants, !hasElements);
  if (!hasElements || !before.isValid())
  {
    return;
  }
  for (pqDataRepresentation* shown : source->getOutputPort(0)->getRepresentations(nullptr))
  {
    vtkSMProxy* representation = shown->getProxy();
    if (shown->getView() && vtkSMPVRepresentationProxy::SafeDownCast(representation) &&
      !vtkSMPVRepresentationProxy::GetUsingScalarColoring(representation))
    {
      vtkSMPVRepresentationProxy::SetScalarColoring(
        representation, StatusArray, vtkDataObject::CELL);
      CorrectionComparison::ShowLegend(representation, shown->getViewProxy());
      // A trace heeds nothing that happens within its update of the view.
      QTimer::singleShot(0, shown, [shown] { TraceFirstColors(shown); });
    }
  }
}
