/**
 * @file Draws.h
 * @brief Random meshes, cuts and options, each with words that tell what was drawn.
 */
#ifndef Draws_h
#define Draws_h

#include "Pieces.h"
#include "SplineData.h"

#include <algorithm>
#include <random>
#include <string>
#include <vector>

namespace judge
{
class Dice
{
public:
  Dice(unsigned seed, unsigned number)
  {
    std::seed_seq sequence{ seed, number };
    this->Random.seed(sequence);
  }
  double Any() { return std::uniform_real_distribution<double>(0, 1)(this->Random); }
  bool Chance(double share) { return this->Any() < share; }
  int Below(int count) { return std::min(count - 1, static_cast<int>(this->Any() * count)); }
  template <typename T>
  const T& Pick(const std::vector<T>& from)
  {
    return from[this->Below(static_cast<int>(from.size()))];
  }

private:
  std::mt19937 Random;
};

struct Cut
{
  std::string Words;
  Surface What;
};

struct Extra
{
  TrimOptions Options;
  bool Quality = false;
  std::string Words;
};

Placement DrawPlacement(Dice& dice, const std::string& kind);

/// One surface, or now and then several.
Cut DrawCut(Dice& dice, const Frame& box);

/// Aslant to all elements of a block, or nearly.
Cut DrawAslant(Dice& dice, const Frame& box);

Extra DrawOptions(Dice& dice, const Frame& box);

/// Some cells with their nodes in the other order, and wedges as hexahedra with two pairs of equal
/// corners.
/// @param insideOut the share of hexahedra that are turned.
Mesh WithOddCells(const Mesh& mesh, double insideOut, bool wedgesAsHexahedra, Dice& dice);

/// One of `names`, or now and then one of its own.
/// @param needsIds gets whether places alone do not tell its nodes apart.
Mesh DrawMesh(
  Dice& dice, const std::vector<std::string>& names, std::string& words, bool& needsIds);
}

#endif
