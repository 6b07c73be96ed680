#include "AbortInput.h"

#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqProgressManager.h"
#include "pqProgressWidget.h"

#include <QApplication>
#include <QCloseEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QOpenGLWindow>
#include <QToolButton>

namespace
{
pqProgressManager* Manager()
{
  return pqApplicationCore::instance()->getProgressManager();
}

QToolButton* AbortButton()
{
  const QWidget* window = pqCoreUtilities::mainWidget();
  const auto* progress = window ? window->findChild<pqProgressWidget*>() : nullptr;
  return progress ? progress->abortButton() : nullptr;
}

bool IsOnButton(const QMouseEvent* event)
{
  const QWidget* under = QApplication::widgetAt(event->globalPos());
  return under && under == AbortButton();
}

bool ReleasesButton(const QMouseEvent* event)
{
  const QToolButton* button = AbortButton();
  return IsOnButton(event) || (button && button->isDown());
}
}

void AbortInput::Process()
{
  if (this->Processing)
  {
    return;
  }
  this->Processing = true;
  qApp->installEventFilter(this); // the last one is the first that is asked
  // ParaView keeps all clicks from the window, and with them those that the window would give to
  // the button.
  const bool unblocked = Manager()->unblockEvents(true);
  QCoreApplication::processEvents(QEventLoop::ExcludeSocketNotifiers);
  Manager()->unblockEvents(unblocked);
  qApp->removeEventFilter(this);
  this->Processing = false;
}

void AbortInput::Finish()
{
  for (const QPointer<QWindow>& view : this->NotDrawn)
  {
    if (view)
    {
      view->requestUpdate();
    }
  }
  this->NotDrawn.clear();
  for (auto& [receiver, event] : this->Later)
  {
    if (receiver)
    {
      QCoreApplication::postEvent(receiver, event.release());
    }
  }
  this->Later.clear();
}

bool AbortInput::eventFilter(QObject* receiver, QEvent* event)
{
  switch (event->type())
  {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick:
      return !IsOnButton(static_cast<QMouseEvent*>(event));
    case QEvent::MouseButtonRelease:
    {
      auto* mouse = static_cast<QMouseEvent*>(event);
      return !ReleasesButton(mouse) && this->KeepForLater(receiver, new QMouseEvent(*mouse));
    }
    case QEvent::ShortcutOverride: // no shortcut then
      event->accept();
      return true;
    case QEvent::KeyPress:
      return this->FilterKey(static_cast<QKeyEvent*>(event));
    case QEvent::KeyRelease:
      return this->KeepForLater(receiver, new QKeyEvent(*static_cast<QKeyEvent*>(event)));
    case QEvent::Close:
      event->ignore();
      return this->KeepForLater(receiver, new QCloseEvent);
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::Shortcut:
    case QEvent::ContextMenu:
    case QEvent::DragEnter:
    case QEvent::DragMove:
    case QEvent::Drop:
    case QEvent::TouchBegin:
    case QEvent::TouchUpdate:
    case QEvent::TouchEnd:
    case QEvent::TabletPress:
    case QEvent::TabletMove:
    case QEvent::TabletRelease:
    case QEvent::Timer: // comes again
      return true;
    default:
      return this->FilterView(receiver, event);
  }
}

bool AbortInput::FilterKey(const QKeyEvent* event) const
{
  if (event->key() == Qt::Key_Escape)
  {
    Manager()->triggerAbort();
  }
  return true;
}

bool AbortInput::FilterView(QObject* receiver, const QEvent* event)
{
  auto* view = qobject_cast<QOpenGLWindow*>(receiver);
  if (!view || (event->type() != QEvent::UpdateRequest && event->type() != QEvent::Expose))
  {
    return false;
  }
  this->NotDrawn.append(view);
  return true;
}

bool AbortInput::KeepForLater(QObject* receiver, QEvent* later)
{
  this->Later.emplace_back(receiver, later);
  return true;
}
