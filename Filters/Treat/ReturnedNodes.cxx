#include "ReturnedNodes.h"

#include "Returner.h"
#include "Runs.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>

namespace trim
{
namespace
{

/// Places that room is made for, at most.
constexpr int MostRelaxations = 300;

/// A returner with moves of its own, for a thread to foresee what becomes of nodes.
class ReturnerAside
{
public:
  /// @param same another one of the case.
  ReturnerAside(const GuardedCase& given, const Returner& same)
    : Mover(given.ToRelax.Mover.Quiet())
    , Fixed(given.Fixed)
    , OnCut(given.OnCut)
    , NodeMoves(given.NodeMoves)
    , Case{ { given.ToRelax.TheBand, this->Mover, given.ToRelax.Elements, this->Fixed, this->OnCut,
              given.ToRelax.Aborted },
      given.Quality, given.Least, this->Fixed, this->OnCut, this->NodeMoves }
    , Own(this->Case, same)
  {
  }
  ReturnerAside(const ReturnerAside&) = delete;
  void operator=(const ReturnerAside&) = delete;

  Returner* operator->() { return &this->Own; }

private:
  NodeMover Mover;
  std::vector<char> Fixed, OnCut;
  Moves NodeMoves;
  GuardedCase Case;
  Returner Own;
};

/**
 * Nodes return one after the other while the nodes round them make room. Most find none, which
 * leaves everything as it was: so all threads foresee what becomes of the next few, each with moves
 * of its own. That holds up to the first one that returns.
 */
class ReturnsInTurn
{
public:
  ReturnsInTurn(const GuardedCase& given, const std::vector<int>& left, FailedReturns& failures)
    : Given(given)
    , Left(left)
    , Aside(left.size() < FewLeft ? 1 : ThreadsForLoops())
    , InTurn(given, this->Aside.size() > 1 ? &failures : given.Failures)
  {
  }

  bool Run()
  {
    bool any = false;
    for (std::size_t i = 0; i < this->Left.size() && this->Relaxations < MostRelaxations &&
         !this->Given.ToRelax.Aborted();
         ++i)
    {
      const Returner::Outcome outcome = this->OutcomeOf(i);
      this->Relaxations += outcome.Relaxations;
      if (outcome.Moved)
      {
        any = true;
        this->Take(*outcome.Moved);
      }
    }
    return any;
  }

private:
  Returner::Outcome OutcomeOf(std::size_t i)
  {
    const int most = MostRelaxations - this->Relaxations;
    if (this->Aside.size() == 1)
    {
      return this->InTurn.Foresee(this->Left[i], most);
    }
    if (i >= this->First + this->Foreseen.size())
    {
      this->Foresee(i, most);
    }
    const int node = this->Left[i];
    Returner::Outcome& outcome = this->Foreseen[i - this->First];
    if (outcome.Relaxations > most)
    {
      return this->InTurn.Foresee(node, most);
    }
    this->InTurn.Ask(node);
    return std::move(outcome);
  }

  /// The next few from one on.
  void Foresee(std::size_t first, int most)
  {
    this->First = first;
    this->Foreseen.clear();
    this->Foreseen.resize(std::min(this->Left.size() - first, AtOnce * this->Aside.size()));
    std::atomic<std::size_t> next{ 0 };
    ForAll(
      static_cast<int>(this->Aside.size()),
      [&](int thread)
      {
        auto& aside = this->Aside[thread];
        for (std::size_t i; (i = next.fetch_add(1)) < this->Foreseen.size();)
        {
          if (!aside)
          {
            aside = std::make_unique<ReturnerAside>(this->Given, this->InTurn);
          }
          this->Foreseen[i] = (*aside)->Foresee(this->Left[first + i], most);
        }
      },
      1);
  }

  void Take(const Returner::State& moved)
  {
    this->InTurn.Take(moved);
    for (const auto& aside : this->Aside)
    {
      if (aside)
      {
        (*aside)->Take(moved);
      }
    }
    this->Foreseen.clear();
  }

  /// Nodes for each thread: one may take longer than others.
  static constexpr std::size_t AtOnce = 2;
  /// So few are not worth moves of each thread's own.
  static constexpr std::size_t FewLeft = 4;

  const GuardedCase& Given;
  const std::vector<int>& Left;
  std::vector<std::unique_ptr<ReturnerAside>> Aside; ///< by thread, once it had something to do
  Returner InTurn;
  std::vector<Returner::Outcome> Foreseen; ///< from First on
  std::size_t First = 0;
  int Relaxations = 0;
};

}

bool ReturnNodes(const GuardedCase& given, const std::vector<int>& left, ReturnEffort effort)
{
  if (effort == ReturnEffort::Relaxed)
  {
    FailedReturns own;
    return ReturnsInTurn(given, left, given.Failures ? *given.Failures : own).Run();
  }
  Returner returner(given, given.Failures);
  switch (effort)
  {
    case ReturnEffort::Alone:
      return returner.Run(left);
    default:
      return returner.Approach(left);
  }
}

}
