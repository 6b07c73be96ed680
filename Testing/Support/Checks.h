/**
 * @file Checks.h
 * @brief The judge: holds the outputs of a trim against its input, an oracle of the surface and
 * the promises of CONTRACT.md, by code of its own. Every check counts its failures in a Report.
 */
#ifndef Checks_h
#define Checks_h

#include "Evidence.h"

#include <string>
#include <vector>

namespace judge
{
/// Notes under this name are nodes that DistanceLeft tells of.
constexpr const char* NodesLeftOff = "nodes left off the surface, as the filter says";

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
/// Nodes of each element, its Jacobians, collapse; coincident and unused nodes.
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
