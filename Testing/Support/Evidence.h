/**
 * @file Evidence.h
 * @brief A trim that was made, as the judge looks at it.
 */
#ifndef Evidence_h
#define Evidence_h

#include "Exterior.h"
#include "Meshes.h"
#include "Report.h"
#include "Surfaces.h"

#include <set>
#include <vector>

namespace judge
{
/// The filter's properties, with its defaults.
struct TrimOptions
{
  int CorrectionType = 2;
  int Optimization = 2;
  bool InvertSide = false;
  bool UseKeepPoint = false;
  Vec3 KeepPoint = Vec3::Zero();
  double EliminationFraction = 0.5;
  bool RenumberNodes = true;
  double Tolerance = 1e-9;
  bool ProduceOffcut = false;
  double MinimumScaledJacobian = 0.2;
  bool MapValues = false;
  bool InsertLayer = false;
};

/// One trim: what went in and what came out of the two ports.
struct Trial
{
  const Mesh* Input = nullptr;
  const Surface* Cut = nullptr;
  TrimOptions Options;
  vtkSmartPointer<vtkUnstructuredGrid> Trimmed; ///< port 0
  vtkSmartPointer<vtkUnstructuredGrid> Whole;   ///< port 1
  bool MayDivide = false; ///< an element may have come apart, as in the offcut
};

/// A trial prepared for judging: plain data, original ids, statuses.
class Evidence
{
public:
  /// Reports missing arrays, ids out of range, and elements of other types.
  Evidence(const Trial& trial, Report& report);
  bool Usable = false;

  const Trial& Case;
  Model In;                ///< the input, its wedges in the order that they have in the output
  Model Out;               ///< port 0
  Exterior Border;         ///< of the input
  double Diagonal;         ///< of the input's box
  double Rounding;         ///< of coordinates
  double Exact;            ///< absolute limit for positions: 1e-9 of the diagonal and rounding
  std::vector<Id> PointOf; ///< of port 0, in the input
  std::vector<Id> CellOf;
  std::vector<char> InsertedPoint, InsertedCell;        ///< of port 0, as it says
  std::vector<char> KeptCell;                           ///< by input cell
  std::vector<unsigned char> NodeStatus, ElementStatus; ///< of port 1, as the following
  std::vector<float> SignedDistance, Fraction;
  std::vector<std::vector<Id>> CellsAt; ///< of each input point
  std::vector<Facet> NewBoundary;       ///< of port 0
  std::vector<char> OnNewBoundary;      ///< by point of port 0

  /// Signed distance by the oracle, negative on the side to be kept.
  double Signed(const Vec3& p) const;
  /// Its sign, cheaply.
  double Roughly(const Vec3& p) const;
  bool Moved(Id outPoint) const;
  bool Touched(Id outCell) const;
  /// A node on the wrong side whose elements all stay, or the other way round: there a piece of
  /// the model is lost or too much, whatever the correction.
  bool HasOrphans() const;
  /// A value of the summary; NaN if it is missing.
  double Number(const char* name) const;
  /// Whether the ladder of rescues was climbed at all, by the summary.
  bool Rescued() const;

private:
  bool ReadOrigins(Report& report);
  bool ReadStatuses(Report& report);
  void FindNewBoundary();
  /// Whether an exterior facet of an element of the input has all of some points.
  bool HasOnBorder(Id cell, const std::set<Id>& points) const;
  double SideSign = 1;
};

}

#endif
