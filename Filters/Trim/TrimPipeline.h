/**
 * @file TrimPipeline.h
 * @brief The trim from mesh and surface to the fate of every element and node (paper, Fig. 8).
 */
#ifndef TrimPipeline_h
#define TrimPipeline_h

#include "BandDecision.h"
#include "MeshBlocks.h"
#include "Progress.h"
#include "SharedNodes.h"
#include "TrimResult.h"
#include "TrimmingSurface.h"

namespace trim
{

struct TrimOptions
{
  BandOptions OfBand;
  bool InvertSide = false;
  bool UseKeepPoint = false;
  Vec3 KeepPoint = Vec3::Zero();
  double Tolerance = 1e-9; ///< of the status "on surface", relative to the diagonal of the grid
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
