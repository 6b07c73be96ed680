/**
 * @file NodeMove.h
 * @brief Where a node goes, and by which correction.
 */
#ifndef NodeMove_h
#define NodeMove_h

#include "Band.h"

namespace trim
{

enum class Correction : unsigned char
{
  None = 0,
  Eliminate = 1, ///< type I: no node moves
  Project = 2,   ///< type II
  Slide = 3,     ///< type III
  Relax = 4      ///< moved for the sake of the elements at the cut
};

struct NodeMove
{
  bool Found = false;
  Vec3 Target = Vec3::Zero();
  Correction By = Correction::None;
  bool OnSurface = true; ///< false: as near to it as the model lets the node come
  double Elements = 0;   ///< length of the move in edges of the face it leads into
};

}

#endif
