/**
 * @file Status.h
 * @brief The values of STATUS(nodes) and STATUS(elements) (paper, section 2.2).
 */
#ifndef Status_h
#define Status_h

namespace trim
{

enum NodeStatus : unsigned char
{
  NodeKeep = 0,
  NodeEliminate = 1,
  NodeOnSurface = 2,
  // Only while classifying:
  NodeUnknown = 3,
  NodeOnBothSides = 4 ///< of a set whose nodes contradict each other
};

/// The side of what is joined.
inline unsigned char JoinedSide(unsigned char a, unsigned char b)
{
  if (a == NodeUnknown || b == NodeUnknown)
  {
    return a == NodeUnknown ? b : a;
  }
  return a == b ? a : static_cast<unsigned char>(NodeOnBothSides);
}

enum ElementStatus : unsigned char
{
  ElementKeep = 0,
  ElementEliminate = 1,
  ElementToTreat = 2
};

/**
 * Element status from the statuses of its nodes. The paper leaves open eliminate and on surface
 * without a keep: there is nothing to keep, so it is eliminate.
 */
inline ElementStatus StatusOfElement(const unsigned char* nodeStatus, int count)
{
  bool keep = false;
  bool eliminate = false;
  for (int i = 0; i < count; ++i)
  {
    keep |= nodeStatus[i] == NodeKeep;
    eliminate |= nodeStatus[i] == NodeEliminate;
  }
  return !eliminate ? ElementKeep : keep ? ElementToTreat : ElementEliminate;
}

/// Whether the four nodes of a face lie on the two sides by turns: the surface passes between
/// those that are opposite each other, on both sides of one or the other diagonal.
/// @param statusOf node statuses by the place of the node in the face.
template <typename StatusOf>
bool LieByTurns(const StatusOf& statusOf)
{
  const auto first = statusOf(0), second = statusOf(1);
  return first == statusOf(2) && second == statusOf(3) && first != second &&
    first != NodeOnSurface && second != NodeOnSurface;
}

}

#endif
