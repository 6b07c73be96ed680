/**
 * @file SheetSkin.h
 * @brief The skin of a mesh of hexahedra and wedges, node by node, to sweep a trim line through it.
 */
#ifndef SheetSkin_h
#define SheetSkin_h

#include "NurbsSurface.h"

#include <Eigen/Geometry>

#include <string>
#include <vector>

class vtkDataObject;
class vtkMultiProcessController;

namespace nurbs
{
/**
 * The skin of the mesh, or of the piece of it that this rank has. The functions are collective if
 * there are several ranks: all of them call each in the same order, and get the same answer.
 */
struct SheetSkin
{
  std::vector<Vec3> Points; ///< the nodes of the skin
  std::vector<Vec3> Areas;  ///< a fourth of the outward area vectors of the skin's faces round each
  Eigen::AlignedBox3d Box;  ///< of all nodes of elements

  vtkMultiProcessController* Ranks = nullptr; ///< null: one rank alone

  /// Has no rank any node?
  bool IsEmpty() const;

  /// The box of all ranks.
  Eigen::AlignedBox3d WholeBox() const;

  /// Is it so on all ranks?
  bool AllAgree(bool mine) const;

  /// The text of the first rank that has one, with its number if that is not the first of all.
  std::string FirstText(const std::string& mine) const;

  /**
   * The axis that the skin's normals near these places have on the whole: the principal one,
   * weighted by area, of all nodes that are at most `reach` farther from a place than the node
   * nearest to it. Both skins of a sheet, whose normals are opposed, count alike. Its largest
   * coordinate is positive.
   */
  Vec3 MeanNormal(const std::vector<Vec3>& places, double reach) const;

  /// To be called when Points are complete.
  void DivideIntoBlocks();

private:
  /// Nodes that follow each other lie near each other as a rule: what is far from the box of a
  /// block is far from all of its nodes.
  static constexpr std::size_t BlockSize = 128;
  std::vector<Eigen::AlignedBox3d> Blocks;

  /// The number of the node after the last of the block.
  std::size_t BlockEnd(std::size_t block) const;

  /// The square of the distance to the nearest node.
  double NearestSquare(const Vec3& place) const;

  /// The sum or the least of all ranks' values, each by itself.
  void Reduce(std::vector<double>& values, int operation) const;
};

/**
 * The skin of an unstructured grid, or of those in a composite. The area vectors of all faces of
 * all elements are added up at their nodes, where those of inner faces cancel each other. Elements
 * other than hexahedra and wedges, and ghosts, are passed over. Of a mesh in pieces the sides
 * between the pieces count as skin: where pieces are not compact the mean normal may tilt by a
 * fraction of a degree.
 *
 * @return false with an error, and a skin without meaning, if a cell uses a node that there is not.
 */
bool BuildSheetSkin(vtkDataObject* data, SheetSkin& skin, std::string& error);
}

#endif
