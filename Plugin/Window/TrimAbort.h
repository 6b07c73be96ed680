/**
 * @file TrimAbort.h
 * @brief ParaView's abort button stops a trim.
 */
#ifndef TrimAbort_h
#define TrimAbort_h

#include "AbortInput.h"

#include "vtkNew.h"

#include <QElapsedTimer>
#include <QObject>
#include <QPointer>
#include <QTimer>

#include <utility>
#include <vector>

class pqOutputPort;
class pqPipelineSource;
class pqServerManagerModelItem;
class pqView;
class vtkAlgorithm;
class vtkCallbackCommand;
class vtkObject;

/**
 * While a trim, or the reader of CAD files, works in the window's own process, the abort button
 * beside the progress bar is enabled; so is Escape. Work that was aborted leaves nothing, and VTK
 * does it anew with the next request for its data. So that this is not the next turn of the camera,
 * the source is said to wait for Apply again, with one message. One that was applied for the first
 * time is hidden and its inputs are shown again, as if Apply had not been clicked.
 *
 * With a server apart the button stays grey: a server that works takes no message from the client,
 * and ParaView has no way round that.
 */
class TrimAbort : public QObject
{
  Q_OBJECT

public:
  explicit TrimAbort(QObject* parent);
  ~TrimAbort() override;

private:
  /// What was aborted, and how it was shown before.
  struct Stopped
  {
    QPointer<pqPipelineSource> Source;
    bool WasNew;
    std::vector<std::pair<QPointer<pqOutputPort>, QPointer<pqView>>> ShownInputs;
  };

  void Watch(pqPipelineSource* source);
  static void OnEvent(vtkObject* caller, unsigned long event, void* self, void*);
  void Start(vtkAlgorithm* algorithm);
  void Look();
  void End();
  void Abort();
  void AddStopped(vtkAlgorithm* algorithm);
  /// When Apply, or whatever asked for the data, is done.
  void WaitForApply();
  static void Withdraw(const Stopped& stopped);
  /// Apply, after an abort: ParaView takes the empty data for those of these values.
  void Renew(pqServerManagerModelItem* changed);

  AbortInput Input;
  QElapsedTimer SinceLooked;
  QTimer Afterwards; ///< runs while nothing else that was asked for is to be done
  vtkNew<vtkCallbackCommand> Command;
  vtkAlgorithm* Working = nullptr;
  bool Aborting = false;
  std::vector<Stopped> AllStopped;
};

#endif
