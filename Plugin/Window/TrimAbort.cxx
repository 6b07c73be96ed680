#include "TrimAbort.h"

#include "TrimSelection.h"

#include "pqApplicationCore.h"
#include "pqOutputPort.h"
#include "pqPipelineFilter.h"
#include "pqPipelineSource.h"
#include "pqProgressManager.h"
#include "pqServerManagerModel.h"
#include "pqView.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkOutputWindow.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <QStringList>
#include <QVariant>

#include <algorithm>
#include <cstring>
#include <utility>

namespace
{
constexpr int LookEvery = 50; ///< milliseconds
constexpr const char* const WaitsForApply = "NURBSTrimWaitsForApply";

pqServerManagerModel* Model()
{
  return pqApplicationCore::instance()->getServerManagerModel();
}

pqProgressManager* Progress()
{
  return pqApplicationCore::instance()->getProgressManager();
}

/// What works in this process, nullptr if it is not there or of no kind that can be aborted.
vtkAlgorithm* AlgorithmOf(pqPipelineSource* source)
{
  vtkSMProxy* proxy = source->getProxy();
  const bool canAbort = IsTrim(proxy) || std::strcmp(proxy->GetXMLName(), "CADSurfaceReader") == 0;
  return canAbort ? vtkAlgorithm::SafeDownCast(proxy->GetClientSideObject()) : nullptr;
}

pqPipelineSource* SourceOf(vtkAlgorithm* algorithm)
{
  for (pqPipelineSource* source : Model()->findItems<pqPipelineSource*>())
  {
    if (AlgorithmOf(source) == algorithm)
    {
      return source;
    }
  }
  return nullptr;
}

bool IsShown(pqOutputPort* output, pqView* view)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  return controller->GetVisibility(
    output->getSourceProxy(), output->getPortNumber(), view->getViewProxy());
}
}

TrimAbort::TrimAbort(QObject* parent)
  : QObject(parent)
{
  this->Command->SetClientData(this);
  this->Command->SetCallback(&TrimAbort::OnEvent);
  this->Afterwards.setSingleShot(true);
  QObject::connect(&this->Afterwards, &QTimer::timeout, this, &TrimAbort::WaitForApply);
  QObject::connect(Progress(), &pqProgressManager::abort, this, &TrimAbort::Abort);
  QObject::connect(Model(), &pqServerManagerModel::sourceAdded, this, &TrimAbort::Watch);
  QObject::connect(Model(), &pqServerManagerModel::modifiedStateChanged, this, &TrimAbort::Renew);
  for (pqPipelineSource* source : Model()->findItems<pqPipelineSource*>())
  {
    this->Watch(source);
  }
}

TrimAbort::~TrimAbort()
{
  this->Command->SetClientData(nullptr); // those that are watched may live longer
}

void TrimAbort::Watch(pqPipelineSource* source)
{
  if (vtkAlgorithm* algorithm = AlgorithmOf(source))
  {
    for (auto event : { vtkCommand::StartEvent, vtkCommand::AbortCheckEvent, vtkCommand::EndEvent })
    {
      algorithm->AddObserver(event, this->Command);
    }
  }
}

void TrimAbort::OnEvent(vtkObject* caller, unsigned long event, void* self, void*)
{
  auto* const abort = static_cast<TrimAbort*>(self);
  auto* const algorithm = vtkAlgorithm::SafeDownCast(caller);
  if (!abort || !algorithm)
  {
    return;
  }
  switch (event)
  {
    case vtkCommand::StartEvent:
      abort->Start(algorithm);
      break;
    case vtkCommand::AbortCheckEvent:
      abort->Look();
      break;
    default:
      abort->End();
  }
}

void TrimAbort::Start(vtkAlgorithm* algorithm)
{
  this->Working = algorithm;
  if (this->Aborting)
  {
    this->AddStopped(algorithm); // what the same Apply asks for next is not wanted either
    return;
  }
  Progress()->setEnableAbort(true);
  this->SinceLooked.start();
}

void TrimAbort::Look()
{
  if (!this->Aborting && this->SinceLooked.elapsed() >= LookEvery)
  {
    this->Input.Process();
    this->SinceLooked.start();
  }
}

void TrimAbort::End()
{
  this->Working = nullptr;
  Progress()->setEnableAbort(false);
  this->Input.Finish();
}

void TrimAbort::Abort()
{
  if (this->Working)
  {
    this->Aborting = true;
    this->AddStopped(this->Working);
    this->Afterwards.start();
  }
}

void TrimAbort::AddStopped(vtkAlgorithm* algorithm)
{
  algorithm->SetAbortExecute(1);
  pqPipelineSource* source = SourceOf(algorithm);
  const auto isSource = [source](const Stopped& other) { return other.Source == source; };
  if (!source || std::any_of(this->AllStopped.begin(), this->AllStopped.end(), isSource))
  {
    return;
  }
  Stopped stopped{ source, source->modifiedState() == pqProxy::UNINITIALIZED, {} };
  const auto* filter = qobject_cast<pqPipelineFilter*>(source);
  for (pqOutputPort* input : filter ? filter->getAllInputs() : QList<pqOutputPort*>())
  {
    for (pqView* view : Model()->findItems<pqView*>())
    {
      if (IsShown(input, view))
      {
        stopped.ShownInputs.emplace_back(input, view);
      }
    }
  }
  this->AllStopped.push_back(std::move(stopped));
}

void TrimAbort::WaitForApply()
{
  this->Aborting = false;
  const std::vector<Stopped> all = std::exchange(this->AllStopped, {});
  QStringList names;
  for (const Stopped& stopped : all)
  {
    if (!stopped.Source)
    {
      continue;
    }
    AlgorithmOf(stopped.Source)->SetAbortExecute(0);
    names << stopped.Source->getSMName();
    if (stopped.WasNew)
    {
      Withdraw(stopped);
    }
    stopped.Source->setModifiedState(stopped.WasNew ? pqProxy::UNINITIALIZED : pqProxy::MODIFIED);
    stopped.Source->setProperty(WaitsForApply, true);
  }
  // Nothing to apply is left of what was made for a comparison.
  const QString text = names.isEmpty()
    ? "Aborted.\n"
    : QString("Aborted: %1. There is no result until Apply is clicked again.\n")
        .arg(names.join(", "));
  vtkOutputWindowDisplayWarningText(text.toUtf8().data());
}

void TrimAbort::Withdraw(const Stopped& stopped)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  for (pqOutputPort* output : stopped.Source->getOutputPorts())
  {
    for (pqView* view : Model()->findItems<pqView*>())
    {
      if (IsShown(output, view))
      {
        controller->Hide(output->getSourceProxy(), output->getPortNumber(), view->getViewProxy());
        view->render();
      }
    }
  }
  for (const auto& [input, view] : stopped.ShownInputs)
  {
    if (input && view && !IsShown(input, view))
    {
      controller->Show(input->getSourceProxy(), input->getPortNumber(), view->getViewProxy());
      view->render();
    }
  }
}

void TrimAbort::Renew(pqServerManagerModelItem* changed)
{
  auto* source = qobject_cast<pqPipelineSource*>(changed);
  if (source && source->modifiedState() == pqProxy::UNMODIFIED &&
    source->property(WaitsForApply).toBool())
  {
    source->setProperty(WaitsForApply, false);
    source->getProxy()->MarkDirty(nullptr);
  }
}
