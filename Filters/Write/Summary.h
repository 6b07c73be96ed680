/**
 * @file Summary.h
 * @brief The summary of a trim as field data, one array of one value for each entry.
 */
#ifndef Summary_h
#define Summary_h

#include "HexMesh.h"

#include <limits>

class vtkFieldData;

namespace trim
{

struct Summary
{
  Id Kept = 0;              ///< elements of the input that stay
  Id Eliminated = 0;        ///< elements of the input that go
  Id InsertedElements = 0;  ///< elements of the result that the input does not have
  Id Treated = 0;           ///< elements with the status "to treat"
  Id MovedNodes = 0;        ///< points of the result that moved
  Id Pentahedra = 0;        ///< elements with two adjacent facets on the cut and a straight corner
  Id Wedges = 0;            ///< those of them that were degenerated
  Id TouchedElements = 0;   ///< elements of the result with a moved node
  Id CertifiedElements = 0; ///< those of them whose Jacobian is proved positive everywhere
  Id NodeBandwidth = 0;     ///< largest node-number difference within an element
  Id RescuedByRelaxation = 0; ///< elements that the nodes round them moved for
  Id RescuedByTreatment = 0;  ///< columns, as the following
  Id RescuedByCorrection = 0;
  Id RescuedByFate = 0;
  Id RescuedByLeaving = 0; ///< columns whose nodes were left off the surface
  double MinimumScaledJacobian = std::numeric_limits<double>::quiet_NaN();
  double MinimumIntegrationPointJacobian = std::numeric_limits<double>::quiet_NaN();
  double MaximumDistanceToSurface = 0;
  double Volume = 0;

  /// Before what is there, see PutFirst.
  void AddTo(vtkFieldData* fieldData) const;
  /// Takes out the entries, which may be those of the trim that made the input.
  static void RemoveFrom(vtkFieldData* fieldData);
};

/// Adds arrays before those that are there: ParaView tells a client of no field data at all where
/// the first array has no tuples, as that of an Exodus file behind Merge Blocks.
void PutFirst(vtkFieldData* arrays, vtkFieldData* fieldData);

}

#endif
