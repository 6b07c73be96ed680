/**
 * @class vtkTrimHexahedralGrid
 * @brief trims a grid of hexahedra exactly along a NURBS surface
 *
 * Nodes are moved onto the surface, so that the result still consists of hexahedra (and a few
 * wedges) and ends exactly at the cut, after A.J. Baptista, J.L. Alves, D.M. Rodrigues,
 * L.F. Menezes, Trimming of 3D solid finite element meshes using parametric surfaces:
 * application to sheet metal forming (2006).
 *
 * Input port 0: an unstructured grid of hexahedra and wedges; the output of an earlier trim is
 * a valid input. Input port 1: poly data that carries a NURBS surface in its field data (see
 * NURBSFieldData.h), or a composite of such; together they are one trimming surface.
 *
 * Output port 0: the trimmed grid. Output port 1: the whole input grid with its statuses. Both
 * carry
 * - NodeStatus (unsigned char, points): 0 keep, 1 eliminate, 2 on surface, of the original
 *   position;
 * - SignedDistance (float, points): to the surface, negative on the kept side; NaN far away;
 * - ElementStatus (unsigned char, cells): 0 keep, 1 eliminate, 2 to treat;
 * - EliminatedFraction (float, cells): the share of the element beyond the surface;
 * - Displacement (3 floats, points): how far the correction moved the node;
 * - CorrectionApplied (unsigned char, points): 0 none, 2 type II, 3 type III, 4 relaxed (moved for
 *   the quality of the elements there) or taken to a sharp edge of the surface;
 * - Rescue (unsigned char, cells): how an element that would have become invalid was saved, 0 not
 *   needed, 1 relaxation, 2 other treatment, 3 other correction, 4 other fate, 5 nodes left off the
 *   surface;
 * - Feasibility (unsigned char, cells): where the surface breaks an assumption of the method, 0
 *   nowhere, 1 bend that the border cuts off, or an edge without a node, 2 inclined to the skin,
 *   3 narrow hole, 4 edge, face or narrow strip crossed twice, 5 cut-out not opened, 6 a face on
 *   another without common nodes (see Findings.h);
 * - Shortfall (unsigned char, cells): 0 none, 1 below MinimumScaledJacobian, 2 a node left off the
 *   surface, 3 invalid, 4 invalid as it came, 5 an edge with hardly any of its length left,
 *   6 of a small part that nothing joins to the rest;
 * - DistanceLeft (float, points): from the surface, of a node that was left off it; 0 elsewhere;
 * - NewBoundary (unsigned char, points): 1 for nodes of the border that the trim made; 0 elsewhere;
 * - CornerLost (unsigned char, points), with ProduceOffcut: 1 where a corner of the model moved, or
 *   a node left its border or a fold of its skin or slid past a bend of the border, so that the
 *   parts do not add up to the whole; 0 elsewhere.
 *
 * Each value of Feasibility, Shortfall, DistanceLeft and CornerLost comes with one warning: how
 * many, where, and what to do.
 *
 * Output port 2, empty unless ProduceOffcut is on: the part that is cut away, fitted to port 0 node
 * by node, with the arrays of port 0 but Rescue. Parts of one input element share its
 * vtkOriginalCellIds.
 *
 * Port 0 also carries vtkOriginalPointIds, vtkOriginalCellIds, ScaledJacobian (float, cells; NaN
 * where it was not computed), every array of the input but vtkGhostType (see MapValues), and a
 * summary in its field data; with InsertLayer also Inserted (unsigned char, points and cells): 1
 * for what the input does not have. Such a point or cell has the original id and the values of the
 * point in whose place it is, of the cell on whose face it stands.
 *
 * On several ranks each gives its piece of the grid, and what it has of the surface. The result, as
 * a mesh, is that of the whole grid on one rank; only the numbering differs. Nodes that pieces
 * share are known by their global ids, or without these by their places, bit for bit. Ghost cells
 * are left out of the outputs. Nodes are renumbered within the piece and vtkOriginal...Ids are
 * those of the piece; the summary is that of the whole grid, on every rank.
 *
 * @warning Wedges of ports 0 and 2 have their nodes 0-1-2 oriented so that their normal points to
 * nodes 3-4-5: the Jacobian of vtkWedge's shape functions is positive, as vtkMeshQuality and the
 * solver codes expect; vtkCellSizeFilter reports a negative volume. Those of the input that have
 * the other order are turned.
 *
 * @sa vtkCADSurfaceReader vtkTrimLineSource vtkNURBSSurfaceSource
 */
