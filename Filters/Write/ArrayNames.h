/**
 * @file ArrayNames.h
 * @brief The names of the arrays that the trim writes, and of the entries of its summary: scripts
 * and saved states rely on them.
 */
#ifndef ArrayNames_h
#define ArrayNames_h

namespace trim
{
namespace names
{

// VTK's own, which many filters leave behind.
inline constexpr const char* OriginalPoints = "vtkOriginalPointIds";
inline constexpr const char* OriginalCells = "vtkOriginalCellIds";

// Of points.
inline constexpr const char* NodeStatus = "NodeStatus";
inline constexpr const char* SignedDistance = "SignedDistance";
inline constexpr const char* Displacement = "Displacement";
inline constexpr const char* CorrectionApplied = "CorrectionApplied";
inline constexpr const char* DistanceLeft = "DistanceLeft";
inline constexpr const char* NewBoundary = "NewBoundary";
inline constexpr const char* CornerLost = "CornerLost";

// Of cells.
inline constexpr const char* ElementStatus = "ElementStatus";
inline constexpr const char* EliminatedFraction = "EliminatedFraction";
inline constexpr const char* ScaledJacobian = "ScaledJacobian";
inline constexpr const char* Rescue = "Rescue";
inline constexpr const char* Feasibility = "Feasibility";
inline constexpr const char* Shortfall = "Shortfall";

// Of both.
inline constexpr const char* Inserted = "Inserted";

// Of the summary.
inline constexpr const char* Kept = "Kept";
inline constexpr const char* Eliminated = "Eliminated";
inline constexpr const char* Treated = "Treated";
inline constexpr const char* MovedNodes = "MovedNodes";
inline constexpr const char* Pentahedra = "Pentahedra";
inline constexpr const char* Wedges = "Wedges";
inline constexpr const char* RescuedByRelaxation = "RescuedByRelaxation";
inline constexpr const char* RescuedByTreatment = "RescuedByTreatment";
inline constexpr const char* RescuedByCorrection = "RescuedByCorrection";
inline constexpr const char* RescuedByFate = "RescuedByFate";
inline constexpr const char* RescuedByLeaving = "RescuedByLeaving";
inline constexpr const char* InsertedElements = "InsertedElements";
inline constexpr const char* MaximumDistanceToSurface = "MaximumDistanceToSurface";

// Of the summary, those that the offcut has, too.
inline constexpr const char* TouchedElements = "TouchedElements";
inline constexpr const char* CertifiedElements = "CertifiedElements";
inline constexpr const char* MinimumScaledJacobian = "MinimumScaledJacobian";
inline constexpr const char* MinimumIntegrationPointJacobian = "MinimumIntegrationPointJacobian";
inline constexpr const char* Volume = "Volume";
inline constexpr const char* NodeBandwidth = "NodeBandwidth";

}
}

#endif
