#include "StepDirections.h"

#include <Eigen/Eigenvalues>

namespace trim
{

const Eigen::Matrix3Xd& StepDirections::At(int node)
{
  const Vec3& place = this->Mesh.TheMoves.Position[node];
  const auto known = this->ByNode.find(node);
  if (known == this->ByNode.end())
  {
    return this->ByNode.emplace(node, Known{ place, this->Find(node) }).first->second.Directions;
  }
  if (known->second.Place != place && !this->Mesh.IsFree(node))
  {
    known->second = { place, this->Find(node) };
  }
  return known->second.Directions;
}

/// On the cut the surface is looked for from where the nodes were last told to be.
void StepDirections::TellMoved(const std::vector<int>& nodes)
{
  for (const int node : nodes)
  {
    if (this->Mesh.OnCut[node])
    {
      this->ByNode.erase(node);
    }
  }
}

Eigen::Matrix3Xd StepDirections::Find(int node)
{
  const std::vector<Vec3> tangents = this->Mesh.Mover.Tangents(node, this->Mesh.FreedomOf(node),
    this->Mesh.TheMoves.Position[node], this->Mesh.OnCut[node] != 0);
  Eigen::Matrix3Xd t(3, tangents.size());
  for (std::size_t i = 0; i < tangents.size(); ++i)
  {
    t.col(static_cast<int>(i)) = tangents[i];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> metric(
    t.transpose() * this->Mesh.EdgeMetric(node) * t);
  if (!(metric.eigenvalues().minCoeff() > 0.0))
  {
    return Eigen::Matrix3Xd(3, 0); // the surface touches the skin there
  }
  return t * metric.operatorInverseSqrt();
}

}