#ifndef vtkTrimHexahedralGrid_h
#define vtkTrimHexahedralGrid_h

#include "NURBSTrimFilterModule.h" // For export macro
#include "vtkUnstructuredGridAlgorithm.h"

#include <array>      // For std::array
#include <atomic>     // For std::atomic
#include <functional> // For std::function
#include <memory>     // For std::unique_ptr
#include <string>     // For std::string
#include <vector>     // For std::vector

class vtkDataObject;
class vtkUnstructuredGrid;
class vtkMultiProcessController;

namespace nurbs
{
class PageUser;
}

namespace trim
{
class Ranks;
class TrimInputs;
struct TrimOptions;
struct TrimResult;
}

class NURBSTRIMFILTER_EXPORT vtkTrimHexahedralGrid : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTrimHexahedralGrid* New();
  vtkTypeMacro(vtkTrimHexahedralGrid, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum CorrectionTypes
  {
    ELIMINATE_ELEMENTS = 1,
    PROJECT_NODES = 2,
    SLIDE_ALONG_EDGES = 3
  };

  enum Optimizations
  {
    NO_OPTIMIZATION = 0,
    DISTRIBUTE_NODES = 1,
    DEGENERATE_TO_WEDGES = 2
  };

  ///@{
  /**
   * How the elements at the cut are corrected: 1 eliminates whole elements (type I), 2 projects
   * nodes onto the surface within their skin (type II, eqs. 16-17), 3 slides them along mesh
   * edges (type III, eq. 18). Default: 2.
   */
  vtkSetMacro(CorrectionType, int);
  vtkGetMacro(CorrectionType, int);
  ///@}

  ///@{
  /**
   * What is done with elements that became pentahedra (Fig. 7): 0 nothing, 1 the two nodes of
   * the superfluous edge are distributed between their neighbours, 2 the edge is dropped, which
   * leaves a wedge. With 1 an element whose corner would open beyond a straight angle becomes a
   * wedge all the same, with 0 one at which the border would turn back on itself. Default: 2.
   */
  vtkSetMacro(Optimization, int);
  vtkGetMacro(Optimization, int);
  ///@}

  ///@{
  /**
   * Turns round which side goes. Off: the side that the normal of the surface points to is
   * eliminated, or the one without the KeepPoint. Default: off.
   */
  vtkSetMacro(InvertSide, bool);
  vtkGetMacro(InvertSide, bool);
  vtkBooleanMacro(InvertSide, bool);
  ///@}

  ///@{
  /**
   * Keeps the side that holds KeepPoint (x y z), whatever the normal of the surface. Default:
   * off, at the origin.
   */
  vtkSetMacro(UseKeepPoint, bool);
  vtkGetMacro(UseKeepPoint, bool);
  vtkBooleanMacro(UseKeepPoint, bool);
  vtkSetVector3Macro(KeepPoint, double);
  vtkGetVector3Macro(KeepPoint, double);
  ///@}

  ///@{
  /**
   * An element goes when more than this share (0 to 1) of its through-thickness column lies
   * beyond the surface. Default: 0.5.
   */
  vtkSetMacro(EliminationFraction, double);
  vtkGetMacro(EliminationFraction, double);
  ///@}

  ///@{
  /**
   * Scaled Jacobian (0 to 1) that every element touched by the trim has to reach, but for
   * straight corners with Optimization 0 and 1; an element that came below it has to keep 0.2,
   * if it had that. Nodes behind the cut are moved where it needs it; what cannot reach it
   * otherwise has nodes left off the surface (DistanceLeft). 0 turns it off. Default: 0.2.
   */
  vtkSetMacro(MinimumScaledJacobian, double);
  vtkGetMacro(MinimumScaledJacobian, double);
  ///@}

  ///@{
  /**
   * Renumbers the nodes so that the largest node-number difference within an element is as
   * small as may be. Off: the order of the input. Default: on.
   */
  vtkSetMacro(RenumberNodes, bool);
  vtkGetMacro(RenumberNodes, bool);
  vtkBooleanMacro(RenumberNodes, bool);
  ///@}

  ///@{
  /**
   * Computes ScaledJacobian for every element, not only for those that the trim touched.
   * Default: off.
   */
  vtkSetMacro(QualityOfAllElements, bool);
  vtkGetMacro(QualityOfAllElements, bool);
  vtkBooleanMacro(QualityOfAllElements, bool);
  ///@}

  ///@{
  /**
   * Maps the input's values of floating point to the moved nodes and to the elements that changed
   * their shape, in the trimmed grid and the offcut: a node gets the value that the mesh had at its
   * new place, an element the mean over its new shape, within the range of the elements there and
   * their neighbours. Off: each takes its own values along. Integers, ids and texts are always
   * taken along. Default: off.
   */
  vtkSetMacro(MapValues, bool);
  vtkGetMacro(MapValues, bool);
  vtkBooleanMacro(MapValues, bool);
  ///@}

  ///@{
  /**
   * Distance under which a node counts as on the surface where it is, relative to the diagonal of
   * the grid's bounding box. Nodes that are moved to the surface come to lie on it to 1e-9 of the
   * diagonal, whatever is set here. In a grid whose points are float both are no less than the
   * rounding of its largest coordinate. Default: 1e-9.
   */
  vtkSetMacro(Tolerance, double);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * Fills output port 2 with the part that is cut away, as a valid mesh with the same nodes and
   * facets at the cut as the trimmed grid. Where the offcut cannot be made valid otherwise, the
   * trimmed grid keeps an element more, or leaves nodes off the surface. Default: off, the port
   * is empty.
   */
  vtkSetMacro(ProduceOffcut, bool);
  vtkGetMacro(ProduceOffcut, bool);
  vtkBooleanMacro(ProduceOffcut, bool);
  ///@}

  ///@{
  /**
   * Where nodes would be left off the surface, tries to end the trimmed grid in a layer of new
   * elements along the whole cut instead: they have one face each on the surface, so that solid
   * blocks that are cut aslant to their elements end exactly on it (see Treat/InsertedLayer.h).
   * Taken where it leaves less off the surface, and neither with ProduceOffcut nor with correction
   * type 1. Default: off, all elements are the input's.
   */
  vtkSetMacro(InsertLayer, bool);
  vtkGetMacro(InsertLayer, bool);
  vtkBooleanMacro(InsertLayer, bool);
  ///@}

  ///@{
  /**
   * The ranks whose pieces make up the grid; null: this process alone. Default: the global
   * controller.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkTrimHexahedralGrid();
  ~vtkTrimHexahedralGrid() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTrimHexahedralGrid(const vtkTrimHexahedralGrid&) = delete;
  void operator=(const vtkTrimHexahedralGrid&) = delete;

  int CorrectionType = PROJECT_NODES;
  int Optimization = DEGENERATE_TO_WEDGES;
  bool InvertSide = false;
  bool UseKeepPoint = false;
  double KeepPoint[3] = { 0.0, 0.0, 0.0 };
  double EliminationFraction = 0.5;
  double MinimumScaledJacobian = 0.2;
  bool RenumberNodes = true;
  bool QualityOfAllElements = false;
  bool MapValues = false;
  double Tolerance = 1e-9;
  bool ProduceOffcut = false;
  bool InsertLayer = false;
  vtkMultiProcessController* Controller = nullptr;

  std::unique_ptr<trim::TrimInputs> Inputs;
  std::unique_ptr<nurbs::PageUser> Pages; ///< memory from one run to the next
  /// What the caller's thread last saw of VTK's own flag, which others may not look at meanwhile.
  std::atomic<bool> SawAbort{ false };

  /// All of RequestData but threads and memory.
  int Trim(vtkInformationVector** inputVector, vtkInformationVector* outputVector,
    const trim::Ranks& ranks);
  /// The outputs; false, with empty ones, if it was aborted.
  bool Write(trim::TrimResult& result, const trim::Ranks& ranks,
    const std::function<bool(double)>& progress,
    const std::array<vtkUnstructuredGrid*, 3>& outputs);
  /// See Progress.h; for the calling thread's trim.
  std::function<bool(double)> TellProgress();
  void LookForAbort();
  /// Whether a rank was stopped. All are then in the eyes of the executive, or that rank alone
  /// would run at the next update, and wait for the others. Collective.
  bool IsStopped(const trim::Ranks& ranks, bool mine);
  void Warn(const trim::Ranks& ranks, const std::vector<std::string>& warnings);
  /// One error, by one rank; the outputs stay empty, and the executive is not told, or it would add
  /// a line of its own to the one that says what to do.
  int Refuse(const trim::Ranks& ranks, const std::string& error);
  /// The same amid the work: what was made so far, and what is kept of the inputs, goes.
  int GiveUp(
    vtkInformationVector* outputVector, const trim::Ranks& ranks, const std::string& error);
  trim::TrimOptions Options() const;
  /// What is wrong with the options of some rank; empty: nothing. Collective.
  std::string FindOptionDefect(const trim::TrimOptions& options, const trim::Ranks& ranks) const;
};

#endif
