#include "CreaseNodes.h"

#include "AddUnique.h"
#include "JointRelaxation.h"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>
#include <utility>

namespace trim
{
namespace
{

/// Elements at a sharp edge are relaxed to this, if they can reach it.
constexpr double CreaseGoal = 0.5;
/// A node has no farther to go than this many times the way to the node on the other side: to the
/// tip of an angle of 30 degrees.
constexpr double LongestWay = 2.0;
/// A node nearer than this share of it is there.
constexpr double NoWay = 1e-6;

/// Whether a surface may bend sharply at parameters of one direction.
bool MayBend(const std::vector<double>& knots, int degree)
{
  // Between the ends, as many equal knots as the degree.
  for (std::size_t i = degree + 1; i + 2 * degree < knots.size(); ++i)
  {
    if (knots[i] == knots[i + degree - 1])
    {
      return true;
    }
  }
  return false;
}

class CreaseFollower : private GuardedMesh
{
public:
  CreaseFollower(
    const GuardedCase& given, const nurbs::TrimmingSurface& surface, std::vector<char>& there)
    : GuardedMesh(given)
    , Surface(surface)
    , There(there)
  {
    this->There.resize(this->TheBand.NumberOfNodes(), 0);
    for (std::size_t n = 0; n < given.Fixed.size(); ++n)
    {
      given.Fixed[n] |= this->There[n];
    }
  }

  std::vector<char> Run(const std::vector<char>& among)
  {
    const auto neighbours = this->FindNeighbours();
    for (const auto& [pillars, nodes] : neighbours)
    {
      const bool asked = among.empty() ||
        std::any_of(nodes.begin(), nodes.end(),
          [&among](const auto& pair) { return among[pair.first] || among[pair.second]; });
      if (asked && !this->IsThere(nodes.front()) && !this->Given.ToRelax.Aborted())
      {
        this->Follow(nodes);
      }
    }
    return this->FindBeside(neighbours);
  }

private:
  /// Nodes of one pillar and those of another that edges join them with.
  using Neighbours = std::vector<std::pair<int, int>>;

  struct Way
  {
    std::vector<int> Nodes;
    std::vector<Vec3> To;
    double Length = 0.0; ///< of the longest, against the way to the other node
  };

  bool IsOnSurface(int node) const { return this->OnCut[node] && !this->TheMoves.Left[node]; }

  /// Pillars beside each other on the new boundary, by their smallest nodes.
  using NeighbourMap = std::map<std::pair<int, int>, Neighbours>;

  NeighbourMap FindNeighbours() const
  {
    NeighbourMap found;
    for (const auto& element : this->Elements)
    {
      const auto& topology = TopologyOf(element.Count);
      for (int i = 0; element.Count > 0 && i < topology.NumberOfEdges; ++i)
      {
        int a = element.Node[topology.Edges[i].First];
        int b = element.Node[topology.Edges[i].Second];
        if (this->IsOnSurface(a) && this->IsOnSurface(b) && this->Mover.IsLateral(a, b))
        {
          if (this->Mover.PillarOf(a) > this->Mover.PillarOf(b))
          {
            std::swap(a, b);
          }
          AddUnique(
            found[{ this->Mover.PillarOf(a), this->Mover.PillarOf(b) }], std::make_pair(a, b));
        }
      }
    }
    return found;
  }

  bool IsThere(const std::pair<int, int>& pair) const
  {
    return this->There[pair.first] || this->There[pair.second];
  }

  /// Nodes next to a sharp edge that was missed, and those beside them.
  std::vector<char> FindBeside(const NeighbourMap& neighbours) const
  {
    std::vector<char> beside(this->There.size(), 0);
    for (const auto& pair : this->Missed)
    {
      beside[pair.first] = beside[pair.second] = !this->IsThere(pair);
    }
    const std::vector<char> next = beside;
    for (const auto& [pillars, nodes] : neighbours)
    {
      for (const auto& [a, b] : nodes)
      {
        beside[a] |= next[b];
        beside[b] |= next[a];
      }
    }
    return beside;
  }

  /// Takes one of two pillars to the sharp edge between them, if there is one and it can go there.
  void Follow(const Neighbours& nodes)
  {
    // An edge that leans may pass them in some layers only.
    const auto across = std::find_if(nodes.begin(), nodes.end(),
      [this](const auto& pair)
      { return this->NormalAt(pair.first).dot(this->NormalAt(pair.second)) < CreaseCosine; });
    if (across == nodes.end())
    {
      return;
    }
    const std::array<nurbs::Foot, 2> sides{ this->FootOf(across->first),
      this->FootOf(across->second) };
    std::vector<Way> ways;
    for (const bool first : { true, false })
    {
      Way way;
      if (this->FindWay(nodes, first, sides, way))
      {
        if (way.Length < NoWay)
        {
          this->SetThere(way.Nodes, true);
          return;
        }
        ways.push_back(way);
      }
    }
    std::sort(
      ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.Length < b.Length; });
    if (!ways.empty() &&
      std::none_of(ways.begin(), ways.end(), [this](const Way& way) { return this->Go(way); }))
    {
      this->Missed.insert(this->Missed.end(), nodes.begin(), nodes.end());
    }
  }

