/**
 * @file Checks.h
 * @brief The judge: holds the outputs of a trim against its input, an oracle of the surface and
 * the promises of CONTRACT.md, by code of its own.
 *
 * Every check counts its failures in a Report, which prints the first ones of each kind, each
 * on one line with place, value and limit.
 */
#ifndef Checks_h
#define Checks_h

#include "Exterior.h"
#include "Meshes.h"
#include "Surfaces.h"

#include <map>
#include <set>
#include <string>

class vtkDataSetAttributes;
class vtkFieldData;

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

/// Notes under this name are nodes of the new boundary that the filter reported as left.
constexpr const char* LeftOff = "nodes left off the surface, as the summary says";

class Report
{
public:
  explicit Report(std::string context, bool quiet = false)
    : Context(std::move(context))
    , Quiet(quiet)
  {
  }
  /// Counts, and prints "FAIL context: check: place: value (limit)" for the first few.
  void Fail(const std::string& check, const std::string& place, double value, double limit);
  void Fail(const std::string& check, const std::string& text);
  /// Counts what the filter could not do and said so: no failure, but not silent either.
  void Note(const std::string& what) { ++this->NoteCounts[what]; }
  const std::map<std::string, int>& Notes() const { return this->NoteCounts; }
  int Failures() const { return this->Total; }
  int Failures(const std::string& check) const;
  const std::map<std::string, int>& ByCheck() const { return this->Counts; }

private:
  bool Count(const std::string& check);
  std::string Context;
  bool Quiet;
  int Total = 0;
  std::map<std::string, int> Counts, NoteCounts;
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
  Model In;
  Model Out;
  Exterior Border;
  double Diagonal;
  double Rounding;         ///< of coordinates
  double Exact;            ///< absolute limit for positions: 1e-9 of the diagonal and rounding
  std::vector<Id> PointOf; ///< of port 0, in the input
  std::vector<Id> CellOf;
  std::vector<char> InsertedPoint, InsertedCell; ///< of port 0, as it says
  std::vector<char> KeptCell;                    ///< by input cell
  std::vector<unsigned char> NodeStatus, ElementStatus;
  std::vector<float> SignedDistance, Fraction;
  std::vector<std::vector<Id>> CellsAt; ///< of each input point
  std::vector<Facet> NewBoundary;       ///< of port 0
  std::vector<char> OnNewBoundary;      ///< by point of port 0

  /// Signed distance by the oracle, negative on the side to be kept.
  double Signed(const Vec3& p) const;
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

/// As reports name a cell.
inline std::string Cell(Id c)
{
  return "cell " + std::to_string(c);
}

/// Presence, types and components of the arrays of CONTRACT.md.
void CheckArrays(const Trial& trial, Report& report);
/// NodeStatus and SignedDistance by the oracle, ElementStatus by NodeStatus.
void CheckStatuses(const Evidence& evidence, Report& report);
/// Rescue: the same on both ports, and as the summary counts it.
void CheckRescues(const Evidence& evidence, Report& report);
/// V^e by stratified sampling of at most `maximumCells` cut elements.
void CheckFractions(const Evidence& evidence, Report& report, int maximumCells = 60);
/// Displacement against coordinates, CorrectionApplied, bit identity, type III on mesh edges.
void CheckMoves(const Evidence& evidence, Report& report);
/// New boundary on the surface; skin, ridges and corners kept; closed manifold.
void CheckBoundary(const Evidence& evidence, Report& report);
/// The quality floor: every touched element that had it before has it, but for the straight
/// corners of elements that are not made wedges.
void CheckFloor(const Evidence& evidence, Report& report);
/// Shortfall of port 0 tells of the elements at nodes left off, and of no others.
void CheckShortfalls(const Evidence& evidence, Report& report);
/// NewBoundary against the facets that the input does not have.
void CheckNewBoundary(const Evidence& evidence, Report& report);
/// Jacobians, collapse, coincident nodes.
void CheckElements(const Evidence& evidence, Report& report);
/// All arrays of the input, by original ids, with attributes and names, on both ports.
void CheckCarriedArrays(const Evidence& evidence, Report& report);
/// The field data of port 0.
void CheckSummary(const Evidence& evidence, Report& report);
/// NodeBandwidth against the numbering as it came and reverse Cuthill-McKee.
void CheckNumbering(const Evidence& evidence, Report& report);
/// The volume kept of a flat mesh cut by a plane, exact by six tetrahedra an element.
void CheckPlaneVolume(
  const Evidence& evidence, const Vec3& point, const Vec3& normal, Report& report);

/**
 * The volume kept against what lies on the kept side, by the filter's own fractions: what differs
 * by more than corners and chords of the surface, is lost or stayed.
 *
 * @param share of the cut elements that these may take.
 */
void CheckKeptVolume(const Evidence& evidence, double share, Report& report);
/// Where nothing is left no element lay whole on the kept side.
void CheckNothingKept(const Evidence& evidence, Report& report);

/// All of the above that apply without further knowledge.
void JudgeAll(const Evidence& evidence, Report& report);

/// Kept part and offcut (the same trial with InvertSide): volumes and nodes along the cut.
void CheckPair(const Evidence& kept, const Evidence& offcut, Report& report);

/// Points, cells and all data arrays identical to the last bit; the first difference in words,
/// empty if none.
std::string FirstDifference(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b);

/// Largest difference of node numbers within an element.
Id Bandwidth(const std::vector<Element>& elements);
/// The same after Boost's reverse Cuthill-McKee.
Id ReverseCuthillMcKeeBandwidth(const Model& model);

}

#endif
