/**
 * @file CADProgress.h
 * @brief Hands the progress of OpenCASCADE's algorithms on.
 */
#ifndef CADProgress_h
#define CADProgress_h

#include <Message_ProgressIndicator.hxx>

#include <functional>

namespace nurbs
{
/// Hands OpenCASCADE's progress on and asks whether to go on.
class ProgressBridge : public Message_ProgressIndicator
{
public:
  /// @param progress of which the algorithm's own goes from `first` to 1.
  ProgressBridge(const std::function<bool(double)>& progress, double first)
    : Progress(progress)
    , First(first)
  {
  }
  bool Stopped = false;

protected:
  Standard_Boolean UserBreak() override { return this->Stopped; }
  void Show(const Message_ProgressScope&, const Standard_Boolean) override
  {
    this->Stopped =
      this->Stopped || !this->Progress(this->First + (1.0 - this->First) * this->GetPosition());
  }

private:
  std::function<bool(double)> Progress;
  double First;
};
}

#endif
