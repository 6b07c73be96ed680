/**
 * @file QuietWindow.h
 * @brief ParaView's window stands still while something is built up in it.
 */
#ifndef QuietWindow_h
#define QuietWindow_h

#include "pqProxySelection.h"

#include <QPointer>

class QWidget;
class pqServerManagerModelItem;
class pqView;

/**
 * For the time that an object of this class lives the mouse shows that the window is at work, and
 * panels and toolbars follow no source and no view that is made. Then what was selected before is
 * selected again, and the new active view is followed.
 */
class QuietWindow
{
public:
  QuietWindow();
  ~QuietWindow();
  QuietWindow(const QuietWindow&) = delete;
  QuietWindow& operator=(const QuietWindow&) = delete;

  /// From now on nothing is drawn, progress neither, until all is drawn at once in the end.
  void StopDrawing();

private:
  QPointer<QWidget> Stopped;
  pqProxySelection Selection;
  QPointer<pqServerManagerModelItem> Source;
  QPointer<pqView> View;
  bool Blocked;
};

#endif
