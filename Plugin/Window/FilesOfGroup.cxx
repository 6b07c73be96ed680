#include "FilesOfGroup.h"

#include "pqPipelineSource.h"

#include "vtkSMProxy.h"
#include "vtkSetGet.h"

#include <QFileInfo>

#include <string>

void WarnOfOtherFiles(pqPipelineSource* source, const QStringList& files)
{
  vtkSMProxy* const reader = source->getProxy();
  if (files.size() > 1 && std::string(reader->GetXMLName()) == "CADSurfaceReader")
  {
    // Of the proxy: of a warning without an object the window shows what follows the last colon.
    vtkWarningWithObjectMacro(reader,
      "Only "
        << QFileInfo(files.front()).fileName().toStdString() << " is opened, the first of "
        << files.size()
        << " files that ParaView's dialog shows as one because of the numbers in their names: "
           "unfold them there to open others.");
  }
}
