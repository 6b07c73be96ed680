/**
 * @file TrimSummary.h
 * @brief The summaries of all trims of the session in a table that can be docked and copied.
 */
#ifndef TrimSummary_h
#define TrimSummary_h

#include <QDockWidget>
#include <QTimer>

class QTableWidget;

/**
 * A row for each entry of the summary, with what it means, and a column for each trim, in the
 * order they were made. It follows the pipeline: trims that are applied, renamed or deleted.
 */
class TrimSummary : public QDockWidget
{
  Q_OBJECT

public:
  explicit TrimSummary(QWidget* parent);

  /// Shows the one of the main window; the first call makes it.
  static void ShowInMainWindow();

private:
  void Fill();
  void ShowAllColumns(); ///< widens the window as far as the main window allows
  void Copy() const;
  QSize SizeOfAll() const; ///< in which the whole table can be seen

  QTableWidget* Table;
  QTimer Delay; ///< several changes at once fill the table once
};

#endif
