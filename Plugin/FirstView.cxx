#include "FirstView.h"

#include "ArrayNames.h"
#include "FadingEdges.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVDataInformation.h"
#include "vtkProcessModule.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <cstring>
#include <utility>
#include <vector>

namespace
{
/// The source whose output a new representation shows, nullptr if there is none.
vtkSMSourceProxy* ShownSource(vtkSMProxy* representation, unsigned int& port)
{
  const vtkSMPropertyHelper input(representation, "Input", /*quiet=*/true);
  port = input.GetOutputPort();
  return vtkSMSourceProxy::SafeDownCast(input.GetAsProxy());
}

bool IsKind(vtkSMSourceProxy* source, const char* name)
{
  return std::strcmp(source->GetXMLName(), name) == 0;
}

void ShowTrim(vtkSMProxy* representation, vtkSMSourceProxy* trim, unsigned int port)
{
  vtkSMPropertyHelper(representation, "ShaderReplacements").Set(FadingEdges().c_str());
  vtkSMPropertyHelper(representation, "UseShaderReplacements").Set(1);
  if (trim->GetDataInformation(port)->GetArrayInformation(
        trim::names::ElementStatus, vtkDataObject::CELL))
  {
    // The color map is set by whoever registers the representation, right after this.
    vtkSMPropertyHelper(representation, "ColorArrayName")
      .SetInputArrayToProcess(vtkDataObject::CELL, trim::names::ElementStatus);
  }
  representation->UpdateVTKObjects();
}

/// In a colour that the mesh has not, and that is no darker where the surface is seen from the
/// side, as it is by who looks down at a sheet: then it is a line one pixel wide.
void ShowSurface(vtkSMProxy* representation)
{
  const double red[] = { 0.84, 0.19, 0.15 };
  const std::pair<const char*, std::vector<double>> values[] = { { "AmbientColor",
                                                                   { red, red + 3 } },
    { "DiffuseColor", { red, red + 3 } }, { "Ambient", { 0.5 } }, { "Diffuse", { 0.5 } } };
  for (const auto& [name, value] : values)
  {
    vtkSMProperty* property = representation->GetProperty(name);
    if (property && property->IsValueDefault()) // else the user has defaults of his own
    {
      vtkSMPropertyHelper(property).Set(value.data(), static_cast<unsigned int>(value.size()));
    }
  }
  representation->UpdateVTKObjects();
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
  vtkSMSourceProxy* source = ShownSource(representation, port);
  if (!source || !representation->GetProperty("ShaderReplacements") ||
    representation->GetSessionProxyManager()->GetInLoadXMLState())
  {
    return;
  }
  if (IsKind(source, "TrimHexahedralGrid"))
  {
    ShowTrim(representation, source, port);
  }
  else if (IsKind(source, "CADSurfaceReader") || IsKind(source, "TrimLineSource") ||
    IsKind(source, "NURBSSurfaceSource"))
  {
    ShowSurface(representation);
  }
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
