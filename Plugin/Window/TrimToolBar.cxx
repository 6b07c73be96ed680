#include "TrimToolBar.h"

#include "FilesOfGroup.h"
#include "FirstKeepPoint.h"
#include "TrimAbort.h"
#include "TrimActions.h"

#include "pqApplicationCore.h"
#include "pqObjectBuilder.h"
#include "pqPipelineSource.h"

#include <QMainWindow>
#include <QTimer>

TrimToolBar::TrimToolBar(QWidget* parent)
  : QToolBar("NURBSTrim", parent)
{
  this->setObjectName("NURBSTrimToolbar");
  // There is one toolbar, while the actions are in the menu too.
  new TrimAbort(this);
  const auto* builder = pqApplicationCore::instance()->getObjectBuilder();
  QObject::connect(builder, &pqObjectBuilder::filterCreated, this, &SetFirstKeepPoint);
  QObject::connect(builder,
    QOverload<pqPipelineSource*, const QStringList&>::of(&pqObjectBuilder::readerCreated), this,
    &WarnOfOtherFiles);
  this->addActions((new TrimActions(this))->actions());
  QTimer::singleShot(0, this, &TrimToolBar::FindRoom);
}

void TrimToolBar::FindRoom()
{
  auto* window = qobject_cast<QMainWindow*>(this->parentWidget());
  if (window && this->isVisible() && this->width() < this->sizeHint().width())
  {
    window->addToolBar(this);
  }
}
