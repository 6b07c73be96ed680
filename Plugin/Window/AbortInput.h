/**
 * @file AbortInput.h
 * @brief What the user may do while the window is at work: press the abort button.
 */
#ifndef AbortInput_h
#define AbortInput_h

#include <QList>
#include <QObject>
#include <QPointer>
#include <QWindow>

#include <memory>
#include <utility>
#include <vector>

class QKeyEvent;

/**
 * ParaView's window answers nothing while a filter of its own process works. This looks into what
 * came in meanwhile, and lets through a click on the abort button, or Escape, and what draws the
 * window. Nothing else may run now, as it could ask for the very data that are being made, or draw
 * them: timers are asked to come again, views to be drawn later, and what the user did otherwise is
 * forgotten, but for the end of what he began before: releasing a key or button, closing a window.
 */
class AbortInput : public QObject
{
public:
  /// Handles what came in since the last time.
  void Process();
  /// To be called when the work is over: what waited for that is done.
  void Finish();

protected:
  bool eventFilter(QObject* receiver, QEvent* event) override;

private:
  bool FilterKey(const QKeyEvent* event) const;
  bool FilterView(QObject* receiver, const QEvent* event);
  bool KeepForLater(QObject* receiver, QEvent* later);

  bool Processing = false;
  QList<QPointer<QWindow>> NotDrawn;
  std::vector<std::pair<QPointer<QObject>, std::unique_ptr<QEvent>>> Later;
};

#endif
