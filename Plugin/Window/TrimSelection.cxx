#include "TrimSelection.h"

#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqServer.h"
#include "pqServerManagerModel.h"

#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"

#include <algorithm>
#include <cstring>

namespace
{
SelectedOutput InputOf(vtkSMSourceProxy* source, const char* name)
{
  const vtkSMPropertyHelper input(source, name, /*quiet=*/true);
  return { vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()),
    static_cast<int>(input.GetOutputPort()) };
}

SelectedOutput OutputOf(pqServerManagerModelItem* item)
{
  if (auto* port = qobject_cast<pqOutputPort*>(item))
  {
    return { port->getSourceProxy(), port->getPortNumber() };
  }
  if (auto* source = qobject_cast<pqPipelineSource*>(item))
  {
    return { source->getSourceProxy(), 0 };
  }
  return {};
}
}

bool IsTrim(vtkSMProxy* proxy)
{
  return proxy && std::strcmp(proxy->GetXMLName(), "TrimHexahedralGrid") == 0;
}

bool HasServerPlugin()
{
  const pqServer* server = pqActiveObjects::instance().activeServer();
  return server && server->proxyManager()->HasDefinition("filters", "TrimHexahedralGrid");
}

std::vector<vtkSMSourceProxy*> SourcesBefore(vtkSMSourceProxy* source)
{
  std::vector<vtkSMSourceProxy*> sources;
  for (SelectedOutput input = InputOf(source, "Input"); input.Source;
       input = InputOf(input.Source, "Input"))
  {
    if (IsTrim(input.Source) && input.Port == OffcutPort)
    {
      break; // nothing of it is in the trimmed grid
    }
    sources.push_back(input.Source);
  }
  return sources;
}

std::vector<vtkSMSourceProxy*> TrimsBefore(vtkSMSourceProxy* source)
{
  std::vector<vtkSMSourceProxy*> trims = SourcesBefore(source);
  trims.erase(std::remove_if(trims.begin(), trims.end(),
                [](vtkSMSourceProxy* before) { return !IsTrim(before); }),
    trims.end());
  return trims;
}

bool IsApplied(vtkSMProxy* proxy)
{
  const auto* model = pqApplicationCore::instance()->getServerManagerModel();
  const auto* item = model->findItem<pqProxy*>(proxy);
  return !item || item->modifiedState() == pqProxy::UNMODIFIED;
}

TrimSelection FindTrimSelection()
{
  TrimSelection found;
  for (pqServerManagerModelItem* item : pqActiveObjects::instance().selection())
  {
    const SelectedOutput output = OutputOf(item);
    if (!output.Source)
    {
      continue;
    }
    if (IsTrim(output.Source))
    {
      found.Trim = output.Source;
      found.TrimPort = output.Port == OffcutPort ? OffcutPort : 0;
      continue;
    }
    vtkPVDataInformation* information = output.Source->GetDataInformation(output.Port);
    if (information->DataSetTypeIsA("vtkUnstructuredGrid"))
    {
      found.Mesh = output;
    }
    else if (information->DataSetTypeIsA("vtkPolyData") || information->IsCompositeDataSet())
    {
      found.Surface = output;
    }
  }
  if (found.Trim && !found.Surface.Source)
  {
    found.Mesh = InputOf(found.Trim, "Input");
    found.Surface = InputOf(found.Trim, "TrimmingSurface");
  }
  else if (found.Trim && !found.Mesh.Source)
  {
    found.Mesh = { found.Trim, found.TrimPort };
  }
  return found;
}