  /// Of the surface, where a node was when it was asked for first.
  const Vec3& NormalAt(int node)
  {
    const auto known = this->Normals.find(node);
    return known != this->Normals.end() ? known->second
                                        : this->Normals[node] = this->FootOf(node).Normal;
  }

  nurbs::Foot FootOf(int node) const
  {
    return this->Surface.ClosestPoint(this->TheMoves.Position[node]);
  }

  /// @param first which of two neighbours is to go.
  /// @param sides feet on either side of the edge, in some layer.
  bool FindWay(
    const Neighbours& nodes, bool first, const std::array<nurbs::Foot, 2>& sides, Way& way)
  {
    for (const auto& [a, b] : nodes)
    {
      const int node = first ? a : b;
      const Vec3& from = this->TheMoves.Position[node];
      const Vec3& other = this->TheMoves.Position[first ? b : a];
      const nurbs::Foot here = this->FootOf(node);
      nurbs::Foot there = this->FootOf(first ? b : a);
      if (here.Normal.dot(there.Normal) > CreaseCosine)
      {
        const bool isFirst = here.Normal.dot(sides[0].Normal) > here.Normal.dot(sides[1].Normal);
        there = sides[isFirst ? 1 : 0];
      }
      Vec3 to = from;
      if (!this->Mover.MeetCrease(node, this->FreedomOf(node), here, there, to))
      {
        return false;
      }
      const double length = (to - from).norm() / (other - from).norm();
      if (this->Given.Fixed[node] && length >= NoWay)
      {
        return false;
      }
      way.Nodes.push_back(node);
      way.To.push_back(AsStored(this->TheBand, to));
      way.Length = std::max(way.Length, length);
    }
    return way.Length <= LongestWay;
  }

  bool Go(const Way& way)
  {
    const std::vector<int> at = this->ElementsAt(way.Nodes);
    std::vector<int> nodes = this->NodesRound(at, RelaxedRings);
    nodes.insert(nodes.end(), way.Nodes.begin(), way.Nodes.end());
    const State before = this->StateOf(nodes);
    const std::vector<int> elements = this->ElementsAt(nodes);
    const std::vector<Standard> standards = this->StandardsOf(elements, this->Given.Least);
    this->Place(way.Nodes, way.To);
    this->TellMoved(way.Nodes);
    this->SetThere(way.Nodes, true);
    const bool good =
      std::all_of(at.begin(), at.end(), [this](int e) { return this->Quality(e) >= CreaseGoal; });
    if (!good)
    {
      const RelaxationGoal goal{ CreaseGoal, this->Given.Least, Brief };
      Relax(this->Given.ToRelax, at, goal, this->TheMoves);
      if (this->LowestOf(elements, standards) >= 0.0 ||
        this->StandTogether(at, nodes, elements, standards))
      {
        RelaxJointly(this->Given.ToRelax, at, goal, this->TheMoves);
      }
    }
    if (this->LowestOf(elements, standards) >= 0.0 && !this->HasCoincident(before))
    {
      return true;
    }
    this->Restore(before);
    this->SetThere(way.Nodes, false);
    return false;
  }

  /// Whether nodes make room together where each alone did not, as far as it is needed. Most do
  /// not, which shows sooner than how far they raise all.
  bool StandTogether(const std::vector<int>& at, const std::vector<int>& nodes,
    const std::vector<int>& elements, const std::vector<Standard>& standards)
  {
    const State now = this->StateOf(nodes);
    const RelaxationGoal least{ this->Given.Least, this->Given.Least, Decisive };
    RelaxJointly(this->Given.ToRelax, at, least, this->TheMoves);
    const bool stands = this->LowestOf(elements, standards) >= 0.0;
    this->Restore(now);
    return stands;
  }

  /// What is on a sharp edge stays there.
  void SetThere(const std::vector<int>& nodes, bool there)
  {
    for (const int node : nodes)
    {
      this->There[node] = there;
      this->Given.Fixed[node] = there;
    }
  }

  const nurbs::TrimmingSurface& Surface;
  std::vector<char>& There; ///< by node: on a sharp edge
  std::unordered_map<int, Vec3> Normals;
  Neighbours Missed; ///< beside a sharp edge that none of them could go to
};

}

std::vector<char> PutOnCreases(const GuardedCase& given, const nurbs::TrimmingSurface& surface,
  const std::vector<char>& among, std::vector<char>& there)
{
  return CreaseFollower(given, surface, there).Run(among);
}

bool MayHaveCreases(const nurbs::TrimmingSurface& surface)
{
  // Between faces, where one meets itself, or at knots.
  const nurbs::NurbsSurface& face = surface.Face(0);
  const auto point = [&face](int i, int j) -> Vec3
  { return face.ControlPoints[i + face.CountU * j].head<3>(); };
  const double gap = surface.WidestGap();
  const bool closed = (point(0, 0) - point(face.CountU - 1, 0)).norm() <= gap ||
    (point(0, 0) - point(0, face.CountV - 1)).norm() <= gap;
  return surface.NumberOfFaces() > 1 || closed || MayBend(face.KnotsU, face.DegreeU) ||
    MayBend(face.KnotsV, face.DegreeV);
}

}
