/**
 * @file TrimToolBar.h
 * @brief The toolbar "NURBSTrim" of ParaView's window.
 */
#ifndef TrimToolBar_h
#define TrimToolBar_h

#include <QToolBar>

/// The actions of the menu NURBSTrim, one click away.
class TrimToolBar : public QToolBar
{
  Q_OBJECT

public:
  explicit TrimToolBar(QWidget* parent);

private:
  /// Moves to the end of the last row if it is cut off where ParaView put it.
  void FindRoom();
};

#endif
