/**
 * @file TrimPipeline.h
 * @brief The trim from mesh and surface to the fate of every element and node (paper, Fig. 8).
 */
#ifndef TrimPipeline_h
#define TrimPipeline_h

#include "BandTrim.h"
#include "Findings.h"
#include "MeshBlocks.h"
#include "NodeClassification.h"
#include "Progress.h"
#include "SharedNodes.h"
#include "TrimmingSurface.h"

#include <memory>
#include <string>
#include <vector>

namespace trim
{

/// Borders of faces that lie nearer than this share of the surface's diagonal are one edge.
constexpr double GapShare = 1e-5;

/// The same where a border would be free otherwise. CAD programs leave gaps of up to 3.2e-4 between
/// faces that they take for joined, most of them beside fillets.
constexpr double WidestGapShare = 4e-4;

/// The same as a length.
inline double WidestGapOf(const nurbs::TrimmingSurface& surface)
{
  return WidestGapShare * surface.Bounds().diagonal().norm();
}

struct TrimOptions
{
  LadderOptions Ladder;
  bool InvertSide = false;
  bool UseKeepPoint = false;
  Vec3 KeepPoint = Vec3::Zero();
  double Tolerance = 1e-9; ///< of the status "on surface", relative to the diagonal of the grid
  bool ProduceOffcut = false;
};

struct TrimResult
{
  NodeClassification Nodes;
  PageVector<unsigned char> ElementStatus; ///< of every cell
  PageVector<char> Kept;                   ///< final fate of every cell
  std::unique_ptr<TrimBand> Near;          ///< null if the surface touches nothing
  Findings Found;
  std::vector<std::string> Warnings;
  std::string Error; ///< not empty: there is no result
  bool Aborted = false;
};

/**
 * Trims. Neither mesh nor surface is changed, but the surface is turned round for the time of
 * the call where InvertSide or KeepPoint ask for it.
 *
 * Collective: with several ranks each calls it with its own piece of the mesh, the whole surface
 * and the bounds and largest diagonal of all pieces. Error, Aborted, Warnings and Near are the
 * same on all; the rest is of the piece.
 */
TrimResult Trim(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  nurbs::TrimmingSurface& surface, const TrimOptions& options, const Progress& progress);

}

#endif
