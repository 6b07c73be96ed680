/**
 * @file TrimActions.h
 * @brief The menu "NURBSTrim" of ParaView's window.
 */
#ifndef TrimActions_h
#define TrimActions_h

#include <QActionGroup>

class QAction;
class pqPipelineSource;
class pqServerManagerModelItem;

/**
 * What the menu NURBSTrim offers for the mesh or trim that is selected in the Pipeline Browser:
 * - Draw Trim Line: a line across the mesh, see TrimLineDrawing;
 * - Show Summary: the numbers of all trims, see TrimSummary;
 * - Show Statuses: the whole mesh with its statuses in place of the trimmed one, and back;
 * - Compare Correction Types: four linked views, see CorrectionComparison.
 * An action that has nothing to work on is greyed out, and its tooltip says what to select; so it
 * is while the panel shows other values than the action would work with, until Apply.
 *
 * Of trims in sequence one is shown: the meshes of the others lie at the same place.
 */
class TrimActions : public QActionGroup
{
  Q_OBJECT

public:
  explicit TrimActions(QObject* parent);

private:
  void ShowHintsInMenu(); ///< the tooltips, which menus do not show by themselves
  void UpdateEnabled();
  void DrawTrimLine();
  void ShowSummary();
  void ToggleStatuses();
  void CompareCorrectionTypes();
  /// When a trim is applied for the first time: ParaView hides the trimmed grid that is its input,
  /// but not the statuses, where these are shown in place of that.
  void HideTrimsBefore(pqServerManagerModelItem* changed);
  /// The first view, as other trims have it, of one that failed at first or left nothing.
  void ColorFirstElements(pqPipelineSource* source);

  QAction* Line;
  QAction* Statuses;
  QAction* Comparison;
  bool Comparing = false; ///< what comes now is shown in views of its own
};

#endif
