#include "FirstView.h"

#include "FadingEdges.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <cstring>

namespace
{
const char* const Statuses = "ElementStatus";

/// The trim filter whose output a new representation shows, nullptr if it is something else.
vtkSMSourceProxy* ShownTrim(vtkSMProxy* representation, unsigned int& port)
{
  const vtkSMPropertyHelper input(representation, "Input", /*quiet=*/true);
  auto* producer = vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
  if (!producer || std::strcmp(producer->GetXMLName(), "TrimHexahedralGrid") != 0)
  {
    return nullptr;
  }
  port = input.GetOutputPort();
  return producer;
}

void SetFirstView(vtkObject*, unsigned long, void*, void* data)
{
  using Registered = vtkSMProxyManager::RegisteredProxyInformation;
  const auto* registered = static_cast<Registered*>(data);
  if (registered->Type != Registered::PROXY ||
    std::strcmp(registered->GroupName, "representations") != 0)
  {
    return;
  }
  vtkSMProxy* representation = registered->Proxy;
  unsigned int port = 0;
  vtkSMSourceProxy* trim = ShownTrim(representation, port);
  if (!trim || !representation->GetProperty("ShaderReplacements") ||
    representation->GetSessionProxyManager()->GetInLoadXMLState())
  {
    return;
  }
  vtkSMPropertyHelper(representation, "ShaderReplacements").Set(FadingEdges().c_str());
  vtkSMPropertyHelper(representation, "UseShaderReplacements").Set(1);
  if (trim->GetDataInformation(port)->GetArrayInformation(Statuses, vtkDataObject::CELL))
  {
    // The color map is set by whoever registers the representation, right after this.
    vtkSMPropertyHelper(representation, "ColorArrayName")
      .SetInputArrayToProcess(vtkDataObject::CELL, Statuses);
  }
  representation->UpdateVTKObjects();
}
}

void RegisterFirstView()
{
  // A server has no representations of its own to set up.
  const auto type = vtkProcessModule::GetProcessType();
  if (type != vtkProcessModule::PROCESS_CLIENT && type != vtkProcessModule::PROCESS_BATCH)
  {
    return;
  }
  static bool registered = false; // loaded by client and built-in server alike
  if (registered)
  {
    return;
  }
  registered = true;
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(SetFirstView);
  vtkSMProxyManager::GetProxyManager()->AddObserver(vtkCommand::RegisterEvent, command);
}
