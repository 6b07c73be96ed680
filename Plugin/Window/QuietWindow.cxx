#include "QuietWindow.h"

#include "pqActiveObjects.h"
#include "pqCoreUtilities.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqView.h"

#include <QApplication>
#include <QWidget>

QuietWindow::QuietWindow()
{
  QApplication::setOverrideCursor(Qt::WaitCursor);
  pqActiveObjects& active = pqActiveObjects::instance();
  this->Selection = active.selection();
  this->Source = active.activePort();
  if (!this->Source)
  {
    this->Source = active.activeSource();
  }
  this->View = active.activeView();
  // Else the panels are made anew for each source and view, which takes half of the time.
  this->Blocked = active.blockSignals(true);
}

QuietWindow::~QuietWindow()
{
  // All that changes for those who listen is the view.
  pqActiveObjects& active = pqActiveObjects::instance();
  const QPointer<pqView> view = active.activeView();
  active.setActiveView(this->View);
  active.setSelection(this->Selection, this->Source);
  active.blockSignals(this->Blocked);
  active.setActiveView(view);
  if (this->Stopped)
  {
    this->Stopped->setUpdatesEnabled(true);
  }
  QApplication::restoreOverrideCursor();
}

void QuietWindow::StopDrawing()
{
  this->Stopped = pqCoreUtilities::mainWidget();
  if (this->Stopped)
  {
    this->Stopped->setUpdatesEnabled(false);
  }
}
